// Tests browsing families, their contact sheets, and their pages.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import { announced, atlas, addTest, large, startAt, pointAt } from "./pages-support.mjs";
import { ODD_REASON, oddAtlas } from "./odd-atlas.mjs";

addTest(
  "1.1",
  "families are a contact sheet, drawn and loaded only when they become visible",
  startAt(atlas, "/"),
  async (g, page) => {
    const hasRead = (id) => g.requests.some((url) => url.endsWith(`/${id}/gallery.js`));
    assert.equal(await page.locator(".families > li").count(), 38);
    await page.waitForSelector(".families li:first-child .tile-picture path");
    assert.equal(
      await page.locator(".families li:first-child .tile-picture path").count(),
      10,
      "ten curves of Evans",
    );
    await eventually(
      async () => (await page.locator(".families .tile-picture > *").count()) >= 4,
      "what is seen is drawn",
    );
    assert.equal(
      await page.locator(".families li:last-child .tile-picture > *").count(),
      0,
      "what is not seen is not drawn",
    );
    assert.ok(hasRead("evans") && !hasRead("hoeken-chart"), "a script is read when its family is seen");
    await page.locator(".families li:last-child").scrollIntoViewIfNeeded();
    await eventually(
      () => page.locator(".families li:last-child .tile-picture > *").count(),
      "it is drawn when seen",
    );
    assert.ok(hasRead("hoeken-chart"));
    assert.ok(!g.requests.some((url) => url.endsWith("/kernel.js")), "nothing is computed here");
    assert.match(
      await page.locator(".families li:first-child").innerText(),
      /Evans linkage\s+Natesan 1994[\s\S]*10 curves · 1 page/,
    );
  },
);

addTest("1.2", "families can be searched by name", startAt(atlas, "/"), async (g, page) => {
  await page.getByRole("searchbox").fill("watt");
  assert.deepEqual(await page.locator(".families li:visible .name").allInnerTexts(), [
    "Watt linkage",
    "Watt six-bar linkage",
    "Watt six-bar linkage, form I",
    "Watt six-bar linkage, form I, by its ternary link",
    "Watt six-bar linkage, form II, by its ternary link",
  ]);
  assert.equal(await announced(page), "5 families");
  assert.equal(await g.fragment(), "/?q=watt");
  await page.getByRole("link", { name: "Watt six-bar linkage", exact: true }).click();
  await page.waitForSelector(".family-view");
  await page.goBack();
  await eventually(async () => (await page.locator(".families li:visible").count()) === 5, "as it was left");
  assert.equal(await page.getByRole("searchbox").inputValue(), "watt");
});

addTest(
  "1.3",
  "a family's contact sheet shows every page with few elements",
  startAt(large, "/hrones-nelson"),
  async (g, page) => {
    await page.waitForSelector(".window svg path");
    assert.equal(await page.locator(".window svg").first().locator("path").count(), 10);
    assert.equal(await page.locator(".window > li").first().getAttribute("aria-setsize"), "780");
    for (const part of [0.2, 0.5, 1]) {
      await page.evaluate((to) => window.scrollTo(0, to * document.documentElement.scrollHeight), part);
      const inSight = () =>
        page.evaluate(() => {
          const tiles = [...document.querySelectorAll(".window > li")].filter((tile) => {
            const { top, bottom } = tile.getBoundingClientRect();
            return bottom > 0 && top < innerHeight;
          });
          return tiles.length >= 8 && tiles.every((tile) => tile.querySelector("svg path"));
        });
      await eventually(inSight, "the tiles in sight are there, and drawn");
      assert.ok((await page.locator(".window > li").count()) < 100, "few tiles are there");
    }
    assert.equal(await page.locator('.window a[href="#/hrones-nelson/780"]').count(), 1);
    assert.match(await page.locator(".head").innerText(), /7,800 curves · 780 pages · 156 linkages/);
    assert.equal(await page.locator('a[href="#/find?family=hrones-nelson"]').count(), 1);
  },
);

addTest(
  "1.4",
  "7,800 curves in a contact sheet, by keys too",
  startAt(large, "/hrones-nelson?show=curves"),
  async (g, page) => {
    await page.waitForSelector(".window svg path");
    await page.locator(".window a").first().focus();
    const current = () => page.evaluate(() => document.activeElement.getAttribute("href"));
    await page.keyboard.press("ArrowRight");
    assert.equal(await current(), "#/hrones-nelson/curve/1.2.1");
    await page.keyboard.press("End");
    assert.match(await current(), /\.50\.1$/);
    await page.keyboard.press("Home");
    assert.equal(await current(), "#/hrones-nelson/curve/1.1.1");
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("PageDown");
    assert.ok(
      await page.evaluate(() => {
        const { top, bottom } = document.activeElement.getBoundingClientRect();
        return top >= 0 && bottom <= innerHeight;
      }),
      "the focus is in sight",
    );
  },
);

