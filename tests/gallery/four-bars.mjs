// Tests the search for four-bars in By shape.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";

const [small] = process.argv.slice(2);

/** Waits until the search for four-bars is at its end. */
export const searchedToEnd = (page) =>
  eventually(
    async () => {
      const status = await page.locator(".four-bar-section .counted").innerText();
      return /among|No four-bar/.test(status) && !status.includes("goes on");
    },
    "the search for four-bars ends",
    60000,
  );

/** Counts the turns of the page that are longer than a frame, and records the longest, from now on. */
const watchTurns = (page) =>
  page.evaluate(() => {
    const channel = new MessageChannel();
    let last = performance.now();
    window.turns = { longest: 0, count: 0 };
    channel.port1.onmessage = () => {
      const now = performance.now();
      window.turns.longest = Math.max(window.turns.longest, now - last);
      window.turns.count += 1;
      last = now;
      setTimeout(() => channel.port2.postMessage(null));
    };
    channel.port2.postMessage(null);
  });

export const FOUR_BARS = [
  [
    "4.13",
    "four-bars are found for a curve of the atlas, with their cognates and manifests",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape?like=evans:2.1.1");
      const { page } = gallery;
      await watchTurns(page);
      const first = page.locator(".four-bars > li").first();
      await eventually(() => first.isVisible(), "there are answers soon", 20000);
      await searchedToEnd(page);
      const { longest, count } = await page.evaluate(() => window.turns);
      console.log(`  ${count} turns while it was searched, the longest ${Math.round(longest)} ms`);
      // Evans' linkage is a four-bar: its curve is met.
      assert.match(await first.locator(".deviation").innerText(), /^\d[\d.e-]* S, (exact|close)/);
      assert.match(await first.locator("dl").innerText(), /Worst transmission angle/);
      assert.equal(await first.locator("dt", { hasText: "Cognate" }).count(), 2);
      assert.equal(await first.locator("path.curve").count(), 1);
      assert.match(await page.locator(".four-bar-section .counted").innerText(), /among 100,000 four-bars/);
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name: "Save manifest of all" }).click(),
      ]);
      assert.equal(download.suggestedFilename(), "found.toml");
      await gallery.close();
    },
  ],
  [
    "4.14",
    "conditions on four-bars are in the address, and an open stroke is a part of their curves",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape");
      const { page } = gallery;
      await page.getByLabel("Paste points or a path").fill("M0 0C0 40 30 60 60 60S110 40 120 10");
      await page.getByRole("button", { name: "Use pasted shape" }).click();
      await searchedToEnd(page);
      const classes = () => page.locator(".four-bars dd").allInnerTexts();
      assert.ok((await classes()).length > 0);
      await page.getByLabel("The crank turns fully").uncheck();
      await page.getByLabel("Links").selectOption("5");
      await eventually(async () => /input=any&max-link=5/.test(await gallery.fragment()), "in the address");
      await searchedToEnd(page);
      const lengths = page.locator(".four-bars dd", { hasText: / = [\d.]+ S$/ });
      for (const text of await lengths.allInnerTexts())
        assert.ok(Number(text.match(/ = ([\d.]+) S$/)[1]) <= 5.005, text);
      await page.reload();
      await searchedToEnd(page);
      assert.equal(await page.getByLabel("The crank turns fully").isChecked(), false);
      // The same path and conditions have the same answer.
      assert.ok((await page.locator(".four-bars > li").count()) > 0);
      await gallery.close();
    },
  ],
  [
    "4.15",
    "without its shape the view has no answers, and undoing brings both back",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape?like=evans:2.1.1");
      const { page } = gallery;
      const answers = () => page.locator(".four-bars > li, .matches > li").count();
      const isCleared = async () => (await answers()) === 0 && (await gallery.fragment()).endsWith("/shape");
      await searchedToEnd(page);
      await page.getByRole("button", { name: "Clear" }).click();
      await eventually(isCleared, "Clear leaves no answers");
      assert.ok(await page.locator(".four-bar-section").isHidden());
      await page.keyboard.press("Control+z");
      await eventually(async () => (await gallery.fragment()).includes("like=evans:2.1.1"), "it is undone");
      // A search that is running is stopped.
      await eventually(async () => (await answers()) > 0, "there are answers again", 20000);
      await page.locator(".pad").press("Escape");
      await eventually(isCleared, "Escape leaves no answers");
      await page.waitForTimeout(1000);
      assert.ok(await isCleared(), "no answers come later");
      await gallery.close();
    },
  ],
];
