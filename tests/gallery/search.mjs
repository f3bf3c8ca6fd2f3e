// Tests Find, By shape and Compare in Chromium: node tests/gallery/search.mjs SMALL-ATLAS LARGE-ATLAS
//
// The first folder is an atlas of several families with "evans" and "watt" among them, the second one of
// thousands of curves.

import assert from "node:assert/strict";

import { eventually, openGallery, runTests } from "./browser.mjs";
import { ADDRESSES } from "./addresses.mjs";
import { FOUR_BARS } from "./four-bars.mjs";
import { COMPARING } from "./compare.mjs";
import { kernelOf } from "./kernel.mjs";
import { browserBoxes, readBoxes, DRAWING } from "./pasted-drawing.mjs";
import { FILTERING } from "./search-filters.mjs";
import { PRINTING } from "./printing.mjs";

const [small, large] = process.argv.slice(2);

const count = (page) => page.locator(".counted b").innerText();
const loaded = (page) =>
  eventually(
    async () =>
      /of/.test(await count(page)) && !(await page.locator(".counted").innerText()).includes("loaded"),
    "families come",
    20000,
  );
const numberLeft = async (page) => Number((await count(page)).split(" ")[0].replace(",", ""));
const ranked = (page, within = 30000) =>
  eventually(
    async () =>
      (await page.locator(".matches > li").count()) > 0 &&
      (await page.locator(".matches[aria-busy]").count()) === 0,
    "curves are ranked",
    within,
  );

const leastPlaces = (page) =>
  page.locator(".over path").evaluateAll((paths) => {
    const places = paths.map((path) => path.getAttribute("d").split("L").length);
    return places.length ? Math.min(...places) : 0;
  });

