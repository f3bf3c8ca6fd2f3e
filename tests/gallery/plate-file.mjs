// Tests the file of a plate in a browser: node tests/gallery/plate-file.mjs ATLAS
//
// ATLAS is the folder of a rendered atlas that has a family `evans`. See browser.mjs for the environment.

import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { eventually, openGallery, runTests, saved } from "./browser.mjs";

const [atlas] = process.argv.slice(2);
const HOSTILE = '</script><script>document.title="run"</script>&amp;"\'<b>';
const OFFLINE = { offline: true, acceptDownloads: true };

const temporary = () => mkdtempSync(join(tmpdir(), "gallery-"));

/** A copy of the atlas with titles that would end the element of the data, or be elements, if they were not escaped. */
function hostileAtlas() {
  const folder = temporary();
  for (const part of ["index.html", "kernel.js", "evans"])
    cpSync(join(atlas, part), join(folder, part), { recursive: true });
  const title = JSON.stringify(HOSTILE).replaceAll("<", "\\u003c");
  const page = readFileSync(join(folder, "index.html"), "utf8");
  writeFileSync(
    join(folder, "index.html"),
    page.replace(/"title":"An atlas[^"]*"/, () => `"title":${title}`),
  );
  const script = readFileSync(join(folder, "evans/gallery.js"), "utf8");
  writeFileSync(
    join(folder, "evans/gallery.js"),
    script.replace(/"title":"Evans[^"]*"/, () => `"title":${title}`),
  );
  return folder;
}

/** Saves the file of a plate, and opens it alone in a folder, without a network; its folder is `folder`. */
async function openAlone(browser, from, fragment) {
  const view = await openGallery(browser, from, fragment, { acceptDownloads: true });
  await view.page.waitForSelector(".export-button");
  const file = await saved(view.page, "HTML this plate in one file");
  await view.close();
  const folder = temporary();
  writeFileSync(join(folder, "index.html"), file.bytes);
  const alone = await openGallery(browser, folder, "", OFFLINE);
  await alone.page.waitForSelector(".stage svg");
  return { file, alone, folder };
}

const tests = [
  [
    "7.1",
    "the plate is alone in its file: moved, changed, undone and exported as in the atlas",
    async ({ browser }) => {
      const { file, alone, folder } = await openAlone(browser, atlas, "/evans/curve/2.1.1?p=2.5&at=40");
      const { page } = alone;
      assert.equal(file.name, "evans-2-1-1-p-2.5.html");
      assert.equal(await alone.fragment(), "/evans/curve/2.1.1?p=2.5&at=40");
      assert.match(file.text, /script-src 'wasm-unsafe-eval' 'sha256-/);
      assert.ok(!file.text.includes("'self'"), "nothing beside the file is read");
      const origin = await page.textContent(".origin");
      const atOrigin = async (test) => {
        const view = await openGallery(browser, atlas, "/evans/curve/2.1.1?p=2.5", OFFLINE);
        await view.page.waitForSelector(".export-button");
        const answer = await test(view.page);
        await view.close();
        return answer;
      };
      const rows = ".measures tbody tr:not([hidden])";
      const [measures, csv] = await atOrigin(async (there) => [
        await there.locator(rows).allTextContents(),
        (await saved(there, "CSV points")).text,
      ]);
      assert.ok(measures.length > 10);
      assert.deepEqual(await page.locator(rows).allTextContents(), measures);
      assert.match(origin, /2, 1, 1/);
      assert.equal((await saved(page, "CSV points")).text, csv);
      const slider = page.locator(".parameter input[type=range]").first();
      await slider.focus();
      await page.keyboard.press("ArrowRight");
      await eventually(async () => !(await alone.fragment()).includes("p=2.5&"), "the slider moves");
      await page.keyboard.press("Control+z");
      await eventually(
        async () => (await alone.fragment()) === "/evans/curve/2.1.1?p=2.5&at=40",
        "it is undone",
      );
      await page.getByRole("button", { name: "Play" }).click();
      const input = () => page.locator(".transport input[type=text]").inputValue();
      const before = await input();
      await eventually(async () => (await input()) !== before, "it moves");
      // The file saves itself.
      assert.equal((await saved(page, "HTML this plate in one file")).text.length > 1e6, true);
      assert.ok(
        alone.requests.every((url) => /^blob:|index\.html/.test(url)),
        alone.requests.join("\n"),
      );
      assert.deepEqual(readdirSync(folder), ["index.html"]);
      await alone.close();
      rmSync(folder, { recursive: true });
    },
  ],
  [
    "7.2",
    "it leads to nothing that it has not, and says so",
    async ({ browser }) => {
      const { alone, folder } = await openAlone(browser, atlas, "/evans/curve/1.1.1");
      const { page } = alone;
      const links = () => page.locator("a").evaluateAll((all) => all.map((a) => a.getAttribute("href")));
      assert.deepEqual(await links(), ["#content", "#/evans/curve/1.1.1"]);
      assert.equal(
        await page.getByRole("menuitem", { name: "Copy command line", includeHidden: true }).count(),
        0,
      );
      for (const other of [
        "/",
        "/find",
        "/evans",
        "/evans/curve/2.1.1",
        "/watt/curve/1.1.1",
        "/new/four-bar",
      ]) {
        await alone.go(other);
        assert.match(await page.textContent("main"), /This file has only one plate/, other);
        assert.deepEqual(await links(), ["#content", "#/evans/curve/1.1.1", "#/evans/curve/1.1.1"]);
      }
      await page.getByRole("link", { name: "The plate" }).click();
      await page.waitForSelector(".stage svg");
      await alone.close();
      rmSync(folder, { recursive: true });
    },
  ],
  [
    "7.3",
    "titles are texts, and a linkage in no family has a file, too",
    async ({ browser }) => {
      const hostile = hostileAtlas();
      const { alone, folder } = await openAlone(browser, hostile, "/evans/curve/1.1.1");
      assert.equal(await alone.page.title(), `${HOSTILE}, 1.1.1 · ${HOSTILE}`);
      assert.equal(await alone.page.textContent(".masthead .title"), HOSTILE);
      await alone.close();
      const made = await openAlone(browser, atlas, "/new/four-bar?crank=0.9");
      assert.equal(await made.alone.fragment(), "/new/four-bar?crank=0.9");
      await made.alone.page.waitForSelector(".changed-tag:not([hidden])");
      await made.alone.close();
      for (const one of [hostile, folder, made.folder]) rmSync(one, { recursive: true });
    },
  ],
  [
    "7.4",
    "another circuit, a linkage that is driven by a length and changed values are in the file",
    async ({ browser }) => {
      for (const fragment of [
        "/evans/curve/1.1.1?circuit=2",
        "/linear-actuator/curve/2.1.1",
        "/excavator/curve/1.1.1?at=0.9",
      ]) {
        const { alone, folder } = await openAlone(browser, atlas, fragment);
        const there = await openGallery(browser, atlas, fragment, OFFLINE);
        await there.page.waitForSelector(".export-button");
        const facts = (page) =>
          page
            .locator(".measures tbody tr:not([hidden]), .ends, .parameter, .circuits label")
            .allTextContents();
        assert.deepEqual(await facts(alone.page), await facts(there.page), fragment);
        const csv = (await saved(there.page, "CSV points")).text;
        assert.equal((await saved(alone.page, "CSV points")).text, csv, fragment);
        await there.close();
        await alone.close();
        rmSync(folder, { recursive: true });
      }
    },
  ],
];

await runTests(tests);
