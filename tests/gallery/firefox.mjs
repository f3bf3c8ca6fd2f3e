// Tests the gallery in Firefox, from disk: FIREFOX=/usr/bin/firefox node tests/gallery/firefox.mjs ATLAS
// HRONES-NELSON
//
// Opens and uses every view, and checks that the browser's console stays empty. The details are tested in
// pages.mjs, plate.mjs, search.mjs and export-menu.mjs; here it is what browser engines differ in: events,
// sizes, the policy, downloads.

import assert from "node:assert/strict";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { firefoxPath, startFirefox } from "./marionette.mjs";

const [atlas, large] = process.argv
  .slice(2)
  .map((folder) => pathToFileURL(join(resolve(folder), "index.html")).href);

/** Opens an address of an atlas, from an empty page, and waits for its view. */
async function at(firefox, home, fragment) {
  await firefox.open("about:blank");
  await firefox.open(`${home}#${fragment}`);
  const isOpen = () => document.querySelector("main > *") && !document.querySelector("main[aria-busy]");
  await firefox.eventually(isOpen, `${fragment} does not open`);
}

/** The box of an element in the window. */
const boxOf = (firefox, selector) =>
  firefox.evaluate((wanted) => {
    const { left, top, width, height } = document.querySelector(wanted).getBoundingClientRect();
    return { left, top, width, height };
  }, selector);

const countOf = (selector) => document.querySelectorAll(selector).length;
const hash = () => window.location.hash;

