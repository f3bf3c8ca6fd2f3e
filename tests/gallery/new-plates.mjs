// Tests plates of linkages that are in no family of the atlas.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import { REDUCED_MOTION, assertNear, changeParameter, fieldOf, gripAt, inputNow } from "./plate-support.mjs";

const isAt = (plate, address) =>
  eventually(async () => (await plate.fragment()) === address, `the address is not ${address}`);

/** The least transmission angle of a four-bar whose crank turns fully, in degrees: where the crank is on the frame. */
const leastTransmission = (frame, crank, coupler, rocker) =>
  (Math.acos((coupler ** 2 + rocker ** 2 - (frame - crank) ** 2) / (2 * coupler * rocker)) * 180) / Math.PI;

export const NEW_PLATES = [
  [
    "3.60",
    "a four-bar of no family is opened from the list, changed, moved, pinned, compared and exported",
    async ({ browser, folder }) => {
      const options = { ...REDUCED_MOTION, permissions: ["clipboard-read", "clipboard-write"] };
      const plate = await openGallery(browser, folder, "/", options);
      const { page } = plate;
      await page.locator(".site-nav a", { hasText: "New" }).click();
      await page.locator(".linkages a", { hasText: /^four-bar$/ }).click();
      await isAt(plate, "/new/four-bar");
      await eventually(async () => (await page.locator(".dashes").getAttribute("d")) !== null, "it is drawn");
      assert.equal(await page.locator(".site-nav a[aria-current]").innerText(), "New");
      const least = async () =>
        Number(
          /least ([\d.]+)°/.exec(await page.locator(".dial-gauge, .plate-panel").first().innerText())[1],
        );
      assertNear(await least(), leastTransmission(4, 1.5, 3, 3.5), 0.06, "that of the catalogue's values");
      await changeParameter(page, "crank", 1.2);
      await isAt(plate, "/new/four-bar?crank=1.2");
      assertNear(await least(), leastTransmission(4, 1.2, 3, 3.5), 0.06, "that of the changed values");
      await changeParameter(page, "across", 1);
      await page.locator("h1").evaluate(() => document.activeElement?.blur());
      await page.keyboard.press("Control+z");
      await isAt(plate, "/new/four-bar?crank=1.2");
      assert.equal(await fieldOf(page, "crank").inputValue(), "1.2");
      // The crank is dragged.
      const before = await inputNow(page);
      const [x, y] = await gripAt(page, 2);
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x - 25, y - 12, { steps: 4 });
      await page.mouse.up();
      assert.ok(Math.abs((await inputNow(page)) - before) > 3, "the crank has turned");
      await page.locator(".plate button.pin").click();
      await page.getByRole("button", { name: "Export" }).click();
      await page.getByRole("menuitem", { name: "Copy manifest fragment" }).click();
      await eventually(
        async () => /crank = 1\.2/.test(await page.evaluate(() => navigator.clipboard.readText())),
        "it is copied as TOML",
      );
      assert.match(await page.evaluate(() => navigator.clipboard.readText()), /linkage = "four-bar"/);
      await page.locator(".site-nav a", { hasText: "Compare" }).click();
      await eventually(
        async () => (await page.locator(".pinned-tiles > li").count()) === 1,
        "it is compared",
      );
      assert.match(await plate.fragment(), /c=new%2Ffour-bar:1\.1\.1%3Fcrank%3D1\.2$/);
      const link = page.locator(".pinned-tiles .named a");
      assert.equal(await link.getAttribute("href"), "#/new/four-bar?crank=1.2");
      const swing = page
        .locator(".compared-facts tr", { hasText: "worst transmission" })
        .locator("td")
        .first();
      assertNear(
        parseFloat(await swing.textContent()),
        leastTransmission(4, 1.2, 3, 3.5),
        0.06,
        "as measured",
      );
      await plate.close();
    },
  ],
  [
    "3.61",
    "every linkage of the list has a plate, also those that only the atlas has",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/new", REDUCED_MOTION);
      const { page } = plate;
      const list = page.locator(".linkages a");
      await eventually(async () => (await list.count()) > 36, "the catalogue and others are listed");
      const names = await list.allTextContents();
      for (const name of names) {
        await plate.go(`/new/${name}`);
        await eventually(
          async () =>
            (await page.locator("h1").innerText()).startsWith(`${name} `) &&
            (await page.locator(".plate:not(.impossible) .dashes").getAttribute("d")).length > 50,
          `${name} is drawn`,
          20000,
        );
      }
      // The second trace of one, and a linkage that there is not.
      await plate.go("/new/hrones-nelson/curve/1.2.1?A=2.6");
      await eventually(async () => /1\.2\.1/.test(await page.locator("h1").innerText()), "another trace");
      assert.equal(await fieldOf(page, "A").inputValue(), "2.6");
      await plate.go("/new/nothing");
      await eventually(
        async () => /no linkage “nothing”/.test(await page.getByRole("alert").innerText()),
        "it says that there is none",
      );
      await plate.close();
    },
  ],
];
