// Tests that axe-core finds nothing in any view, wide and narrow, light and dark: names, heading order, contrast, target sizes.
//
//   PLAYWRIGHT_CORE=… CHROMIUM=… AXE_CORE=axe.min.js node tests/gallery/axe.mjs ATLAS
//
// ATLAS is the folder of the atlas of atlas.toml.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

import { eventually, openGallery, runTests } from "./browser.mjs";

const [atlas] = process.argv.slice(2);
const axe = process.env.AXE_CORE && readFileSync(process.env.AXE_CORE, "utf8");

/** The views, with a selector of what is there when they are complete. */
const VIEWS = [
  ["/", ".families .thumbnail"],
  ["/evans", ".window .thumbnail"],
  ["/evans?show=curves", ".window .thumbnail"],
  ["/evans/1?curve=3.1.1", ".page-panel .button"],
  ["/evans/curve/3.1.1", ".tracer"],
  ["/find", ".results .thumbnail"],
  ["/find?show=table&sort=-length", ".results-table td"],
  ["/shape?like=evans:3.1.1", ".matches > li"],
  ["/compare?c=evans:3.1.1,watt:3.1.1", ".pinned-tiles .thumbnail"],
  ["/compare?c=evans:3.1.1,watt:3.1.1&view=over", ".over"],
  ["/nowhere", ".error"],
];

/** What axe-core finds on a page: the rule and the elements of each finding. */
async function findings(page) {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { axe } = window;
    const tags = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];
    const found = await axe.run(document, { runOnly: tags, rules: { "target-size": { enabled: true } } });
    if (!found.passes.some(({ id }) => id === "target-size")) return ["target sizes are not tested"];
    return found.violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`);
  });
}

const tests = [
  [1440, 900],
  [390, 844],
].flatMap(([width, height], k) =>
  ["light", "dark"].map((colorScheme) => [
    `8.${k + 1}`,
    `axe-core finds nothing at ${width} × ${height}, ${colorScheme}`,
    async ({ browser }) => {
      const options = { viewport: { width, height }, colorScheme, reducedMotion: "reduce" };
      const gallery = await openGallery(browser, atlas, "/", options);
      const { page } = gallery;
      for (const [fragment, ready] of VIEWS) {
        await gallery.go(fragment);
        await page.locator(ready).first().waitFor({ state: "attached" });
        await eventually(
          async () => (await page.locator("main [aria-busy=true]").count()) === 0,
          "it is idle",
          30000,
        );
        assert.deepEqual(await findings(page), [], fragment);
      }
      await gallery.go("/find");
      await page.locator("details").evaluateAll((all) => all.forEach((details) => (details.open = true)));
      assert.deepEqual(await findings(page), [], "all filters");
      await page.locator("main").focus();
      await page.keyboard.press("?");
      assert.deepEqual(await findings(page), [], "the dialog of keys");
      await gallery.close();
    },
  ]),
);

if (axe) await runTests(tests);
else console.log("skipped: AXE_CORE names no axe.min.js");