addTest(
  "1.9",
  "next, previous, first, last and any page can be opened",
  startAt(large, "/hrones-nelson/99"),
  async (g, page) => {
    const isOn = (number) =>
      eventually(
        async () =>
          (await g.fragment()) === `/hrones-nelson/${number}` &&
          (await page.title()).includes(`page ${number} of 780`) &&
          (await page.locator(".page-sheet img").getAttribute("src")).includes(
            `-${String(number).padStart(3, "0")}.svg`,
          ),
        `page ${number}`,
      );
    await page.getByRole("link", { name: "Next page" }).click();
    await isOn(100);
    await page.getByRole("link", { name: "Previous page" }).click();
    await isOn(99);
    await page.locator(".viewport").focus();
    for (const [key, number] of [
      ["n", 100],
      ["PageDown", 101],
      ["p", 100],
      ["PageUp", 99],
      ["End", 780],
      ["Home", 1],
    ]) {
      await page.keyboard.press(key);
      await isOn(number);
    }
    assert.equal(
      await page.getByRole("link", { name: "Previous page" }).getAttribute("href"),
      null,
      "nothing before the first",
    );
    await page.getByRole("spinbutton", { name: "Page" }).fill("640");
    await page.keyboard.press("Enter");
    await isOn(640);
    await page.getByRole("spinbutton", { name: "Page" }).fill("781");
    await page.keyboard.press("Enter");
    assert.equal(await page.getByRole("spinbutton", { name: "Page" }).getAttribute("aria-invalid"), "true");
    assert.match(await announced(page), /page 640 of 780/);
  },
);

addTest("1.10", "a view keeps its scroll position", startAt(large, "/hrones-nelson"), async (g, page) => {
  await page.evaluate(() => window.scrollTo(0, 9000));
  const isBelowTop = () =>
    [...document.querySelectorAll(".window a")].some((a) => a.getBoundingClientRect().top > 0);
  await page.waitForFunction(isBelowTop);
  const followed = await page.evaluate(() => {
    const link = [...document.querySelectorAll(".window a")].find((a) => a.getBoundingClientRect().top > 0);
    link.focus({ preventScroll: true });
    link.click();
    return link.getAttribute("href");
  });
  await page.waitForSelector(".page-sheet img");
  assert.equal(await page.evaluate(() => window.scrollY), 0);
  await page.goBack();
  await page.waitForSelector(".window svg path");
  await eventually(() => page.evaluate(() => Math.abs(window.scrollY - 9000) < 2), "back where it was");
  const tile = () => page.evaluate(() => document.activeElement.closest(".window a")?.getAttribute("href"));
  await eventually(async () => (await tile()) === followed, "the focus too");
  await g.go("/hrones-nelson/400");
  await page.getByRole("link", { name: "All pages" }).click();
  await eventually(
    () => page.evaluate(() => document.activeElement.getAttribute("href") === "#/hrones-nelson/400"),
    "its tile has the focus",
  );
});

addTest("1.11", "an unknown address is reported", startAt(atlas, "/nowhere/at/all"), async (g, page) => {
  assert.match(await page.locator("main").innerText(), /no page at this address/);
  await g.go("/evans/7");
  assert.match(await page.getByRole("alert").innerText(), /^Evans linkage has only 1 page\. /);
  const family = page.locator("main a", { hasText: "Evans linkage" });
  assert.equal(await family.getAttribute("href"), "#/evans", "there is a way on");
  await page.getByRole("link", { name: "All families" }).click();
  await page.waitForSelector(".families");
});

