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
      assert.match(await first.locator(".deviation").innerText(), /^(exact|close) \d[\d.e-]* S/);
      assert.match(await first.locator("dl").innerText(), /Worst transmission angle/);
      assert.equal(await first.locator("dt", { hasText: "Cognate" }).count(), 2);
      assert.equal(await first.locator("path.curve").count(), 1);
      assert.match(await page.locator(".four-bar-section .counted").innerText(), /among 100,000 four-bars/);
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name: "Save manifest of all" }).click(),
      ]);
      assert.equal(download.suggestedFilename(), "found.toml");
      // Its plate has the same linkage, on the same circuit.
      const worst = await first.locator('dt:text-is("Worst transmission angle") + dd').innerText();
      await first.getByRole("link", { name: "Open on a plate" }).click();
      const range = page.getByText(/^least [\d.]+°, greatest/);
      const [least, greatest] = (await range.innerText()).match(/[\d.]+(?=°)/g).map(Number);
      assert.ok(
        Math.abs(Math.min(least, 180 - greatest) - parseFloat(worst)) < 0.11,
        `${least} ${greatest} ${worst}`,
      );
      assert.match(await gallery.fragment(), /^#?\/new\/four-bar\?/);
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
      await page.getByLabel("Longest link").selectOption("5");
      await page.getByLabel("Least transmission angle").selectOption("20");
      await page.getByLabel("Pivots in a box").check();
      const corners = page.getByLabel("Corners of the box");
      await corners.fill("-150 -150 250 200");
      await corners.press("Enter");
      await eventually(
        async () => /input=any&max-link=5&mu=20&pivots=-150,-150,250,200$/.test(await gallery.fragment()),
        "in the address",
      );
      assert.equal(await page.locator(".pivot-box rect").count(), 1);
      await searchedToEnd(page);
      const lengths = page.locator(".four-bars dd", { hasText: / = [\d.]+ S$/ });
      for (const text of await lengths.allInnerTexts())
        assert.ok(Number(text.match(/ = ([\d.]+) S$/)[1]) <= 5.005, text);
      const facts = (term) => page.locator(`.four-bars dt:text-is("${term}") + dd`).allInnerTexts();
      const angles = await facts("Worst transmission angle");
      assert.ok(angles.length > 0 && angles.every((text) => parseFloat(text) >= 19.9), angles.join());
      for (const text of await facts("Crank pivot, rocker pivot"))
        text
          .replaceAll("−", "-")
          .match(/-?[\d.]+/g)
          .forEach((value, k) => {
            assert.ok(Number(value) > -151 && Number(value) < (k % 2 ? 201 : 251), text);
          });
      await page.reload();
      await searchedToEnd(page);
      assert.equal(await page.getByLabel("The crank turns fully").isChecked(), false);
      // The same path and conditions have the same answer.
      assert.ok((await page.locator(".four-bars > li").count()) > 0);
      await gallery.close();
    },
  ],
  [
    "4.18",
    "the dots of the target are moved, chosen and removed by keys, each step a gesture",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape");
      const { page } = gallery;
      await page.getByLabel("Paste points or a path").fill("0,0\n40,60\n100,50\n120,0\n60,-30");
      await page.getByRole("button", { name: "Use pasted shape" }).click();
      const dots = page.locator(".dots circle");
      await eventually(async () => (await dots.count()) === 5, "there are dots");
      const drawn = await gallery.fragment();
      await page.locator(".pad").focus();
      await page.keyboard.press("Tab");
      const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label"));
      assert.equal(await focused(), "Dot 1 of 5");
      await page.keyboard.press("PageDown");
      assert.equal(await focused(), "Dot 2 of 5");
      const placeOf = async () => Number(await dots.nth(1).getAttribute("cx"));
      const before = await placeOf();
      await page.keyboard.down("Shift");
      await page.keyboard.down("ArrowRight");
      assert.ok(Math.abs((await placeOf()) - before - 20) < 1e-6, "by ten steps");
      await page.keyboard.up("ArrowRight");
      await page.keyboard.up("Shift");
      await eventually(async () => (await gallery.fragment()) !== drawn, "in the address");
      assert.equal(await focused(), "Dot 2 of 5");
      const bent = await gallery.fragment();
      await page.keyboard.press("Delete");
      await eventually(async () => (await dots.count()) === 4, "it is removed");
      assert.equal(await focused(), "Dot 2 of 4");
      await page.keyboard.press("Control+z");
      await eventually(
        async () => (await gallery.fragment()) === bent && (await dots.count()) === 5,
        "undone",
      );
      await page.keyboard.press("?");
      assert.match(await page.getByRole("dialog", { name: "Keys" }).innerText(), /On a dot of the pad/);
      await gallery.close();
    },
  ],
  [
    "4.16",
    "four-bars are on the target while it is drawn and dragged, and every word of quality is one of find",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape");
      const { page } = gallery;
      const { x, y, width, height } = await page.locator(".pad").boundingBox();
      const at = (t) => [
        x + width * (0.5 + 0.3 * Math.cos(t)),
        y + height * (0.5 + 0.2 * Math.sin(t) + 0.05 * Math.sin(2 * t)),
      ];
      await page.mouse.move(...at(0));
      await page.mouse.down();
      for (let k = 1; k < 40; k += 1) {
        await page.mouse.move(...at(k / 9));
        await page.waitForTimeout(30);
      }
      const shown = page.locator(".pad .four-bar");
      await eventually(async () => (await shown.count()) > 0, "four-bars come before the stroke ends", 10000);
      assert.equal((await gallery.fragment()).includes("d="), false);
      for (let k = 40; k < 56; k += 1) await page.mouse.move(...at(k / 9));
      await page.mouse.up();
      await searchedToEnd(page);
      assert.equal(await shown.count(), 3);
      assert.match(await gallery.fragment(), /d=c.*at=/);
      const before = await gallery.fragment();
      const deviation = () => page.locator(".live").innerText();
      assert.match(await deviation(), /^The nearest four-bar is (exact|close|fair): E = [\d.e-]+ S/);
      // Dragging a dot: the four-bars follow, and the address changes once.
      const dot = await page.locator(".dots circle").nth(3).boundingBox();
      await page.mouse.move(dot.x + dot.width / 2, dot.y + dot.height / 2);
      await page.mouse.down();
      await page.mouse.move(dot.x + 20, dot.y + 30, { steps: 8 });
      const changed = await deviation();
      await eventually(async () => (await deviation()) !== changed, "they follow the path", 10000);
      assert.equal(await gallery.fragment(), before);
      await page.mouse.up();
      await eventually(async () => (await gallery.fragment()) !== before, "the new path is in the address");
      await searchedToEnd(page);
      const words = await page.locator(".quality").allInnerTexts();
      assert.ok(
        words.length > 5 && words.every((word) => /^(exact|close|fair|poor)$/.test(word)),
        words.join(),
      );
      await page.keyboard.press("Control+z");
      await eventually(async () => (await gallery.fragment()) === before, "it is undone");
      await gallery.close();
    },
  ],
  [
    "4.17",
    "a file is dropped or chosen, and what hinders four-bars is said",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/shape");
      const { page } = gallery;
      const zigzag = "0,0\n1,3\n2,0\n3,3\n4,0\n5,3\n6,0\n7,3\n8,0";
      const drop = await page.evaluateHandle((text) => {
        const data = new DataTransfer();
        data.items.add(new File([text], "zigzag.csv"));
        return data;
      }, zigzag);
      await page.dispatchEvent(".shape-split", "drop", { dataTransfer: drop });
      await eventually(async () => /at=0,0,8/.test(await gallery.fragment()), "its place is in the address");
      assert.match(await page.locator(".shape-view .field").innerText(), /zigzag.csv: x is column 1/);
      await searchedToEnd(page);
      assert.match(await page.locator(".reasons").innerText(), /7 corners of up to 1\d\d°.*meets it 8 times/);
      assert.match(
        await page.locator(".four-bar-section .counted").innerText(),
        /all of them poor|No four-bar/,
      );
      const dxf =
        "0\nSECTION\n2\nENTITIES\n0\nELLIPSE\n8\n0\n10\n5\n20\n5\n11\n4\n21\n0\n40\n0.5\n41\n0\n42\n6.283185307179586\n0\nENDSEC\n0\nEOF\n";
      const [name, mimeType] = ["ellipse.dxf", "image/vnd.dxf"];
      await page.getByLabel("Choose a file").setInputFiles({ name, mimeType, buffer: Buffer.from(dxf) });
      await eventually(async () => /d=c.*at=1,3,8/.test(await gallery.fragment()), "the ellipse is closed");
      await searchedToEnd(page);
      assert.equal(await page.locator(".reasons").innerText(), "");
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
