// Tests that the address of a plate says all of its state, and that gestures are undone.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import {
  REDUCED_MOTION,
  changeParameter,
  fieldOf,
  inputNow,
  plateIsUpdated,
  sliderOf,
} from "./plate-support.mjs";

const HOME = "/evans/curve/1.1.1";

/** Waits for an address. */
const isAt = (plate, address) =>
  eventually(async () => (await plate.fragment()) === address, `the address is not ${address}`);

/** Presses a key outside of fields. */
const press = (page, keys) =>
  page
    .locator("h1")
    .evaluate(() => document.activeElement?.blur())
    .then(() => page.keyboard.press(keys));

export const STATE = [
  [
    "3.20",
    "gestures are undone one by one, and done again",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, HOME, REDUCED_MOTION);
      const { page } = plate;
      const curve = () => page.locator(".dashes").getAttribute("d");
      const before = await curve();
      await changeParameter(page, "p", 2.5);
      const changed = await curve();
      await page.getByRole("checkbox", { name: "Velocity" }).check();
      await isAt(plate, `${HOME}?p=2.5&show=${await shownOverlays(page)}`);
      await press(page, "Control+z");
      await isAt(plate, `${HOME}?p=2.5`);
      assert.ok(!(await page.getByRole("checkbox", { name: "Velocity" }).isChecked()));
      await press(page, "Control+z");
      await isAt(plate, HOME);
      await plateIsUpdated(page);
      assert.equal(await curve(), before);
      assert.ok(!(await page.locator(".changed-tag").isVisible()));
      await press(page, "Control+z");
      await isAt(plate, HOME);
      await press(page, "Control+Shift+z");
      await isAt(plate, `${HOME}?p=2.5`);
      assert.equal(await fieldOf(page, "p").inputValue(), "2.5");
      assert.equal(await curve(), changed);
      // A gesture after it leaves nothing to be done again.
      await sliderOf(page, "p").fill("2.6");
      await isAt(plate, `${HOME}?p=2.6`);
      await press(page, "Control+y");
      await isAt(plate, `${HOME}?p=2.6`);
      await plate.close();
    },
  ],
  [
    "3.20",
    "the value of the atlas is no change",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, HOME, REDUCED_MOTION);
      const { page } = plate;
      const own = await fieldOf(page, "p").inputValue();
      await changeParameter(page, "p", 2.5);
      await isAt(plate, `${HOME}?p=2.5`);
      await changeParameter(page, "p", own);
      await isAt(plate, HOME);
      assert.ok(!(await page.locator(".changed-tag").isVisible()));
      await plate.go(`${HOME}?p=${own}`);
      await plateIsUpdated(page);
      assert.ok(!(await page.locator(".changed-tag").isVisible()), "an address with it is that of the atlas");
      await plate.close();
    },
  ],
  [
    "3.20",
    "the address keeps the input of a linkage that stands still",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, `${HOME}?at=63.5`);
      const { page } = plate;
      assert.equal(await inputNow(page), 63.5);
      assert.equal(await page.locator(".play").textContent(), "Play", "it does not move by itself");
      await page.locator(".scrub").focus();
      await page.keyboard.press("ArrowRight");
      await isAt(plate, `${HOME}?at=64.5`);
      await press(page, "Control+z");
      await isAt(plate, `${HOME}?at=63.5`);
      assert.equal(await inputNow(page), 63.5);
      await page.locator(".play").click();
      await isAt(plate, HOME);
      await page.locator(".play").click();
      const [, at] = /at=([\d.]+)$/.exec(await plate.fragment()) ?? [];
      assert.ok(Math.abs(Number(at) - (await inputNow(page))) < 0.051, `at ${at}`);
      await plate.close();
    },
  ],
];

/** The names of the overlays that are on, as the address lists them. */
async function shownOverlays(page) {
  const names = await page
    .locator(".checks input:checked")
    .evaluateAll((boxes) => boxes.map(({ name }) => name.replace("show-", "")));
  return names.join(",");
}