addTest(
  "1.12",
  "charts, families without pictures, PNG pages and linkages that cannot be assembled are shown",
  null,
  async ({ browser }) => {
    const odd = oddAtlas(atlas);
    try {
      const g = await openGallery(browser, odd.folder, "/evans-chart/1");
      const { page } = g;
      await page.waitForSelector(".page-sheet img");
      assert.match(await page.locator(".page-panel").innerText(), /A chart\s+Computed from 35 curves/);
      await page.locator(".page-panel a").click();
      await page.waitForSelector(".window svg path");
      assert.equal(await page.locator(".window > li").first().getAttribute("aria-setsize"), "35");
      await g.go("/watt/1");
      assert.match(await page.locator(".page-sheet img").getAttribute("src"), /watt-001\.png$/);
      await g.go("/evans/1");
      assert.equal(
        await page.locator(".page-sheet .drawn path").count(),
        9,
        "nine of ten are drawn from the data",
      );
      assert.ok((await page.locator(".page-panel").innerText()).includes(ODD_REASON), "the reason is said");
      assert.ok(await pointAt(page, "evans", "4.1.1"), "its curves can be pointed at");
      await g.go("/evans");
      assert.match(
        await page.locator("details.not-assembled summary").innerText(),
        /1 linkage could not be assembled/,
      );
      await page.locator("details.not-assembled summary").click();
      assert.ok((await page.locator("details.not-assembled").innerText()).includes(ODD_REASON));
      await g.close();
    } finally {
      odd.remove();
    }
  },
);

addTest(
  "1.13",
  "every family opens with its pages and curves, and all curves are solved",
  startAt(atlas, "/"),
  async (g, page) => {
    const families = await page.evaluate(
      () => JSON.parse(document.getElementById("atlas").textContent).families,
    );
    for (const { id, pages, curves } of families) {
      await g.go(`/${id}?show=curves`);
      assert.equal(
        await page.locator(".window > li").first().getAttribute("aria-setsize"),
        String(curves),
        id,
      );
      for (let number = 1; number <= pages; number += 1) {
        await g.go(`/${id}/${number}`);
        await page.waitForSelector(".page-sheet .picture");
        for (const link of await page.locator(".overlay a").all()) {
          await link.focus();
          // The first curve is read when the kernel is loaded.
          await page.waitForSelector(".reading:not([hidden])", { timeout: 5000 });
          const read = await page.locator(".reading").innerText();
          assert.match(
            read,
            /input\s+−?[\d.]+(°|\s)[\s\S]*speed\s+([\d.]+( × 10\S+)?|unbounded) per (rad|unit)/,
            `${await link.getAttribute("href")}: ${read}`,
          );
        }
      }
    }
  },
);

addTest(
  "1.14",
  "a family with the name of a view can be browsed, and the view still opens",
  null,
  async ({ browser }) => {
    const odd = oddAtlas(atlas);
    try {
      const g = await openGallery(browser, odd.folder, "/");
      const { page } = g;
      const heading = () => page.locator("h1").innerText();
      await page.locator('.families a[href="#/find"]').click();
      await page.waitForSelector(".family-view");
      await page.getByRole("link", { name: "Curves", exact: true }).click();
      await page.waitForSelector('.family-view [aria-current="true"]:text("Curves")');
      await page.getByRole("link", { name: "Pages", exact: true }).click();
      await page.waitForSelector('.family-view [aria-current="true"]:text("Pages")');
      await g.go("/find/1");
      await page.waitForSelector(".page-view");
      assert.match(await heading(), /Roberts/);
      await g.go("/find/curve/1.1.1");
      await page.waitForSelector(".plate");
      await page.locator(".site-nav").getByRole("link", { name: "Find", exact: true }).click();
      await page.waitForSelector(".find-view");
      await page.waitForTimeout(400);
      await page.reload();
      await page.waitForSelector(".find-view");
      await g.close();
    } finally {
      odd.remove();
    }
  },
);

addTest(
  "1.14b",
  "a press on a picture that is replaced before its release is a click",
  startAt(atlas, "/"),
  async (g, page) => {
    const link = page.locator('.families a[href="#/evans"]');
    await link.locator("svg").waitFor();
    const { x, y } = await link.boundingBox();
    await page.mouse.move(x + 40, y + 40);
    await page.mouse.down();
    await link.locator("svg").evaluate((picture) => picture.replaceWith(picture.cloneNode(true)));
    await page.mouse.up();
    await page.waitForSelector(".family-view");
  },
);

addTest("1.14c", "no tile moves when the families are loaded", startAt(atlas, "/"), async (g, page) => {
  const tiles = page.locator(".families > li");
  for (const tile of await tiles.all()) {
    await tile.scrollIntoViewIfNeeded();
    await tile.locator(".tile-picture > *").first().waitFor();
  }
  const shifts = await page.evaluate(
    () =>
      new Promise((done) => {
        new PerformanceObserver((list) => done(list.getEntries().map(({ value }) => value))).observe({
          type: "layout-shift",
          buffered: true,
        });
        setTimeout(() => done([]), 300);
      }),
  );
  assert.deepEqual(shifts, []);
});