const tests = [
  [
    "4.1",
    "a filter takes effect at once, and is in the address",
    async ({ browser }) => {
      const gallery = await openGallery(browser, large, "/find");
      const { page } = gallery;
      await loaded(page);
      const all = await numberLeft(page);
      await page.getByLabel("worst transmission angle, at least").fill("30");
      await page.keyboard.press("Enter");
      await eventually(async () => (await numberLeft(page)) < all, "fewer are left");
      const left = await numberLeft(page);
      const time = await page.locator(".find-view").getAttribute("data-milliseconds");
      console.log(`  ${left} of ${all} in ${time} ms`);
      await eventually(
        async () => (await gallery.fragment()).includes("mu_worst_deg=30.."),
        "the address has it",
      );
      assert.ok((await page.locator(".results > li").count()) < 120, "few tiles are in the page");
      await page.reload();
      await loaded(page);
      assert.equal(await numberLeft(page), left);
      await gallery.close();
    },
  ],
  [
    "4.2",
    "the ends of a range move by keys and by dragging",
    async ({ browser }) => {
      const gallery = await openGallery(browser, large, "/find");
      const { page } = gallery;
      await loaded(page);
      const end = page.getByRole("slider", { name: "worst transmission angle, minimum" });
      await end.focus();
      const all = await numberLeft(page);
      for (let k = 0; k < 5; k += 1) await page.keyboard.press("PageUp");
      const byKeys = await numberLeft(page);
      assert.ok(byKeys < all);
      const track = await page.locator(".range .track").first().boundingBox();
      const box = await end.boundingBox();
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.mouse.down();
      await page.mouse.move(track.x + 0.8 * track.width, box.y, { steps: 10 });
      await page.mouse.up();
      assert.ok((await numberLeft(page)) < byKeys);
      await gallery.close();
    },
  ],
  [
    "4.3",
    "words, sorting, the table, arrows, Enter and p work",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/find?sort=-length");
      const { page } = gallery;
      await loaded(page);
      const all = await numberLeft(page);
      await page.getByLabel("crank-rocker").first().check();
      assert.ok((await numberLeft(page)) < all);
      const values = await page.locator(".results .label > b").allInnerTexts();
      const numbers = values.map(Number);
      assert.deepEqual(
        numbers,
        [...numbers].sort((a, b) => b - a),
        "the longest first",
      );
      const links = page.locator(".results a");
      const third = await links.nth(2).getAttribute("data-name");
      await links.first().focus();
      await page.keyboard.press("ArrowRight");
      await page.keyboard.press("ArrowRight");
      assert.equal(await page.evaluate(() => document.activeElement.dataset.name), third);
      await page.keyboard.press("p");
      await eventually(
        async () => (await page.locator(".site-nav .count").innerText()).includes("1"),
        "it is pinned",
      );
      await page.getByRole("button", { name: "Table" }).click();
      await page.getByRole("columnheader", { name: "class" }).getByRole("button").click();
      const sort = () => page.getByRole("columnheader", { name: "class" }).getAttribute("aria-sort");
      await eventually(async () => (await sort()) === "ascending", "the table is sorted");
      await eventually(
        async () => (await gallery.fragment()).includes("show=table"),
        "the table has an address",
      );
      assert.match(
        await page.evaluate(() => document.activeElement.textContent),
        /^class/,
        "the heading keeps the focus",
      );
      await page.getByRole("button", { name: "Grid" }).click();
      await page.locator(".results a").first().focus();
      await page.keyboard.press("Enter");
      await eventually(async () => (await gallery.fragment()).includes("/curve/"), "Enter opens the plate");
      await gallery.close();
    },
  ],
  [
    "4.4",
    "thousands of results scroll with few elements",
    async ({ browser }) => {
      const gallery = await openGallery(browser, large, "/find");
      const { page } = gallery;
      await loaded(page);
      const longest = await page.evaluate(async () => {
        let worst = 0;
        for (let k = 0; k < 40; k += 1) {
          const began = performance.now();
          window.scrollBy(0, 700);
          await new Promise((done) => {
            requestAnimationFrame(() => requestAnimationFrame(done));
          });
          worst = Math.max(worst, performance.now() - began);
        }
        return worst;
      });
      console.log(`  two frames of scrolling in at most ${Math.round(longest)} ms`);
      assert.ok((await page.locator("main *").count()) < 2500);
      await gallery.close();
    },
  ],
  [
    "4.5",
    "a curve of the atlas is its own best match, shown as an overlay",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape?like=evans:2.1.1");
      const { page } = gallery;
      await ranked(page);
      const names = await page
        .locator(".matches .label[title]")
        .evaluateAll((labels) => labels.map((label) => label.title.split(", ")));
      assert.ok(names[0].includes("evans:2.1.1"), `${names[0]}`);
      // Families overlap: the same curve of another one is in the same tile, and no curve is in two.
      assert.ok(names[0].length > 1, `${names[0]}`);
      assert.equal(new Set(names.flat()).size, names.flat().length);
      assert.match(await page.locator(".matches .label b").first().innerText(), /^0\.0\d % rms$/);
      assert.equal(
        await page.locator(".matches .query-shape").count(),
        await page.locator(".matches > li").count(),
      );
      await gallery.close();
    },
  ],
  [
    "4.6",
    "a curve is drawn with the pointer, and found among thousands",
    async ({ browser }) => {
      const gallery = await openGallery(browser, large, "/shape");
      const { page } = gallery;
      const pad = await page.locator(".pad").boundingBox();
      const at = (angle) => [
        pad.x + pad.width * (0.5 + 0.35 * Math.cos(angle)),
        pad.y + pad.height * (0.5 + 0.2 * Math.sin(angle)),
      ];
      await page.mouse.move(...at(0));
      await page.mouse.down();
      for (let k = 1; k <= 60; k += 1) await page.mouse.move(...at((2 * Math.PI * k) / 60));
      await page.mouse.up();
      await ranked(page);
      console.log(`  searched in ${await page.locator(".shape-view").getAttribute("data-milliseconds")} ms`);
      const first = await page.locator(".matches .label b").first().innerText();
      assert.ok(parseFloat(first) < 2, `an ellipse, nearly: ${first}`);
      const fragment = await gallery.fragment();
      assert.match(fragment, /d=c[\w-]{60,}/);
      const name = await page.locator(".matches a").first().getAttribute("data-name");
      await page.reload();
      await ranked(page);
      const again = await page
        .locator(".matches > li > a")
        .evaluateAll((links) => links.slice(0, 5).map((link) => link.dataset.name));
      assert.ok(again.includes(name), "the address draws it again");
      await page.getByLabel("a part of a curve, at least").check();
      await eventually(
        async () => (await gallery.fragment()).includes("part=yes"),
        "parts are in the address",
      );
      await eventually(
        async () => / % of the curve/.test(await page.locator(".matches .label").first().innerText()),
        "parts are found",
        60000,
      );
      console.log(
        `  parts searched in ${await page.locator(".shape-view").getAttribute("data-milliseconds")} ms`,
      );
      await gallery.close();
    },
  ],
  [
    "4.7",
    "a curve is drawn with keys and pasted, and invalid text is rejected with a sentence",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape");
      const { page } = gallery;
      await page.locator(".pad").focus();
      for (const keys of [
        "Enter",
        "ArrowRight",
        "Shift+ArrowRight",
        "Enter",
        "Shift+ArrowDown",
        "Enter",
        "Shift+ArrowLeft",
        "Enter",
        "c",
      ])
        await page.keyboard.press(keys);
      await ranked(page);
      assert.match(await gallery.fragment(), /d=c/);
      await page.getByLabel("Paste points or a path").fill("hello");
      await page.getByRole("button", { name: "Use pasted shape" }).click();
      await eventually(
        async () => /pasted path: .*among hello/.test(await page.getByRole("alert").innerText()),
        "it is said what is wrong",
      );
      await page.getByLabel("Paste points or a path").fill("M0 0L100 0A50 20 0 0 1 0 0Z");
      await page.getByRole("button", { name: "Use pasted shape" }).click();
      await eventually(async () => (await page.getByRole("alert").innerText()) === "", "it is read");
      await ranked(page);
      await gallery.close();
    },
  ],
  [
    "4.8",
    "a drawing with transforms is read as it is drawn, and its curve found",
    async ({ browser }) => {
      const blank = await browser.newPage();
      const wanted = await browserBoxes(blank, DRAWING);
      await blank.close();
      const boxes = readBoxes(await kernelOf(small), DRAWING, 8);
      assert.equal(wanted.length, 8);
      assert.equal(boxes.length, 8);
      // The hundred points of an outline may be half a step from its corners.
      boxes.flat().forEach((value, k) => {
        const [x0, y0, x1, y1] = wanted[k >> 2];
        const off = Math.abs(value - wanted.flat()[k]) / Math.max(x1 - x0, y1 - y0);
        assert.ok(off < 0.02, `${boxes[k >> 2]} is not ${wanted[k >> 2]}`);
      });
      const gallery = await openGallery(browser, small, "/shape");
      const { page } = gallery;
      // An ellipse twice as long as wide, drawn as a stretched circle.
      const paste = async (text) => {
        const before = await gallery.fragment();
        await page.getByLabel("Paste points or a path").fill(text);
        await page.getByRole("button", { name: "Use pasted shape" }).click();
        await eventually(async () => (await gallery.fragment()) !== before, "it is read");
        await ranked(page);
        return page.locator(".matches .label b").allInnerTexts();
      };
      const plain = await paste('<ellipse rx="200" ry="100"/>');
      const transformed = await paste(
        '<svg><g transform="rotate(30)"><g transform="scale(2 1)"><circle r="50"/></g></g></svg>',
      );
      assert.deepEqual(transformed.slice(0, 5), plain.slice(0, 5));
      assert.notDeepEqual((await paste('<circle r="50"/>')).slice(0, 5), plain.slice(0, 5));
      await page.getByLabel("Paste points or a path").fill('<circle r="50" transform="turn(3)"/>');
      await page.getByRole("button", { name: "Use pasted shape" }).click();
      await eventually(
        async () => /transform `turn\(3\)` .* cannot be read/.test(await page.getByRole("alert").innerText()),
        "it is said what is wrong",
      );
      await gallery.close();
    },
  ],
  [
    "5.1",
    "curves of an address are compared side by side and overlaid",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/compare?c=evans:2.1.1,watt:3.1.1,evans:3.1.1");
      const { page } = gallery;
      await eventually(
        async () => (await page.locator(".pinned-tiles > li").count()) === 3,
        "three are there",
      );
      assert.ok((await page.locator(".compared-facts td.other").count()) > 3, "differences are marked");
      await page.getByRole("button", { name: "Overlay" }).click();
      assert.equal(await page.locator(".over path").count(), 3);
      const dashes = await page
        .locator(".over path")
        .evaluateAll((paths) => new Set(paths.map((path) => getComputedStyle(path).strokeDasharray)).size);
      assert.equal(dashes, 3, "each has a dash of its own");
      await eventually(async () => (await leastPlaces(page)) > 150, "curves are solved finely");
      const strayed = await page.locator(".over").evaluate((picture) => {
        const frame = picture.getBoundingClientRect();
        return [...picture.querySelectorAll(".letter")].filter((letter) => {
          const { left, right, top, bottom } = letter.getBoundingClientRect();
          return left < frame.left || right > frame.right || top < frame.top || bottom > frame.bottom;
        }).length;
      });
      assert.equal(strayed, 0, "letters stay in the frame");
      const deviation = async () => parseFloat(await page.locator(".deviation").first().innerText());
      const fitted = await deviation();
      await page.getByLabel("Alignment", { exact: true }).selectOption("none");
      assert.ok((await deviation()) >= fitted);
      assert.match(await gallery.fragment(), /view=over.*align=none/);
      await page.getByRole("button", { name: "Move A back" }).click();
      await eventually(
        async () => /c=watt:3.1.1,evans:2.1.1/.test(await gallery.fragment()),
        "the order is in the address",
      );
      await page.getByRole("button", { name: "Remove A", exact: true }).click();
      await eventually(async () => (await page.locator(".pinned-list > li").count()) === 2, "one is gone");
      await gallery.close();
    },
  ],
  [
    "7.f",
    "no view overflows a narrow screen, light or dark",
    async ({ browser }) => {
      for (const colorScheme of ["light", "dark"]) {
        for (const address of [
          "/find",
          "/find?show=table",
          "/new",
          "/new/four-bar?crank=1.2&ignored=1",
          "/shape?like=evans:2.1.1",
          "/compare?c=evans:2.1.1,watt:3.1.1&view=over",
        ]) {
          const gallery = await openGallery(browser, small, address, {
            viewport: { width: 360, height: 800 },
            colorScheme,
          });
          await gallery.page.waitForTimeout(500);
          const wide = await gallery.page.evaluate(() => document.documentElement.scrollWidth);
          assert.ok(wide <= 360, `${address}: ${wide} wide`);
          const unnamed = await gallery.page.evaluate(() =>
            [...document.querySelectorAll("main :is(button, input, select, textarea, [role=slider])")]
              .filter(
                (one) =>
                  !one.ariaLabel && !one.labels?.length && !one.innerText?.trim() && !one.textContent.trim(),
              )
              .map((one) => one.outerHTML),
          );
          assert.deepEqual(unnamed, []);
          await gallery.close();
        }
      }
    },
  ],
];

await runTests([...tests, ...ADDRESSES, ...FOUR_BARS, ...FILTERING, ...COMPARING, ...PRINTING]);
