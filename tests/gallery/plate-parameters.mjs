// Tests the parameters of the plate of a curve.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import {
  REDUCED_MOTION,
  fieldOf,
  sliderOf,
  changeParameter,
  plateIsUpdated,
  measureNow,
  assertNear,
} from "./plate-support.mjs";

export const PARAMETERS = [
  [
    "3.10",
    "a slider recomputes curve and measures at once, and the address changes",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      assert.match(
        await page.locator(".sliders > .note").innerText(),
        /^frame p, crank r,/,
        "invalid text is reported",
      );
      const before = await page.locator(".dashes").getAttribute("d");
      await sliderOf(page, "p").fill("2.5");
      await plateIsUpdated(page);
      assert.notEqual(await page.locator(".dashes").getAttribute("d"), before);
      assert.match(await plate.fragment(), /\?p=2\.5$/);
      // Extreme transmission angles: frame less crank 1.5, frame and crank 3.5.
      const at = (d) => (Math.acos((2 * 2.59 * 2.59 - d * d) / (2 * 2.59 * 2.59)) * 180) / Math.PI;
      const [, least] = await measureNow(page, "least transmission angle");
      const [, most] = await measureNow(page, "greatest transmission angle");
      assertNear(Number(least), at(1.5), 0.006, "mu min");
      assertNear(Number(most), at(3.5), 0.006, "greatest transmission angle");
      const [recorded, , change] = await measureNow(page, "least transmission angle");
      assertNear(Number(change), at(1.5) - Number(recorded), 0.02, "the change");
      await page.getByRole("button", { name: "Reset all" }).click();
      await eventually(
        async () => (await plate.fragment()) === "/evans/curve/1.1.1",
        "the address keeps the change",
      );
      assert.equal(await page.locator(".dashes").getAttribute("d"), before);
      await plate.close();
    },
  ],
  [
    "3.10",
    "an angle is shown with its unit, and typed in degrees or radians; a length has no unit",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/new/scotch-yoke", REDUCED_MOTION);
      const { page } = plate;
      const [angle, length] = [fieldOf(page, "angle"), fieldOf(page, "r")];
      assert.equal(await angle.inputValue(), "90°");
      assert.equal(await sliderOf(page, "angle").getAttribute("aria-valuetext"), "90°");
      const goesTo = (value) =>
        eventually(async () => (await plate.fragment()) === `/new/scotch-yoke?${value}`, value);
      await angle.fill("80,5 deg");
      await goesTo("angle=80.5");
      await angle.fill("0.25 rad");
      await goesTo(`angle=${(0.25 * 180) / Math.PI}`);
      for (const wrong of ["30 grad", "30 mm"]) {
        await angle.fill(wrong);
        assert.match(await angle.getAttribute("title"), /is not a number \(in °, deg, rad\)/);
      }
      await angle.fill("80.5°");
      await goesTo("angle=80.5");
      await length.fill("2°");
      assert.equal(await length.getAttribute("aria-invalid"), "true");
      assert.match(await length.getAttribute("title"), /has a unit: write a number alone/);
      await length.fill("1,5");
      await length.blur();
      await goesTo("angle=80.5&r=1.5");
      assert.deepEqual([await angle.inputValue(), await length.inputValue()], ["80.5°", "1.5"]);
      await plate.close();
    },
  ],
  [
    "3.10",
    "an address with changed parameters opens with them",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1?p=2.5&k=1.9", REDUCED_MOTION);
      assert.equal(await fieldOf(plate.page, "p").inputValue(), "2.5");
      await plate.page.locator(".locked-parameters > summary").evaluate((summary) => {
        summary.parentElement.open = true;
      });
      assert.equal(await fieldOf(plate.page, "k").inputValue(), "1.9");
      assert.ok(await plate.page.locator(".changed-tag").isVisible());
      await plate.close();
    },
  ],
  [
    "3.10",
    "derived values follow, and can be unlinked",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      // The coupler point is k a along the coupler.
      await page.locator(".locked-parameters").evaluate((details) => {
        details.open = true;
      });
      assert.equal(await fieldOf(page, "M.along").inputValue(), "5.18");
      await changeParameter(page, "k", 1.5);
      assert.equal(await fieldOf(page, "M.along").inputValue(), "3.885");
      await page.getByRole("button", { name: /Unlink: M\.along/ }).click();
      await changeParameter(page, "k", 2);
      assert.equal(await fieldOf(page, "M.along").inputValue(), "3.885");
      await plate.close();
    },
  ],
  [
    "3.11",
    "a linkage that cannot be assembled shows the reason, and the last one stays visible",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      await changeParameter(page, "p", 9);
      const reason = page.locator(".stage .reason");
      assert.ok(await reason.isVisible());
      assert.match(await reason.textContent(), /^Cannot be assembled: .{10,}/);
      assert.ok(await page.getByRole("button", { name: "Play" }).isDisabled());
      assert.ok((await page.locator(".link").count()) > 2);
      await changeParameter(page, "p", -1);
      assert.match(await reason.textContent(), /must be more than 0/);
      assert.equal(await fieldOf(page, "p").getAttribute("aria-invalid"), "true");
      await changeParameter(page, "p", 2);
      assert.ok(await reason.isHidden());
      assert.ok(await page.getByRole("button", { name: "Play" }).isEnabled());
      await plate.close();
    },
  ],
  [
    "3.11",
    "an address of a linkage that cannot be assembled shows the reason and the linkage of the atlas",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1?p=9", REDUCED_MOTION);
      const { page } = plate;
      assert.match(await page.locator(".stage .reason").textContent(), /cannot be placed/);
      assert.ok((await page.locator(".dashes").getAttribute("d")).length > 100);
      await page.keyboard.press("+");
      await page.keyboard.press("ArrowRight");
      await page.getByRole("button", { name: /^Reset: p/ }).click();
      await eventually(() => page.locator(".stage .reason").isHidden(), "it stays impossible");
      await plate.close();
    },
  ],
];