const TESTS = [
  [
    "families and their pages are drawn, thousands of them when they are scrolled to",
    async (firefox) => {
      await at(firefox, atlas, "/");
      await firefox.eventually(countOf, "no family is drawn", ".families .tile-picture path");
      await at(firefox, large, "/hrones-nelson");
      await firefox.eventually(countOf, "no page is drawn", ".window svg path");
      await firefox.evaluate(() => window.scrollTo(0, document.documentElement.scrollHeight));
      await firefox.eventually(
        () => document.querySelector('.window a[href="#/hrones-nelson/780"] svg path'),
        "the last page is not drawn",
      );
    },
  ],
  [
    "the wheel zooms a page, and the curve under the pointer is highlighted without moving the page",
    async (firefox) => {
      await at(firefox, large, "/hrones-nelson/100");
      await firefox.eventually(() => document.querySelector(".page-sheet img")?.complete, "no picture");
      const before = await boxOf(firefox, ".viewport");
      const spot = await boxOf(firefox, '.overlay a[href$="/43.49.1"] .link-area');
      const x = spot.left + spot.width / 2;
      const down = Array.from({ length: Math.floor(spot.height / 2) }, (_, k) => [x, spot.top + 2 * k]);
      for (const place of down) {
        await firefox.mouse([place]);
        if (await firefox.evaluate(countOf, ".viewport.dimmed")) break;
      }
      // The kernel is loaded when a curve is first read.
      const isRead = () => /input\s+\d/.test(document.querySelector(".reading").innerText);
      await firefox.eventually(isRead, "the curve is not read");
      // The text next to it may need a scroll bar: the sheet must not move under the pointer.
      assert.equal((await boxOf(firefox, ".viewport")).width, before.width);
      await firefox.wheel([x, spot.top], -300);
      await firefox.eventually(() => window.location.hash.includes("zoom=1."), "the wheel does nothing");
    },
  ],
  [
    "every curve of a page has a target, also one that is a straight line",
    async (firefox) => {
      await at(firefox, atlas, "/scotch-yoke/1");
      await firefox.eventually(countOf, "no curves", ".overlay .link-area");
      const boxes = await firefox.evaluate(() =>
        [...document.querySelectorAll(".overlay .link-area")].map(
          (spot) => spot.getBoundingClientRect().width,
        ),
      );
      assert.ok(boxes.length > 0 && boxes.every((width) => width > 0), boxes.join(", "));
    },
  ],
  [
    "the plate moves by itself, by the slider and by dragging, and is recomputed by a parameter",
    async (firefox) => {
      await at(firefox, atlas, "/evans/curve/1.1.1");
      const input = () => document.querySelector(".input-now").value;
      const first = await firefox.evaluate(input);
      await firefox.eventually(
        (was) => document.querySelector(".input-now").value !== was,
        "it does not move",
        first,
      );
      await firefox.evaluate(() => {
        [...document.querySelectorAll("button")].find((button) => button.textContent === "Pause").click();
        document.querySelector('input[aria-label="Position on the circuit"]').focus();
      });
      // Home, and the arrow to the right.
      await firefox.keys("\uE011\uE014");
      await firefox.eventually(() => document.querySelector(".input-now").value === "1.0°", "no step");
      const crank = await boxOf(firefox, '.grip[data-joint="2"]:not(.crank-grip)');
      const pin = [crank.left + crank.width / 2, crank.top + crank.height / 2];
      await firefox.mouse([pin, [pin[0], pin[1] - 8], [pin[0] - 8, pin[1] - 25]], true);
      assert.notEqual(await firefox.evaluate(input), "1.0°", "the crank does not follow");
      const path = await firefox.evaluate(() => document.querySelector(".dashes").getAttribute("d"));
      await firefox.evaluate(() => {
        const field = document.querySelector('input[aria-label="Value of p"]');
        field.focus();
        field.select();
      });
      await firefox.keys("2.5\uE007");
      await firefox.eventually(
        () => /[?]p=2[.]5(&|$)/.test(window.location.hash),
        "the parameter is not applied",
      );
      assert.notEqual(
        await firefox.evaluate(() => document.querySelector(".dashes").getAttribute("d")),
        path,
      );
    },
  ],
  [
    "curves are found by a measure and by a drawn shape",
    async (firefox) => {
      await at(firefox, large, "/find?mu_worst_deg=30..");
      await firefox.eventually(
        () => /^[\d,]+ of 7,800 curves/m.test(document.querySelector("main").innerText),
        "nothing is counted",
      );
      await firefox.eventually(countOf, "no result is drawn", ".results > li :is(svg, canvas)");
      await at(firefox, large, "/shape");
      await firefox.eventually(countOf, "no pad", "svg.pad");
      const { left, top, width, height } = await boxOf(firefox, "svg.pad");
      const stroke = Array.from({ length: 50 }, (_, k) => {
        const angle = (2 * Math.PI * k) / 50;
        return [left + width * (0.5 + 0.3 * Math.cos(angle)), top + height * (0.5 + 0.2 * Math.sin(angle))];
      });
      await firefox.mouse(stroke, true);
      await firefox.eventually(countOf, "nothing is like it", ".matches:not([aria-busy]) > li svg");
      assert.match(await firefox.evaluate(hash), /^#\/shape\?d=c/);
    },
  ],
  [
    "curves are compared, and exports are saved",
    async (firefox) => {
      await at(firefox, atlas, "/compare?c=evans:1.1.1,watt:3.1.1");
      await firefox.eventually(countOf, "no curves side by side", "main svg path");
      await at(firefox, atlas, "/hoeken/curve/1.1.1");
      await firefox.eventually(countOf, "no menu", ".export-button");
      await firefox.evaluate(() => {
        document.querySelector(".export-button").click();
        for (const name of [/^SVG *static/, /^PNG/])
          [...document.querySelectorAll(".export-menu button")]
            .find((entry) => name.test(entry.textContent))
            .click();
      });
      const isSaved = () =>
        readdirSync(firefox.saved).filter((name) => /^hoeken-1-1-1\.(svg|png)$/.test(name)).length === 2 &&
        /<\/svg>\s*$/.test(readFileSync(join(firefox.saved, "hoeken-1-1-1.svg"), "utf8"));
      for (let k = 0; k < 200 && !isSaved(); k += 1) await firefox.evaluate(settling);
      assert.ok(isSaved(), readdirSync(firefox.saved).join(", "));
    },
  ],
  [
    "the file of a plate opens from an empty folder",
    async (firefox) => {
      await at(firefox, atlas, "/hoeken/curve/1.1.1");
      await firefox.evaluate(() => {
        const entries = [...document.querySelectorAll(".export-menu button")];
        entries.find(({ textContent }) => textContent.startsWith("HTML")).click();
      });
      const file = join(firefox.saved, "hoeken-1-1-1.html");
      const isSaved = () => existsSync(file) && readFileSync(file, "utf8").endsWith("</html>\n");
      for (let k = 0; k < 200 && !isSaved(); k += 1) await firefox.evaluate(settling);
      const alone = join(firefox.saved, "alone");
      mkdirSync(alone);
      copyFileSync(file, join(alone, "plate.html"));
      await at(firefox, pathToFileURL(join(alone, "plate.html")).href, "");
      await firefox.eventually(
        countOf,
        "the linkage is not drawn",
        ".stage svg .curve-lines, .stage svg path",
      );
      assert.equal(await firefox.evaluate(hash), "#/hoeken/curve/1.1.1");
      await firefox.evaluate(() => {
        const slider = document.querySelector(".parameter input[type=range]");
        slider.value = String(1.1 * Number(slider.value));
        slider.dispatchEvent(new Event("input"));
        slider.dispatchEvent(new Event("change"));
      });
      await firefox.eventually(() => window.location.hash.includes("?"), "the slider changes nothing");
    },
  ],
];

/** A promise of the next frames of the page. */
const settling = () =>
  new Promise((done) => {
    setTimeout(done, 50);
  });

async function tried(firefox) {
  await firefox.resize(1400, 1000);
  for (const [sentence, test] of TESTS) {
    try {
      await test(firefox);
      console.log(`ok ${sentence}`);
    } catch (error) {
      process.exitCode = 1;
      console.log(`FAILED ${sentence}\n  ${error.stack ?? error}`);
    }
  }
  const complaints = [atlas, large].map((home) => new URL(".", home).href);
  for (const home of complaints)
    assert.deepEqual(await firefox.complaints(home), [], "the page is not quiet");
  console.log("ok the browser's console is empty");
}

const program = firefoxPath();
if (program) {
  const firefox = await startFirefox(program);
  try {
    await tried(firefox);
  } finally {
    await firefox.close();
  }
} else console.log("skipped: FIREFOX names no browser");
