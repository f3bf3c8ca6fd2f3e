// Tests the plate of a curve with all kinds of linkages, and its accessibility.

import assert from "node:assert/strict";

import { contrastOf, eventually, openGallery } from "./browser.mjs";
import { gripAt, inputNow, REDUCED_MOTION } from "./plate-support.mjs";

export const ACCESSIBILITY = [
  [
    "3.12",
    "all kinds of linkages open without errors, and move",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1");
      const families = await plate.page.evaluate(() =>
        JSON.parse(document.getElementById("atlas").textContent).families.map(({ id }) => id),
      );
      for (const id of families) {
        await plate.go(`/${id}/curve/1.1.1`);
        const { page } = plate;
        assert.ok(await page.locator(".tracer").count(), id);
        const before = await inputNow(page);
        await eventually(async () => (await inputNow(page)) !== before, `${id} does not move`);
        for (const box of await page.locator(".checks input:visible").all()) await box.check();
        await page.keyboard.press("End");
        await page.keyboard.press("ArrowRight");
        const strange = await page
          .locator(".stage")
          .evaluate((stage) =>
            [...stage.querySelectorAll("*")].some((element) =>
              ["d", "cx", "cy", "x", "y", "transform"].some((name) =>
                /NaN|Infinity|undefined/.test(element.getAttribute(name) ?? ""),
              ),
            ),
          );
        assert.ok(!strange, `${id} draws what is no number`);
      }
      await plate.close();
    },
  ],
  [
    "3.13",
    "everything is available to screen readers, and text has enough contrast",
    async ({ browser, folder }) => {
      for (const colorScheme of ["light", "dark"]) {
        const plate = await openGallery(browser, folder, "/watt/curve/1.1.1?p=1.9", {
          ...REDUCED_MOTION,
          colorScheme,
        });
        const { page } = plate;
        const scene = page.getByRole("img", { name: "The linkage on its curve" });
        const summary = await page.locator(`#${await scene.getAttribute("aria-describedby")}`).textContent();
        assert.match(summary, /four-bar/);
        assert.equal(
          await page.locator(".plate-split :is([aria-live], output)").count(),
          0,
          "live values chatter",
        );
        for (const text of [
          ".plate .note",
          ".plate .lede",
          ".input-now",
          ".measures .definition",
          ".changed-tag",
          ".origin dt",
        ]) {
          assert.ok((await contrastOf(page.locator(text).first())) >= 4.5, `${text} in ${colorScheme}`);
        }
        const unnamed = await page
          .locator(".plate :is(input, button, select)")
          .evaluateAll(
            (all) =>
              all.filter(
                (control) =>
                  !(
                    control.getAttribute("aria-label") ||
                    control.textContent.trim() ||
                    control.closest("label")
                  ),
              ).length,
          );
        assert.equal(unnamed, 0);
        await plate.close();
      }
    },
  ],
  [
    "3.14",
    "a narrow screen has the drawing first, and nothing overflows",
    async ({ browser, folder }) => {
      for (const width of [360, 768, 1400]) {
        const plate = await openGallery(browser, folder, "/hrones-nelson/curve/1.3.1?A=2.4", {
          ...REDUCED_MOTION,
          viewport: { width, height: 800 },
        });
        const { page } = plate;
        const [stage, panel, wide] = await page.evaluate(() => [
          document.querySelector(".stage").getBoundingClientRect().top,
          document.querySelector(".plate-panel").getBoundingClientRect().top,
          document.documentElement.scrollWidth,
        ]);
        assert.ok(wide <= width, `${wide} px wide on ${width}`);
        assert.ok(width > 960 || stage < panel);
        await plate.close();
      }
    },
  ],
  [
    "3.15",
    "pins, neighbours and the zoom work by keys",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      await page.keyboard.press("]");
      await eventually(async () => (await plate.fragment()) === "/evans/curve/2.1.1", "it stays");
      await page.waitForSelector("h1 .key:text('2.1.1')");
      const wide = () => page.locator(".still > g").getAttribute("transform");
      const fitted = await wide();
      await page.keyboard.press("+");
      assert.notEqual(await wide(), fitted);
      await page.keyboard.press("0");
      assert.equal(await wide(), fitted);
      await page.getByRole("button", { name: "Pin", exact: true }).press("Enter");
      assert.ok(await page.getByRole("button", { name: "Pinned" }).isVisible());
      await plate.close();
    },
  ],
  [
    "3.15",
    "the wheel zooms about the pointer, and dragging moves the picture",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      const pin = await gripAt(page, 2);
      await page.mouse.move(...pin);
      await page.mouse.wheel(0, -300);
      await eventually(
        async () => !(await page.locator(".scale-label").textContent()).startsWith("2"),
        "no zoom",
      );
      const after = await gripAt(page, 2);
      // Pointer events have integer coordinates.
      assert.ok(Math.hypot(after[0] - pin[0], after[1] - pin[1]) < 1, "the place under the pointer moved");
      const { left, top } = await page
        .locator(".stage")
        .evaluate((stage) => stage.getBoundingClientRect().toJSON());
      await page.mouse.move(left + 15, top + 15);
      await page.mouse.down();
      await page.mouse.move(left + 55, top + 45, { steps: 4 });
      await page.mouse.up();
      const moved = await gripAt(page, 2);
      assert.ok(Math.hypot(moved[0] - after[0] - 40, moved[1] - after[1] - 30) < 1, "the picture");
      await plate.close();
    },
  ],
  [
    "3.16",
    "a printed plate does not move, and has its facts",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      await page.emulateMedia({ media: "print" });
      for (const name of [".drive", ".sliders", ".circuits-gauge"])
        assert.ok(await page.locator(name).isHidden(), name);
      for (const name of [".stage", ".motion-notes", "table.measures", ".origin", ".dial"]) {
        assert.ok(await page.locator(name).isVisible(), name);
      }
      await plate.close();
    },
  ],
];
