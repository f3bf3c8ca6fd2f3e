// Tests filters in Find that leave nothing, and the labels of results.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";

const [small, large] = process.argv.slice(2);

const counted = (page) => page.locator(".counted b").innerText();

export const FILTERING = [
  [
    "4.9",
    "filters that leave nothing are listed, each with the count without it",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/find?mu_worst_deg=60..&class=drag-link");
      const { page } = gallery;
      const message = () => page.locator(".found").innerText();
      await eventually(async () => /No curve passes/.test(await message()), "it is reported");
      assert.equal(await counted(page), "0 of 439 curves");
      const without = page.getByRole("button", { name: /^Remove class of the four-bar: / });
      const left = (await without.innerText()).match(/(\d+) curves?$/)[1];
      assert.ok(Number(left) > 0);
      await without.press("Enter");
      assert.equal(await counted(page), `${left} of 439 curves`);
      assert.equal(await page.locator(".results > li").count(), Number(left));
      assert.ok(
        await page.evaluate(() => document.querySelector("main").contains(document.activeElement)),
        "the focus is not lost",
      );
      await page.getByRole("button", { name: "Clear all filters" }).press("Enter");
      assert.equal(await counted(page), "439 of 439 curves");
      assert.equal(await page.getByRole("button", { name: "Clear all filters" }).count(), 0);
      // An address may name a parameter that no family here has.
      await gallery.go("/find?p.nothing=1..2");
      await page.getByRole("button", { name: "Remove p.nothing: 439 curves" }).click();
      assert.equal(await counted(page), "439 of 439 curves");
      await gallery.close();
    },
  ],
  [
    "4.10",
    "inputs that are lengths have no degrees, and the sorted column is visible",
    async ({ browser }) => {
      const gallery = await openGallery(
        browser,
        small,
        "/find?family=linear-actuator,evans&sort=straight_start_deg&show=table",
      );
      const { page } = gallery;
      const table = page.locator(".results-table");
      await eventually(async () => (await table.locator("tbody th").count()) > 15, "all are there");
      assert.match(await table.locator("thead").innerText(), /curve\s+input at the start of the straight/);
      const rows = await table
        .locator("tbody tr")
        .evaluateAll((lines) => lines.map(({ cells }) => [cells[0].textContent, cells[1].textContent]));
      for (const [name, text] of rows)
        assert.equal(text.endsWith("°"), name.startsWith("evans"), `${name}: ${text}`);
      const link = table.locator("tbody a").nth(2);
      await link.focus();
      await page.keyboard.press("p");
      assert.match(await page.locator(".site-nav .count").innerText(), /1/);
      await gallery.close();
    },
  ],
  [
    "4.11",
    "tiles of points of one linkage have the number of the point",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/find?family=hrones-nelson");
      const { page } = gallery;
      await eventually(async () => (await page.locator(".results > li").count()) > 9, "they are there");
      const labels = await page.locator(".results .label").allInnerTexts();
      assert.ok(labels.slice(0, 10).every((label, k) => label.startsWith(`point ${k + 1} · `)));
      await gallery.close();
    },
  ],
  [
    "4.12",
    "going back from a plate restores the scroll position of the results",
    async ({ browser }) => {
      const gallery = await openGallery(browser, large, "/find?class=change-point");
      const { page } = gallery;
      await eventually(async () => /^2,250 of/.test(await counted(page)), "all are there");
      await page.evaluate(() => window.scrollTo(0, 20000));
      await gallery.settled();
      const names = () => page.locator(".results > li > a").evaluateAll((links) => links.map((a) => a.href));
      // The tiles in the window follow the scrolling: they are those further down when they stay.
      let last = "";
      const stay = async () => {
        const [before, now] = [last, (await names()).join()];
        last = now;
        await page.waitForTimeout(100);
        return now === before && !now.split(",")[0].endsWith("/1.1.1");
      };
      await eventually(stay, "tiles further down are there");
      const href = await page.locator(".results > li > a").nth(20).getAttribute("href");
      const link = page.locator(`.results > li > a[href="${href}"]`);
      const depth = await link.evaluate((a) => {
        a.scrollIntoView({ block: "center" });
        return window.scrollY;
      });
      await link.click();
      await page.waitForSelector(".plate");
      await page.goBack();
      await eventually(
        () => page.evaluate((at) => document.activeElement.getAttribute("href") === at, href),
        "the focus is where it was",
      );
      assert.ok(Math.abs((await page.evaluate(() => window.scrollY)) - depth) < 2, "as far down as before");
      await gallery.close();
    },
  ],
  [
    "4.16",
    "the linkage with the longest straight portion is found and opened by few keys, from the list of families",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/");
      const { page } = gallery;
      const keys = [];
      const press = async (key) => {
        keys.push(key);
        await page.keyboard.press(key);
      };
      const focused = () =>
        page.evaluate(() => {
          const { id, dataset, textContent, nodeName } = document.activeElement;
          return id || dataset.name || (nodeName === "BODY" ? "" : textContent.trim());
        });
      const tabTo = async (what) => {
        for (let k = 0; k < 20 && !what.test(await focused()); k += 1) await press("Tab");
        assert.match(await focused(), what);
      };
      await tabTo(/^Find$/);
      await press("Enter");
      await eventually(async () => (await counted(page)) === "439 of 439 curves", "tables are loaded");
      await tabTo(/^find-sort$/);
      // The first column that begins with it.
      await press("l");
      await eventually(
        async () => /sort=-straight_length/.test(await gallery.fragment()),
        "the greatest first",
      );
      const best = () => page.locator(".results a").first().getAttribute("data-name");
      await eventually(async () => (await best()) !== null, "results are shown");
      const name = await best();
      await tabTo(/:/);
      assert.equal(await focused(), name);
      await press("Enter");
      const address = `/${name.replace(":", "/curve/")}`;
      await eventually(async () => (await gallery.fragment()).startsWith(address), "it is opened");
      console.log(`  ${keys.length} keys: ${keys.join(" ")}`);
      assert.ok(keys.length < 25);
      // The filters follow the results, and links lead to both.
      await gallery.go("/find");
      await page.getByRole("link", { name: "Skip to filters" }).press("Enter");
      assert.match(await focused(), /^Filters/);
      await page.getByRole("link", { name: "Skip to results" }).press("Enter");
      await page.keyboard.press("Tab");
      assert.match(await focused(), /:/);
      await gallery.close();
    },
  ],
  [
    "4.17",
    "sorting begins with the best: the greatest or the least, by the measure",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/find?show=table");
      const { page } = gallery;
      const sorted = async (label, order) => {
        await page.getByRole("columnheader", { name: label }).getByRole("button").click();
        const sort = () => page.getByRole("columnheader", { name: label }).getAttribute("aria-sort");
        await eventually(async () => (await sort()) === order, `${label} is ${order}`);
      };
      await sorted("worst transmission angle", "descending");
      await sorted("worst transmission angle", "ascending");
      await sorted("deviation of the straight portion over its length", "ascending");
      await sorted("length of the straight portion over the curve's extent", "descending");
      await sorted("length of the curve", "ascending");
      await page.getByLabel("Sort by").selectOption("dwell_input_deg");
      await eventually(
        async () => /sort=-dwell_input_deg/.test(await gallery.fragment()),
        "in the select, too",
      );
      await gallery.close();
    },
  ],
];
