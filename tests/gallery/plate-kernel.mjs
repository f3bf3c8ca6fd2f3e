// Tests what the page does without WebAssembly or without its kernel, and after a failure of the kernel.

import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { eventually, openGallery } from "./browser.mjs";
import { REDUCED_MOTION, inputNow } from "./plate-support.mjs";

const SENTENCE = /^This browser does not run WebAssembly: /;

const withoutWebAssembly = (page) =>
  page.addInitScript(() => {
    delete globalThis.WebAssembly;
  });

/** Makes the function of the kernel with a name fail while `window.failing` is its name. */
const failingKernel = (page) =>
  page.addInitScript(() => {
    const { Instance } = WebAssembly;
    WebAssembly.Instance = function instance(...more) {
      const { exports } = new Instance(...more);
      const failing = { ...exports };
      for (const name of ["kernel_pose", "kernel_call"])
        failing[name] = (...numbers) => {
          if (window.failing !== name) return exports[name](...numbers);
          throw new WebAssembly.RuntimeError("unreachable");
        };
      return { exports: failing };
    };
  });

export const KERNEL = [
  [
    "3.17",
    "without WebAssembly a plate shows its curve and says what does not work",
    async ({ browser, folder }) => {
      const { page, requests, go, close } = await openGallery(browser, folder, "/evans/curve/1.1.1", {
        before: withoutWebAssembly,
      });
      assert.match(await page.locator(".plate .error").textContent(), SENTENCE);
      await page.waitForSelector(".still-plate path");
      assert.ok((await page.locator("table.measures tbody tr:visible").count()) > 20);
      await page.click(".export-button");
      await page.getByRole("menuitem", { name: "CSV points" }).click();
      await eventually(
        async () => SENTENCE.test(await page.textContent(".export-status")),
        "an export says why it is not made",
      );
      await go("/evans/curve/2.1.1?p=3");
      assert.match(await page.locator(".plate .error").textContent(), SENTENCE);
      await go("/find?family=evans");
      await page.waitForSelector(".results > li");
      await go("/evans/1?curve=3.1.1");
      await page.waitForSelector(".page-sheet .picture");
      await go(
        `/compare?c=${["evans:1.1.1", "evans:2.1.1?p=3", "evans:3.1.1"].map(encodeURIComponent).join()}`,
      );
      await page.waitForSelector(".pinned-tiles li");
      assert.equal(await page.locator(".pinned-tiles li").count(), 2);
      assert.match(
        await page.locator(".compare-view .lede").textContent(),
        /skipped evans:2\.1\.1\?p=3: This browser/,
      );
      assert.equal(kernelsIn(requests), 0);
      await close();
    },
  ],
  [
    "3.18",
    "a failure of the kernel is reported, and the plate goes on after it",
    async ({ browser, folder }) => {
      const { page, requests, close } = await openGallery(browser, folder, "/evans/curve/1.1.1", {
        before: failingKernel,
        ...REDUCED_MOTION,
      });
      const reason = page.locator(".stage .reason");
      const before = await inputNow(page);
      const fail = (name) =>
        page.evaluate((failing) => {
          window.failing = failing;
        }, name);
      await fail("kernel_pose");
      await page.keyboard.press("ArrowRight");
      await eventually(() => reason.isVisible(), "it is not reported");
      await fail(null);
      assert.match(await reason.textContent(), /^Stopped: the kernel failed: unreachable/);
      // A change opens the family and its study again.
      await page.getByRole("spinbutton", { name: "Value of p", exact: true }).fill("2.2");
      await eventually(() => reason.isHidden(), "the plate does not go on");
      await page.locator("h1").click();
      await page.keyboard.press("ArrowRight");
      await eventually(async () => (await inputNow(page)) > before, "it does not move");
      await fail("kernel_call");
      await page.getByRole("spinbutton", { name: "Value of p", exact: true }).fill("2.4");
      await eventually(() => reason.isVisible(), "a failing study is not reported");
      await fail(null);
      await page.getByRole("spinbutton", { name: "Value of p", exact: true }).fill("2.5");
      await eventually(() => reason.isHidden(), "the plate does not go on");
      assert.equal(kernelsIn(requests), 1, "its script is loaded once");
      await close();
    },
  ],
  [
    "3.19",
    "a script of the kernel that is missing, damaged or of another version is named where it is needed",
    async ({ browser, folder }) => {
      const digest = /"sha256":"[0-9a-f]{64}"/;
      const another = (script) => script.replace(digest, `"sha256":"${"0".repeat(64)}"`);
      // The letters of base64 in the middle of the module.
      const damaged = (script) => script.replace(/(?<=.{50000})[A-Za-z]{8}/s, "AAAAAAAA");
      const cases = [
        [() => null, "kernel.js cannot be read"],
        [() => "", "kernel.js cannot be read"],
        [another, "kernel.js is of another version than this page"],
        [damaged, "kernel.js is damaged"],
      ];
      for (const [change, what] of cases) {
        const copy = atlasWithKernel(folder, change);
        try {
          const gallery = await openGallery(browser, copy, "/evans/curve/1.1.1");
          const { page, troubles } = gallery;
          const sentence = `${what}: render the atlas again. Without it, linkages are not moved, `;
          const says = async (selector) => (await page.textContent(selector)).includes(sentence);
          assert.ok(await says(".plate .error"), what);
          await page.waitForSelector(".still-plate path");
          await page.click(".export-button");
          await page.getByRole("menuitem", { name: "CSV points" }).click();
          await eventually(() => says(".export-status"), "an export says why it is not made");
          await gallery.go("/shape?like=evans:1.1.1");
          await eventually(() => says(".four-bar-section .counted"), "a search says why it is not made");
          await gallery.go("/evans/1?curve=3.1.1");
          await page.waitForSelector(".page-sheet .picture");
          // The browser reports a missing file itself.
          const isOfKernel = (trouble) => /kernel\.js|ERR_FILE_NOT_FOUND/.test(trouble);
          assert.deepEqual(
            troubles.splice(0).filter((trouble) => !isOfKernel(trouble)),
            [],
          );
          await gallery.close();
        } finally {
          rmSync(copy, { recursive: true });
        }
      }
    },
  ],
];

/** How often the script of the kernel is among requests. */
function kernelsIn(requests) {
  return requests.filter((url) => url.endsWith("/kernel.js")).length;
}

/** A copy of an atlas; `change` is given the script of the kernel, and gives what is written, null for no file. */
function atlasWithKernel(from, change) {
  const folder = mkdtempSync(join(tmpdir(), "coupler-atlas-kernel-"));
  cpSync(from, folder, { recursive: true, dereference: true });
  const file = join(folder, "kernel.js");
  const script = change(readFileSync(file, "utf8"));
  rmSync(file);
  if (script !== null) writeFileSync(file, script);
  return folder;
}
