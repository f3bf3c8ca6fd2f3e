// Tests the printing of search results and contact sheets.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";

const [small, large] = process.argv.slice(2);

/**
 * Prints a page as PDF: { sheets, line, places, drawn, rows }: the number of sheets of paper, the line about
 * the extent of the print, the positions of the printed tiles, counted from 1, the number of drawn tiles, and
 * the number of rows of a table.
 */
async function printed(page) {
  await page.evaluate(() => {
    const tell = () => {
      window.toldOnPaper = {
        line: document.querySelector(".on-paper")?.textContent,
        places: [...document.querySelectorAll(".window > li")].map((tile) => +tile.ariaPosInSet),
        drawn: document.querySelectorAll(".window .thumbnail path").length,
        rows: document.querySelectorAll(".results-table tbody tr[aria-rowindex]").length,
      };
    };
    window.addEventListener("beforeprint", tell, { once: true });
  });
  const pdf = await page.pdf({ format: "A4", margin: { left: "12mm", right: "12mm" } });
  const sheets = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g).length;
  return { sheets, ...(await page.evaluate(() => window.toldOnPaper)) };
}

/**
 * The elements that in print extend beyond the right edge of the paper, or may be split between two sheets.
 */
async function strayedOnPaper(page) {
  const { width, height } = page.viewportSize();
  await page.emulateMedia({ media: "print" });
  // A sheet of A4 without its margins.
  await page.setViewportSize({ width: 703, height: 1000 });
  const strayed = await page.evaluate(() => {
    const all = [...document.querySelectorAll("main *")].filter((one) => one.checkVisibility());
    const over = all.filter((one) => one.getBoundingClientRect().right > window.innerWidth + 0.5);
    const split = all
      .filter((one) => one.matches(".window > li, .matches > li, .pinned-tiles > li, tr"))
      .filter((one) => getComputedStyle(one).breakInside !== "avoid");
    return [...over, ...split].map((one) => `${one.localName}.${one.className}`);
  });
  await page.emulateMedia({ media: null });
  await page.setViewportSize({ width, height });
  return strayed;
}

export const PRINTING = [
  [
    "7.i",
    "the first tiles are printed completely at any scroll position, and counted",
    async ({ browser }) => {
      const gallery = await openGallery(browser, large, "/find");
      const { page } = gallery;
      await eventually(async () => (await page.locator(".results > li").count()) > 20, "tiles come", 20000);
      await page.evaluate(() => window.scrollTo(0, 40000));
      await eventually(
        async () => (await page.locator(".results > li[aria-posinset='1']").count()) === 0,
        "the window is far down",
      );
      const { sheets, line, places, drawn } = await printed(page);
      assert.equal(line, "Printed: the first 400 of 7,800 curves");
      assert.deepEqual(
        places,
        Array.from({ length: 400 }, (_, k) => k + 1),
      );
      assert.equal(drawn, 400);
      assert.ok(sheets >= 15 && sheets <= 30, `${sheets} sheets`);
      assert.equal(await page.locator(".on-paper").count(), 0, "the line is on paper alone");
      assert.ok((await page.locator(".results > li").count()) < 120, "few tiles are in the page again");
      assert.deepEqual(await strayedOnPaper(page), []);
      await gallery.go("/hrones-nelson?show=curves");
      assert.equal((await printed(page)).places.length, 400);
      await gallery.close();
    },
  ],
  [
    "7.j",
    "all results of a filter are printed, as tiles and as a table",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/find?family=evans,watt");
      const { page } = gallery;
      await eventually(async () => (await page.locator(".results > li").count()) === 24, "tiles come");
      assert.equal((await printed(page)).line, "Printed: all 24 curves");
      await gallery.go("/evans?show=curves");
      assert.equal((await printed(page)).line, "Printed: all 10 curves");
      await gallery.go("/find?show=table");
      const rows = () => page.locator(".results-table tbody tr[aria-rowindex]").count();
      await eventually(async () => /^439 of/.test(await page.locator(".counted b").innerText()), "all come");
      await eventually(async () => (await rows()) > 10, "rows come");
      const table = await printed(page);
      assert.deepEqual([table.line, table.rows], ["Printed: all 439 curves", 439]);
      assert.ok((await rows()) < 100, "few rows are in the page again");
      await gallery.close();
    },
  ],
  [
    "7.k",
    "the curves are printed within the edges of the paper, the controls are not",
    async ({ browser }) => {
      for (const [address, there, gone] of [
        ["/find?family=evans,watt", ".results > li", ".find-panel, .export, .toolbar"],
        ["/find?show=table&family=evans", ".results-table", ".find-panel, .results-table .pin"],
        ["/shape?like=evans:2.1.1", ".matches > li", ".shape-options, .acts, textarea"],
        ["/compare?c=evans:1.1.1,watt:2.1.1", ".pinned-tiles > li", ".acts, .toolbar"],
      ]) {
        const gallery = await openGallery(browser, small, address, { colorScheme: "dark" });
        const { page } = gallery;
        await page.locator(there).first().waitFor({ timeout: 20000 });
        await page.emulateMedia({ media: "print" });
        assert.equal(await page.locator(gone).filter({ visible: true }).count(), 0, address);
        assert.ok(await page.locator(there).first().isVisible(), address);
        assert.deepEqual(await strayedOnPaper(page), [], address);
        await gallery.close();
      }
    },
  ],
];
