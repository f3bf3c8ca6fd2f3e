// Tests Compare with curves of the atlas, and with curves whose parameters were changed on a plate.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";

const [small] = process.argv.slice(2);

/** The boxes, in pixels within their frames, of the curves that are shown side by side. */
const boxesSideBySide = (page) =>
  page.locator(".pinned-tiles .tile-picture").evaluateAll((frames) =>
    frames.map((frame) => {
      const around = frame.getBoundingClientRect();
      const { left, top, width, height } = frame.querySelector("path").getBoundingClientRect();
      return [left - around.left, top - around.top, width, height];
    }),
  );

export const COMPARING = [
  [
    "5.3",
    "side by side, curves have one scale, are aligned, and are as fine as overlaid",
    async ({ browser }) => {
      // The second linkage is the larger one.
      const gallery = await openGallery(browser, small, "/compare?c=evans:1.1.1,evans:9.1.1&align=none");
      const { page } = gallery;
      // Solved curves have three decimals of a pixel, those from the data one.
      const fine = () =>
        page
          .locator(".pinned-tiles path")
          .evaluateAll((paths) => paths.map((path) => /\.\d{3}L/.test(path.getAttribute("d"))).join());
      // There is none until the kernel is loaded.
      await eventually(async () => (await fine()) === "true,true", "curves are solved finely");
      const facts = await page
        .locator(".compared-facts tr")
        .evaluateAll((rows) =>
          Object.fromEntries(
            rows.map(({ cells }) => [
              cells[0].textContent,
              [...cells].slice(1).map(({ textContent }) => Number(textContent.replace("−", "-"))),
            ]),
          ),
        );
      const wide = (k) => facts["greatest x of the curve"][k] - facts["least x of the curve"][k];
      const [first, second] = await boxesSideBySide(page);
      assert.ok(Math.abs(second[2] / first[2] / (wide(1) / wide(0)) - 1) < 0.02, "as they are, at one scale");
      await page.getByLabel("Alignment", { exact: true }).selectOption("place");
      const [a, b] = await boxesSideBySide(page);
      assert.ok(Math.abs(a[0] + a[2] / 2 - b[0] - b[2] / 2) < 1, "middles are at one place");
      await page.getByLabel("Alignment", { exact: true }).selectOption("size");
      const [c, d] = await boxesSideBySide(page);
      assert.ok(Math.abs(Math.hypot(c[2], c[3]) / Math.hypot(d[2], d[3]) - 1) < 0.02, "sizes are alike");
      await gallery.close();
    },
  ],
  [
    "5.4",
    "a curve changed on a plate is pinned with its changes, and compared with the original",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/evans/curve/3.1.1", { reducedMotion: "reduce" });
      const { page } = gallery;
      const pin = page.locator(".plate button.pin");
      await pin.click();
      const field = page.getByLabel("Value of p", { exact: true });
      await field.fill("3.5");
      await field.press("Enter");
      await eventually(async () => (await pin.textContent()) === "Pin", "it is another curve");
      await pin.click();
      const shown = page.locator(".measures tr", { hasText: "swing of the output" }).locator("td.now");
      let swing = Number.NaN;
      await eventually(async () => {
        swing = parseFloat((await shown.allTextContents())[0]);
        return Number.isFinite(swing);
      }, "it is measured");
      // A linkage that cannot be assembled cannot be pinned.
      await field.fill("100");
      await field.press("Enter");
      await eventually(() => pin.isDisabled(), "there is nothing to pin");
      await page.locator(".site-nav a", { hasText: "Compare" }).click();
      await eventually(
        async () => (await page.locator(".pinned-tiles > li").count()) === 2,
        "both are compared",
      );
      assert.match(await gallery.fragment(), /c=evans:3\.1\.1,evans:3\.1\.1%3Fp%3D3\.5$/);
      const row = page.locator(".compared-facts tr", { hasText: "swing of the output" }).locator("td");
      const [recorded, changed] = (await row.allTextContents()).map(parseFloat);
      assert.ok(Math.abs(changed - swing) < 0.006, "measured as on the plate");
      assert.ok(Math.abs(changed - recorded) > 1);
      const link = page.locator(".pinned-tiles .named a").nth(1);
      assert.equal(await link.getAttribute("href"), "#/evans/curve/3.1.1?p=3.5");
      await gallery.go("/compare?c=evans:3.1.1,evans:3.1.1%3Fp%3D100");
      const lede = () => page.locator(".lede").innerText();
      await eventually(
        async () => /skipped evans:3\.1\.1\?p=100: B cannot be placed/.test(await lede()),
        "the linkage that cannot be assembled is reported",
      );
      await gallery.close();
    },
  ],
  [
    "5.5",
    "pins outlast a reload of the page",
    async ({ browser }) => {
      const gallery = await openGallery(browser, small, "/evans/curve/3.1.1", { reducedMotion: "reduce" });
      const { page } = gallery;
      await page.locator(".plate button.pin").click();
      await page.reload();
      await eventually(
        async () => (await page.locator(".plate button.pin").textContent()) === "Pinned",
        "it is still pinned",
      );
      assert.match(await page.locator(".site-nav .count").innerText(), /1/);
      await gallery.close();
    },
  ],
];
