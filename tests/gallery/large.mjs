// Tests a family that is larger than the page loads without a request:
// node tests/gallery/large.mjs SMALL-ATLAS LARGE-ATLAS
//
// The second folder is an atlas of one family of thousands of curves, of which a larger one is made.

import assert from "node:assert/strict";

import { eventually, openGallery, runTests } from "./browser.mjs";
import { largeAtlas } from "./large-atlas.mjs";

const [, from] = process.argv.slice(2);

// The page loads 48 MB without a request: 15 of 30 pieces of the table, or 21 of the points.
const COPIES = 30;

/** The pieces that a page has requested, "table-0001", …, each once. */
const piecesOf = ({ requests }) => [
  ...new Set(requests.map((url) => url.match(/gallery-(\w+-\d+)\.js$/)?.[1]).filter(Boolean)),
];
const pieceName = (series, number) => `${series}-${String(number).padStart(4, "0")}`;

/** The bytes of arrays of a page after garbage collection. */
async function arrayBytes(page) {
  const client = await page.context().newCDPSession(page);
  await client.send("HeapProfiler.collectGarbage");
  const { backingStorageSize } = await client.send("Runtime.getHeapUsage");
  await client.detach();
  return backingStorageSize;
}

const counted = (page) => page.locator(".counted").first().innerText();
const isLoaded = async (page) => /\d of [\d,]+ curves$/.test(await counted(page));

