// Tests the square handles of a plate, which change dimensions.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import { REDUCED_MOTION, assertNear, fieldOf, gripAt, inputNow, plateIsUpdated } from "./plate-support.mjs";

const EVANS = "/evans/curve/1.1.1?at=46.8";

const handleOf = (page, joint) => page.locator(`.square[aria-label^="Move ${joint}:"]`);

/** The middle of the square of a handle, [x, y]. */
async function squareAt(page, joint) {
  const { x, y, width, height } = await handleOf(page, joint).locator(".square-mark").boundingBox();
  return [x + width / 2, y + height / 2];
}

/** Drags the handle of a joint by pixels, in steps; the pointer is still down then. */
async function dragHandle(page, joint, [dx, dy]) {
  const [x, y] = await squareAt(page, joint);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 5; k += 1) await page.mouse.move(x + (k * dx) / 5, y + (k * dy) / 5);
  await page.evaluate(() => new Promise(requestAnimationFrame));
}

const isShown = async (page, joint) =>
  (await handleOf(page, joint).evaluate((one) => getComputedStyle(one).opacity)) === "1";

export const HANDLES = [
  [
    "3.21",
    "a handle moves its joint by the dimensions at it, as one gesture",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, EVANS, REDUCED_MOTION);
      const { page } = plate;
      assert.ok(!(await isShown(page, "M")));
      const before = await gripAt(page, 4);
      const own = await page.locator(".dashes").getAttribute("d");
      await dragHandle(page, "M", [40, -20]);
      assert.ok(await isShown(page, "M"));
      const at = await gripAt(page, 4);
      // Values are round to about a pixel.
      assertNear(at[0] - before[0], 40, 3, "to the right");
      assertNear(at[1] - before[1], -20, 3, "up");
      assert.match(await page.getByLabel("k at the handle").inputValue(), /^\d\.\d+$/);
      assert.equal(await plate.fragment(), EVANS, "a handle that is held has not ended its gesture");
      await page.mouse.up();
      await plateIsUpdated(page);
      await eventually(
        async () => /\?k=[\d.]+&M\.across=-?[\d.]+&at=46\.8$/.test(await plate.fragment()),
        "no address",
      );
      assertNear(await inputNow(page), 46.8, 1e-9, "the input is held");
      // What is next to the handle can be typed.
      await page.getByLabel("k at the handle").fill("2,25");
      await page.keyboard.press("Enter");
      await plateIsUpdated(page);
      await eventually(
        async () => /\?k=2\.25&M\.across=-?[\d.]+&at=46\.8$/.test(await plate.fragment()),
        "not typed",
      );
      assert.ok(!(await page.getByLabel("k at the handle").evaluate((one) => one.matches(":invalid"))));
      await page.getByLabel("k at the handle").fill("2,2,5");
      assert.ok(await page.getByLabel("k at the handle").evaluate((one) => one.matches(":invalid")));
      // The browser says why when it is entered; the field that is left shows the value that holds.
      await page.keyboard.press("Enter");
      assert.equal(await page.getByLabel("k at the handle").inputValue(), "2,2,5");
      await page.locator("h1").evaluate(() => document.activeElement.blur());
      assert.equal(await page.getByLabel("k at the handle").inputValue(), "2.25");
      assert.ok(!(await page.getByLabel("k at the handle").evaluate((one) => one.matches(":invalid"))));
      await page.keyboard.press("Control+z");
      await plateIsUpdated(page);
      // The curve of the atlas is behind it, and the numbers of both are in the table.
      assert.ok((await page.locator(".ghost").getAttribute("d")).length > 100);
      assert.ok(await page.locator("table.measures.with-changes").isVisible());
      await page.keyboard.press("Control+z");
      await eventually(async () => (await plate.fragment()) === EVANS, "it is not undone");
      await plateIsUpdated(page);
      assert.equal(await page.locator(".dashes").getAttribute("d"), own);
      assert.equal(await page.locator(".ghost").getAttribute("d"), "");
      await plate.close();
    },
  ],
  [
    "3.21",
    "what is dragged there and back is as it was, and a pivot slides along what it can reach",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, EVANS, REDUCED_MOTION);
      const { page } = plate;
      await dragHandle(page, "B", [50, 30]);
      const [x, y] = await squareAt(page, "B");
      await page.mouse.move(x - 50, y - 30, { steps: 3 });
      await page.mouse.up();
      await eventually(async () => (await plate.fragment()) === EVANS, "something has changed");
      // The pivot C is on the line of the frame, which only p changes.
      const before = await squareAt(page, "C");
      await dragHandle(page, "C", [30, 45]);
      assert.ok(
        await handleOf(page, "C").evaluate((one) => one.classList.contains("unreached")),
        "it is not said",
      );
      const after = await squareAt(page, "C");
      assertNear(after[0] - before[0], 30, 2, "along the frame");
      assertNear(after[1] - before[1], 0, 0.1, "across the frame");
      await page.mouse.up();
      await plateIsUpdated(page);
      assert.match(await plate.fragment(), /\?p=[\d.]+&at=/);
      await plate.close();
    },
  ],
  [
    "3.21",
    "locked dimensions stay, and handles work by keys",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, EVANS, REDUCED_MOTION);
      const { page } = plate;
      await page.getByRole("button", { name: "Lock a", exact: true }).click();
      await eventually(
        async () => (await plate.fragment()) === "/evans/curve/1.1.1?lock=a&at=46.8",
        "no lock",
      );
      await dragHandle(page, "B", [25, 25]);
      await page.mouse.up();
      await plateIsUpdated(page);
      assert.equal(await fieldOf(page, "a").inputValue(), "2.59");
      assert.notEqual(await fieldOf(page, "s").inputValue(), "2.59");
      await page.keyboard.press("Control+z");
      await plateIsUpdated(page);
      // The focus on a field shows the handles that it moves.
      await fieldOf(page, "p").focus();
      assert.ok(await isShown(page, "C"));
      await handleOf(page, "C").focus();
      const before = Number(await fieldOf(page, "p").inputValue());
      await page.keyboard.press("Shift+ArrowRight");
      await plateIsUpdated(page);
      assert.ok(Number(await fieldOf(page, "p").inputValue()) > before);
      await page.keyboard.press("PageDown");
      assert.match(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), /^Move A:/);
      await plate.close();
    },
  ],
  [
    "3.21",
    "handles of a linkage that is a mirror image follow the pointer, within a frame",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/jansen/curve/1.1.1?at=40", REDUCED_MOTION);
      const { page } = plate;
      const moved = [];
      for (const [k, label] of (
        await page.locator(".square").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")))
      ).entries()) {
        const joint = label.match(/^Move (.*):/)[1];
        const number = Number(await page.locator(".square").nth(k).getAttribute("data-handle"));
        const before = await squareAt(page, joint);
        await dragHandle(page, joint, [14, -9]);
        const after = await squareAt(page, joint);
        // One dimension moves a joint along a line only; the mirror image of the way would be far from the pointer.
        const along = ((after[0] - before[0]) * 14 + (after[1] - before[1]) * -9) / Math.hypot(14, 9) ** 2;
        const isReached = !(await handleOf(page, joint).evaluate((one) =>
          one.classList.contains("unreached"),
        ));
        assert.ok(along > -0.01 && along < 1.25, `${joint} (${number}) goes ${along} of the way`);
        if (isReached) assertNear(after[0] - before[0], 14, 6, `${joint} to the right`);
        moved.push(along > 0.8);
        await page.mouse.move(before[0], before[1]);
        await page.mouse.up();
        await plateIsUpdated(page);
      }
      assert.ok(moved.filter(Boolean).length >= 2, `${moved}`);
      await plate.close();
    },
  ],
];
