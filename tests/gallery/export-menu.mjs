// Tests the export menu in a browser: node tests/gallery/export-menu.mjs ATLAS
//
// ATLAS is the folder of a rendered atlas that has a family `evans`. See browser.mjs for the environment.

import assert from "node:assert/strict";

import { contrastOf, eventually, openGallery, runTests, saved } from "./browser.mjs";
import { entitiesOf, filesOfZip, pointsOf } from "./export-data.mjs";

const [atlas] = process.argv.slice(2);

async function onPlate(browser, fragment, test, options) {
  const view = await openGallery(browser, atlas, fragment, { acceptDownloads: true, ...options });
  await view.page.waitForSelector(".export-button");
  await test(view.page, view);
  await view.close();
}

/**
 * Decodes an SVG in the browser, which must be well-formed: its number of animations, and of dark pixels among
 * 400 by 300.
 */
function looked(page, text) {
  return page.evaluate(async (svg) => {
    const image = new Image();
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [400, 300];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0, 400, 300);
    const { data } = context.getImageData(0, 0, 400, 300);
    let ink = 0;
    for (let k = 0; k < data.length; k += 4) ink += data[k] < 200 ? 1 : 0;
    return { animates: svg.split("<animate").length - 1, ink };
  }, text);
}

const tests = [
  [
    "6.1",
    "a curve is saved in every format",
    ({ browser }) =>
      onPlate(browser, "/evans/curve/1.1.1", async (page) => {
        const still = await saved(page, "SVG static");
        assert.equal(still.name, "evans-1-1-1.svg");
        const look = await looked(page, still.text);
        assert.equal(look.animates, 0);
        assert.ok(look.ink > 300, `${look.ink} dark pixels`);
        const moving = await saved(page, "Animated SVG .svg");
        assert.equal(moving.name, "evans-1-1-1-moving.svg");
        const moved = await looked(page, moving.text);
        assert.ok(moved.animates >= 4 && moved.ink > 300);
        const png = await saved(page, "PNG 300 dpi");
        assert.equal(png.bytes.subarray(1, 4).toString("latin1"), "PNG");
        assert.deepEqual([png.bytes.readUInt32BE(16), png.bytes.readUInt32BE(20)], [2362, 1772]);
        assert.ok(png.bytes.length > 20000, "it is not blank");
        const csv = await saved(page, "CSV points");
        const { header, rows } = pointsOf(atlas, "evans");
        // The curve is closed.
        const closed = rows.get("1.1.1").map((row) => `${row},1\n`);
        assert.equal(csv.text, `${header},closed\n${closed.join("")}`);
        const dxf = await saved(page, "DXF CAD, AutoCAD R12");
        assert.match(dxf.text, /\$ACADVER\n {2}1\nAC1009\n/);
        assert.equal(entitiesOf(dxf.text).filter(({ kind }) => kind === "POLYLINE").length, 1);
        const json = JSON.parse((await saved(page, "JSON all data")).text);
        assert.deepEqual(
          [json.curve, json.points.length, json.measures.class],
          ["evans:1.1.1", 180, "crank-rocker"],
        );
        const toml = await saved(page, "Manifest fragment .toml");
        assert.equal(toml.name, "curves.toml");
        assert.match(toml.text, /linkage = "evans"\n[\s\S]*\{ p = 2, r = 1, a = 2\.59, s = 2\.59, k = 2 \}/);
        await eventually(
          async () => (await page.textContent(".export-status")) === "Saved as curves.toml",
          "it says what it did",
        );
      }),
  ],
  [
    "6.2",
    "changed parameters are exported",
    ({ browser }) =>
      onPlate(browser, "/evans/curve/1.1.1?p=2.5", async (page) => {
        const csv = await saved(page, "CSV points");
        assert.equal(csv.name, "evans-1-1-1-p-2.5.csv");
        assert.notEqual(csv.text.split("\n")[5], `${pointsOf(atlas, "evans").rows.get("1.1.1")[4]},1`);
        const json = JSON.parse((await saved(page, "JSON all data")).text);
        assert.equal(json.parameters.p, 2.5);
        assert.match((await saved(page, "Manifest fragment .toml")).text, /p = 2\.5, /);
      }),
  ],
  [
    "6.7",
    "a circuit that the atlas does not have is exported with its number among all",
    ({ browser }) =>
      onPlate(browser, "/evans/curve/1.1.1", async (page) => {
        const aside = page.getByText("The atlas does not contain this circuit");
        assert.equal(await aside.isVisible(), false);
        await page.getByRole("radio", { name: /^2: a full turn, branch −1/ }).check();
        await aside.waitFor();
        const csv = await saved(page, "CSV points");
        assert.equal(csv.name, "evans-1-1-2-circuit-2.csv");
        const own = pointsOf(atlas, "evans").rows.get("1.1.1");
        const rows = csv.text.trimEnd().split("\n").slice(1);
        assert.equal(rows.length, own.length);
        // The branches of Evans's linkage are mirror images in the frame: at the opposite crank angle, y is.
        const place = (row) => row.split(",").slice(6, 8).map(Number);
        rows.forEach((row, k) => {
          assert.match(row, /^1,1,2,-1,/);
          const [[x, y], [u, v]] = [place(row), place(own[(own.length - k) % own.length])];
          assert.ok(Math.hypot(x - u, y + v) < 1e-12, `${row} is not the mirror image`);
        });
        for (const label of ["SVG static", "Animated SVG .svg"]) {
          const { name, text } = await saved(page, label);
          assert.match(name, /^evans-1-1-2-circuit-2(-moving)?\.svg$/);
          const look = await looked(page, text);
          assert.ok(look.ink > 300, name);
        }
        assert.equal((await saved(page, "PNG 300 dpi")).name, "evans-1-1-2-circuit-2.png");
        assert.equal(
          entitiesOf((await saved(page, "DXF CAD, AutoCAD R12")).text).filter(
            ({ kind }) => kind === "POLYLINE",
          ).length,
          1,
        );
        const json = JSON.parse((await saved(page, "JSON all data")).text);
        assert.deepEqual([json.curve, json.circuit, json.circuits.length], ["evans:1.1.2?circuit=2", 2, 2]);
        assert.equal(json.measures.class, "crank-rocker");
        const toml = await saved(page, "Manifest fragment .toml");
        assert.match(toml.text, /circuits = "all"[\s\S]*# evans:1\.1\.2\?circuit=2\n/);
        await page.evaluate(() => Object.defineProperty(navigator, "clipboard", { value: undefined }));
        await page.click(".export-button");
        await page.getByRole("menuitem", { name: "Copy command line" }).click();
        const command = await page.locator(".export-copy textarea").inputValue();
        assert.match(command, /^coupler-atlas export atlas\.toml 'evans:1\.1\.1\?circuit=2' --format /);
      }),
  ],
  [
    "6.3",
    "the command line and the fragment are copied, or shown for copying",
    async ({ browser }) => {
      await onPlate(
        browser,
        "/evans/curve/1.1.1",
        async (page) => {
          await page.click(".export-button");
          await page.getByRole("menuitem", { name: "Copy command line" }).click();
          await eventually(
            async () => (await page.textContent(".export-status")) === "Copied the command line",
            "it is copied",
          );
        },
        { permissions: ["clipboard-read", "clipboard-write"] },
      );
      const denied = (page) =>
        page.addInitScript(() => Object.defineProperty(navigator, "clipboard", { value: undefined }));
      await onPlate(
        browser,
        "/evans/curve/1.1.1?p=2.5",
        async (page) => {
          await page.click(".export-button");
          await page.getByRole("menuitem", { name: "Copy command line" }).click();
          const area = page.locator(".export-copy textarea");
          await area.waitFor();
          const [text, selected] = await area.evaluate((element) => [
            element.value,
            element.selectionEnd - element.selectionStart,
          ]);
          assert.match(text, /^coupler-atlas export atlas\.toml 'evans:1\.1\.1\?p=2\.5' --format /);
          assert.equal(selected, text.length);
          await page.keyboard.press("Escape");
          await area.waitFor({ state: "detached" });
          assert.equal(await page.evaluate(() => document.activeElement.className), "export-button");
        },
        { before: denied },
      );
    },
  ],
  [
    "6.4",
    "the menu is operated by keys, has a name, and closes",
    ({ browser }) =>
      onPlate(browser, "/evans/curve/1.1.1", async (page) => {
        const button = page.locator(".export-button");
        await button.focus();
        await page.keyboard.press("Enter");
        assert.equal(await button.getAttribute("aria-expanded"), "true");
        const at = () => page.evaluate(() => document.activeElement.firstChild.textContent);
        assert.equal(await at(), "SVG");
        await page.keyboard.press("ArrowDown");
        assert.equal(await at(), "Animated SVG");
        await page.keyboard.press("End");
        assert.equal(await at(), "Copy command line");
        await page.keyboard.press("ArrowDown");
        assert.equal(await at(), "SVG");
        await page.keyboard.press("d");
        assert.equal(await at(), "DXF");
        await page.keyboard.press("Escape");
        assert.equal(await button.getAttribute("aria-expanded"), "false");
        assert.equal(await page.evaluate(() => document.activeElement.className), "export-button");
        await page.keyboard.press("ArrowUp");
        assert.equal(await at(), "Copy command line");
        await page.keyboard.press("Tab");
        await page.waitForFunction(() => document.querySelector(".export-menu").hidden);
        await button.click();
        await page.mouse.click(5, 5);
        await page.waitForFunction(() => document.querySelector(".export-menu").hidden);
      }),
  ],
  [
    "6.5",
    "the menu is visible and legible on a narrow screen, light and dark",
    async ({ browser }) => {
      for (const colorScheme of ["light", "dark"]) {
        await onPlate(
          browser,
          "/evans/curve/1.1.1",
          async (page) => {
            await page.click(".export-button");
            const box = await page.locator(".export-menu").boundingBox();
            assert.ok(box.x >= 0 && box.x + box.width <= 360, JSON.stringify(box));
            assert.ok((await contrastOf(page.locator(".export-menu button").first())) >= 4.5);
            assert.ok((await contrastOf(page.locator(".export-menu .note").first())) >= 4.5);
          },
          { colorScheme, viewport: { width: 360, height: 800 } },
        );
      }
    },
  ],
  [
    "6.6",
    "several curves are saved as an archive, and all results of a filter as one fragment",
    async ({ browser }) => {
      await onPlate(browser, "/compare?c=evans:1.1.1,evans:2.1.1", async (page) => {
        const zip = await saved(page, "DXF CAD, AutoCAD R12");
        assert.equal(zip.name, "curves.zip");
        assert.deepEqual(
          filesOfZip(new Uint8Array(zip.bytes)).map(({ name }) => name),
          ["evans-1-1-1.dxf", "evans-2-1-1.dxf"],
        );
      });
      await onPlate(browser, "/find?family=evans", async (page) => {
        await page.waitForTimeout(500);
        const { text } = await saved(page, "Manifest fragment .toml");
        assert.equal(text.match(/\[\[family\]\]/g).length, 1);
        assert.equal(text.match(/^ {4}\{ p = /gm).length, pointsOf(atlas, "evans").rows.size);
      });
    },
  ],
];

await runTests(tests);