const tests = [
  [
    "9.1",
    "the overview loads no pieces",
    async ({ browser, atlas }) => {
      const gallery = await openGallery(browser, atlas.folder, "/");
      const hasHead = () => gallery.requests.some((file) => file.endsWith("/gallery.js"));
      await eventually(hasHead, "the family is loaded");
      await gallery.settled();
      assert.deepEqual(piecesOf(gallery), []);
      await gallery.close();
    },
  ],
  [
    "9.2",
    "a family loads the pieces in view, of its pages and of its curves",
    async ({ browser, atlas }) => {
      const gallery = await openGallery(browser, atlas.folder, `/${atlas.id}`);
      const { page } = gallery;
      await page.waitForSelector(".window svg path");
      assert.deepEqual(piecesOf(gallery).sort(), ["curves-0001", "table-0001"]);
      assert.match(await page.locator(".window > li").first().innerText(), /A\s=/);
      // The keys go to the end at once; nothing between is loaded.
      await page.locator(".window > li a").first().focus();
      await page.keyboard.press("End");
      const last = page.locator(`.window > li[aria-posinset="${COPIES * atlas.pages}"]`);
      await last.locator("svg path").first().waitFor({ state: "attached" });
      const loaded = piecesOf(gallery);
      assert.ok(loaded.includes(pieceName("curves", COPIES)) && loaded.length <= 6, loaded.join());
      await gallery.go(`/${atlas.id}?show=curves`);
      await page.waitForSelector(".window svg path");
      await page.locator(".window > li a").first().focus();
      await page.keyboard.press("End");
      const curve = page.locator(`.window > li[aria-posinset="${COPIES * atlas.curves}"]`);
      await curve.locator("svg path").waitFor({ state: "attached" });
      assert.match(
        await curve.locator("a").getAttribute("href"),
        new RegExp(`/curve/${COPIES * atlas.cells}\\.`),
      );
      assert.deepEqual(piecesOf(gallery), loaded, "these pieces were loaded before");
      await gallery.close();
    },
  ],
  [
    "9.3",
    "a plate and a page load their pieces",
    async ({ browser, atlas }) => {
      const number = 11 * atlas.cells + 1;
      const gallery = await openGallery(browser, atlas.folder, `/${atlas.id}/curve/${number}.2.1`);
      const { page } = gallery;
      await page.waitForSelector(".plate");
      assert.deepEqual(piecesOf(gallery).sort(), [pieceName("curves", 12), pieceName("table", 12)]);
      await page.getByRole("link", { name: /^page \d+$/ }).click();
      await page.waitForSelector(".overlay a[data-curve]", { state: "attached" });
      assert.equal(piecesOf(gallery).length, 2);
      await gallery.go(`/${atlas.id}/${20 * atlas.pages + 1}`);
      await eventually(async () => piecesOf(gallery).length === 4, "the pieces of the other page come");
      await gallery.close();
    },
  ],
  [
    "9.4",
    "Find says what is not loaded, and loads it on request",
    async ({ browser, atlas }) => {
      const gallery = await openGallery(browser, atlas.folder, "/find");
      const { page } = gallery;
      await eventually(() => isLoaded(page), "the first pieces are loaded", 60000);
      const offered = page.locator(".load-all");
      const total = COPIES * atlas.curves;
      const loaded = Number((await counted(page)).match(/of ([\d,]+) curves/)[1].replaceAll(",", ""));
      assert.ok(loaded >= atlas.curves && loaded < total, `${loaded} of ${total}`);
      assert.equal(loaded % atlas.curves, 0);
      const [rest, all] = [total - loaded, total].map((number) => number.toLocaleString("en"));
      const words = await offered.innerText();
      assert.ok(words.includes(`${rest} curves are not loaded`), words);
      assert.ok(words.includes(`Load all ${all} curves (`), words);
      await offered.getByRole("button").click();
      await eventually(
        async () => (await isLoaded(page)) && (await counted(page)).endsWith(`of ${all} curves`),
        "all pieces are loaded",
        60000,
      );
      assert.ok(!(await offered.isVisible()));
      const tables = piecesOf(gallery).filter((name) => name.startsWith("table"));
      assert.equal(tables.length, COPIES);
      const points = piecesOf(gallery).length - tables.length;
      assert.ok(points <= 2, `${points} pieces of points`);
      await page.getByRole("button", { name: "Table", exact: true }).click();
      const scroll = page.getByRole("region", { name: "Table of curves" });
      await scroll.evaluate((element) => element.scrollTo(0, element.scrollHeight));
      await page.locator(`tr[aria-rowindex="${total + 1}"]`).waitFor();
      const before = await arrayBytes(page);
      await gallery.go("/");
      const after = await arrayBytes(page);
      console.log(
        `     ${(before / 1e6).toFixed(0)} MB of arrays, and ${(after / 1e6).toFixed(0)} MB after leaving`,
      );
      assert.ok(after < before - 10e6, "the columns, filters and histograms are released");
      await gallery.close();
    },
  ],
  [
    "9.5",
    "By shape says what is not searched, and searches all on request",
    async ({ browser, atlas }) => {
      const like = `${atlas.id}:${COPIES * atlas.cells}.1.1`;
      const gallery = await openGallery(browser, atlas.folder, `/shape?like=${like}`);
      const { page } = gallery;
      const ranked = page.locator(".matches:not([aria-busy]) > li");
      await ranked.first().waitFor({ timeout: 120000 });
      const total = (COPIES * atlas.curves).toLocaleString("en");
      const sentence = await counted(page);
      assert.match(sentence, /^The (\d+ )?nearest of [\d,]+ curves/);
      assert.ok(!sentence.includes(total), sentence);
      assert.ok((await page.locator(".load-all").innerText()).includes(`Load all ${total} curves (`));
      await page.locator(".load-all button").click();
      await eventually(
        async () => (await counted(page)).includes(`nearest of ${total} curves`),
        "all are searched",
        240000,
      );
      assert.ok(!(await page.locator(".load-all").isVisible()));
      const points = Array.from({ length: COPIES }, (_, k) => pieceName("curves", k + 1));
      assert.deepEqual(piecesOf(gallery).sort(), points, "no table is loaded");
      // The bytes of scripts count as those of arrays: neither stay.
      const bytes = await arrayBytes(page);
      console.log(`     ${(bytes / 1e6).toFixed(0)} MB of arrays after all were searched`);
      assert.ok(bytes < 70e6, `${bytes} bytes`);
      // The copies are alike: those of the same curve come first, with no deviation, and are one answer.
      const title = await ranked.first().locator(".label[title]").getAttribute("title");
      const keys = title.split(", ").map((name) => {
        const [, cell, rest] = name.match(/:(\d+)\.(.*)$/);
        return `${(cell - 1) % atlas.cells}.${rest}`;
      });
      assert.ok(keys.filter((one) => one === `${atlas.cells - 1}.1.1`).length >= COPIES - 5, title);
      await gallery.close();
    },
  ],
  [
    "9.6",
    "By shape without a family says that no curves are loaded",
    async ({ browser, atlas }) => {
      const gallery = await openGallery(browser, atlas.folder, `/shape?like=${atlas.id}:1.1.1&family=none`);
      const { page } = gallery;
      await eventually(async () => /^No curves are loaded/.test(await counted(page)), "it says so");
      assert.equal(await page.locator(".matches > li").count(), 0);
      await gallery.close();
    },
  ],
  [
    "9.7",
    "points that are out of view are dropped",
    async ({ browser, atlas }) => {
      const gallery = await openGallery(browser, atlas.folder, `/${atlas.id}?show=curves`);
      const { page } = gallery;
      await page.waitForSelector(".window svg path");
      const pitch = await page.evaluate(() => document.documentElement.scrollHeight);
      const visit = async (k) => {
        await page.evaluate((y) => window.scrollTo(0, y), ((k + 0.5) * pitch) / COPIES);
        await eventually(
          () => piecesOf(gallery).includes(pieceName("curves", k + 1)),
          `piece ${k + 1} is loaded`,
        );
        await page.waitForSelector(".window svg path");
      };
      for (let k = 0; k < COPIES; k += 1) await visit(k);
      await gallery.settled();
      const bytes = await arrayBytes(page);
      console.log(`     ${(bytes / 1e6).toFixed(0)} MB of arrays after ${COPIES} pieces`);
      assert.ok(bytes < 160e6, `${bytes} bytes`);
      // A piece that was dropped is loaded again.
      const before = gallery.requests.length;
      await page.evaluate(() => window.scrollTo(0, 0));
      await page.locator('.window > li[aria-posinset="1"] svg path').waitFor({ state: "attached" });
      assert.ok(gallery.requests.slice(before).some((url) => url.endsWith("gallery-curves-0001.js")));
      await gallery.close();
    },
  ],
];

const atlas = largeAtlas(from, COPIES);
process.on("exit", () => atlas.remove());
await runTests(tests, { atlas });
