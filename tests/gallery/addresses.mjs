// Tests what addresses say and ignore, that gestures of Find and Compare are undone, and whose pins are kept.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";

const [small] = process.argv.slice(2);

const isAt = (gallery, address) =>
  eventually(async () => (await gallery.fragment()) === address, `the address is not ${address}`);
const isIgnored = (page, words) =>
  eventually(
    async () =>
      (await page.locator(".ignored").innerText()) === (words && `Ignored in the address: ${words}`),
    `not ignored: ${words}`,
  );
const counted = (page) => page.locator(".counted b").innerText();
const lettersOf = (page) => page.locator(".comparison .named a").allTextContents();
const pinned = (page) => page.locator(".site-nav .count").innerText();
const undo = (page, keys = "Control+z") =>
  page
    .locator("h1")
    .evaluate(() => document.activeElement?.blur())
    .then(() => page.keyboard.press(keys));

export const ADDRESSES = [
  [
    "5.6",
    "a view says what it ignores of its address, until a gesture",
    async ({ browser }) => {
      const gallery = await openGallery(
        browser,
        small,
        "/evans/curve/3.1.1?p=x&circuit=9&graph=jerk&q=1&show=velocity,glow&r=1.1&at=999",
        { reducedMotion: "reduce" },
      );
      const { page } = gallery;
      const reasons = [
        "p=x (not a number)",
        "circuit=9 (of 2)",
        "graph=jerk (there is no “jerk”)",
        "q=1 (unknown)",
        "show=velocity,glow (there is no “glow”)",
        "at=999 (outside of the circuit)",
      ];
      await isIgnored(page, reasons.join("; "));
      assert.equal(await page.getByRole("status").filter({ hasText: "Ignored" }).count(), 1);
      await page.getByRole("checkbox", { name: "Velocity" }).uncheck();
      await isIgnored(page, "");
      await undo(page);
      await isIgnored(page, reasons.join("; "));
      await gallery.go("/find?mu_worst_deg=a..b&show=list&family=evans,nothing&sort=glow&class=crank-rocker");
      await isIgnored(
        page,
        "mu_worst_deg=a..b (neither a range, as 30..60, nor words); show=list (there is no “list”); " +
          "family=evans,nothing (there is no “nothing”); sort=glow (there is no “glow”)",
      );
      await gallery.go("/compare?c=evans:3.1.1&align=straight&x");
      await isIgnored(page, "align=straight (there is no “straight”); x (unknown)");
      await gallery.go("/evans/1?zoom=near&curve=9.9.9");
      await isIgnored(page, "zoom=near (not a number); curve=9.9.9 (not on this page)");
      await gallery.go("/evans?page=0");
      await isIgnored(page, "page=0 (less than 1)");
      await gallery.go("/shape?colour=red");
      await isIgnored(page, "colour=red (unknown)");
      await gallery.go("/evans/curve/3.1.1?p=2.5");
      await isIgnored(page, "");
      await gallery.close();
    },
  ],
  [
    "5.7",
    "an address that has lost escapes, or has one too many, is read as it was meant",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/evans/curve/3.1.1%3Fp=3.5%26r=1.1", {
        reducedMotion: "reduce",
      });
      const { page } = gallery;
      const value = (name) => page.getByLabel(`Value of ${name}`, { exact: true }).inputValue();
      assert.deepEqual([await value("p"), await value("r")], ["3.5", "1.1"]);
      await gallery.go("/compare?c=evans:3.1.1,evans:3.1.1?p=3.5&r=1.1&view=over");
      await eventually(async () => (await page.locator(".over path").count()) === 2, "both are overlaid");
      const links = page.locator(".comparison .named a");
      assert.equal(await links.nth(1).getAttribute("href"), "#/evans/curve/3.1.1?p=3.5&r=1.1");
      await isIgnored(page, "");
      await gallery.close();
    },
  ],
  [
    "5.8",
    "gestures of Find are undone one by one, and done again",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/find?family=evans");
      const { page } = gallery;
      await eventually(async () => /of/.test(await counted(page)), "the family is there");
      const all = await counted(page);
      const minimum = page.getByLabel("worst transmission angle, at least");
      await minimum.fill("30");
      await minimum.press("Enter");
      await isAt(gallery, "/find?family=evans&mu_worst_deg=30..");
      const left = await counted(page);
      assert.notEqual(left, all);
      // A handle that is dragged in steps, with a pause, is one gesture.
      const end = await page.getByRole("slider", { name: "worst transmission angle, maximum" }).boundingBox();
      await page.mouse.move(end.x + end.width / 2, end.y + end.height / 2);
      await page.mouse.down();
      await page.mouse.move(end.x - 20, end.y, { steps: 3 });
      await page.waitForTimeout(600);
      assert.equal(await gallery.fragment(), "/find?family=evans&mu_worst_deg=30..", "it is held");
      await page.mouse.move(end.x - 40, end.y, { steps: 3 });
      await page.mouse.up();
      await eventually(async () => /30\.\.\d/.test(await gallery.fragment()), "the gesture has ended");
      await page.locator("#find-sort").selectOption("length");
      await page.getByRole("button", { name: "Table" }).click();
      await isAt(gallery, `${(await gallery.fragment()).split("&sort")[0]}&sort=length&show=table`);
      for (const gone of [/show=table/, /sort=/, /30\.\.\d/]) {
        assert.match(await gallery.fragment(), gone);
        await undo(page);
        await eventually(async () => !gone.test(await gallery.fragment()), `${gone} is undone`);
      }
      assert.deepEqual([await counted(page), await minimum.inputValue()], [left, "30"]);
      await undo(page);
      await isAt(gallery, "/find?family=evans");
      assert.deepEqual([await counted(page), await minimum.inputValue()], [all, ""]);
      await undo(page, "Control+Shift+z");
      await isAt(gallery, "/find?family=evans&mu_worst_deg=30..");
      assert.deepEqual([await counted(page), await minimum.inputValue()], [left, "30"]);
      await gallery.close();
    },
  ],
  [
    "5.9",
    "gestures of Compare are undone, with their pins; a link of others leaves one's own pins",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/compare");
      const { page } = gallery;
      await eventually(async () => /No curves/.test(await page.locator(".lede").innerText()), "it is empty");
      await gallery.go("/compare?c=evans:2.1.1,watt:3.1.1");
      await eventually(async () => (await lettersOf(page)).length === 2, "two are compared");
      assert.equal(await pinned(page), "", "and are not pinned");
      await page.getByRole("button", { name: "Pin all" }).click();
      await eventually(async () => /2/.test(await pinned(page)), "now they are");
      await page.getByRole("button", { name: "Overlay" }).click();
      await page.getByRole("button", { name: "Unpin A", exact: true }).click();
      await isAt(gallery, "/compare?c=watt:3.1.1&view=over");
      assert.match(await pinned(page), /1/);
      await undo(page);
      await isAt(gallery, "/compare?c=evans:2.1.1,watt:3.1.1&view=over");
      assert.match(await pinned(page), /2/, "it is pinned again");
      await undo(page);
      await isAt(gallery, "/compare?c=evans:2.1.1,watt:3.1.1");
      await eventually(async () => (await page.locator(".pinned-tiles > li").count()) === 2, "side by side");
      await undo(page, "Control+Shift+z");
      await eventually(async () => (await page.locator(".over path").count()) === 2, "overlaid again");
      // The link of another.
      await gallery.go("/compare?c=evans:5.1.1,evans:6.1.1");
      await eventually(async () => /5\.1\.1/.test((await lettersOf(page))[0]), "others are compared");
      await page.getByRole("button", { name: "Remove A", exact: true }).click();
      await isAt(gallery, "/compare?c=evans:6.1.1");
      assert.match(await pinned(page), /2/, "one's own are kept");
      await page.locator(".site-nav a", { hasText: "Compare" }).click();
      await isAt(gallery, "/compare?c=evans:2.1.1,watt:3.1.1");
      await eventually(async () => /2\.1\.1/.test((await lettersOf(page))[0]), "they are compared again");
      await gallery.close();
    },
  ],
  [
    "5.10",
    "all tabs have the same pins, and a page without storage has its own",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/evans/curve/3.1.1", { reducedMotion: "reduce" });
      const { page } = gallery;
      const other = await page.context().newPage();
      await other.goto(page.url().replace("/evans/curve/3.1.1", "/compare"));
      await other.waitForSelector(".compare-view");
      await page.locator(".plate button.pin").click();
      await eventually(async () => (await lettersOf(other)).length === 1, "the other tab compares it");
      await other.getByRole("button", { name: "Unpin A", exact: true }).click();
      await eventually(
        async () => (await page.locator(".plate button.pin").innerText()) === "Pin",
        "it is unpinned",
      );
      await other.close();
      await gallery.close();
      const before = (opened) =>
        opened.addInitScript(() =>
          Object.defineProperty(window, "localStorage", {
            get() {
              throw new Error("no storage");
            },
          }),
        );
      const alone = await openGallery(browser, small, "/evans/curve/3.1.1", {
        reducedMotion: "reduce",
        before,
      });
      await alone.page.locator(".plate button.pin").click();
      assert.match(await pinned(alone.page), /1/);
      await alone.close();
    },
  ],
];
