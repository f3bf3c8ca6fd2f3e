// Opens the gallery of an atlas in Chromium from disk, and collects errors.
//
// From the environment: PLAYWRIGHT_CORE, the path of the package playwright-core (its folder or its index.mjs), and
// CHROMIUM, that of the browser. Tests are skipped without them; see `hasBrowser()`.

import assert from "node:assert/strict";
import { existsSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

/** Whether a browser is given in the environment. */
export function hasBrowser() {
  return Boolean(process.env.PLAYWRIGHT_CORE && process.env.CHROMIUM && existsSync(process.env.CHROMIUM));
}

/** Starts Chromium without a window; `close()` it. */
export async function launchBrowser() {
  const place = resolve(process.env.PLAYWRIGHT_CORE);
  const module = statSync(place).isDirectory() ? join(place, "index.mjs") : place;
  const { chromium } = await import(pathToFileURL(module).href);
  // Containers seldom allow the browser's own sandbox; the files are our own. GPU and sound are not needed.
  return chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu", "--mute-audio"],
  });
}

/**
 * Opens `index.html` of the folder of an atlas at a fragment ("/evans/1"), and collects its errors.
 *
 * Options are those of a browser's context: viewport, colorScheme, reducedMotion, hasTouch, isMobile,
 * deviceScaleFactor; `before(page)` is called before anything is loaded. Returns { page, folder, troubles,
 * requests (their addresses), go(fragment), fragment(), settled(), close() }: `close` asserts that there were
 * no console errors, no warnings of the policy, and no request but for files of the atlas. With SLOW=5 in the
 * environment, scripts run five times slower than this machine runs them, as on one that is busy.
 */
export async function openGallery(browser, folder, fragment = "/", { before, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, ...options });
  const page = await context.newPage();
  const home = pathToFileURL(join(resolve(folder), "/")).href;
  const troubles = [];
  const requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) troubles.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => troubles.push(`thrown: ${error.message}`));
  page.on("request", (request) => {
    requests.push(request.url());
    const isOwn = request.url().startsWith(home) || /^(data|blob):/.test(request.url());
    if (!isOwn) troubles.push(`request: ${request.url()}`);
  });
  page.on("requestfailed", (request) => {
    // A picture that was removed before it was loaded is not an error.
    if (request.failure()?.errorText !== "net::ERR_ABORTED") troubles.push(`failed: ${request.url()}`);
  });
  if (process.env.SLOW) {
    const session = await context.newCDPSession(page);
    await session.send("Emulation.setCPUThrottlingRate", { rate: Number(process.env.SLOW) });
  }
  await before?.(page);
  await page.goto(`${home}index.html#${fragment}`);
  await page.waitForSelector("main > *");
  return {
    page,
    folder,
    troubles,
    requests,
    go: (next) => goTo(page, next),
    fragment: () => page.evaluate(() => window.location.hash.slice(1)),
    settled: () => waitUntilSettled(page),
    close: async () => {
      await context.close();
      assert.deepEqual(troubles, [], "the page is not quiet");
    },
  };
}

/** Goes to another fragment, as a link does, and waits until the view is open. */
async function goTo(page, fragment) {
  await page.evaluate((next) => {
    window.location.hash = next;
  }, fragment);
  await waitUntilSettled(page);
}

/** Waits until the view is open and has been painted. */
export async function waitUntilSettled(page) {
  await page.waitForFunction(() => !document.querySelector("main").hasAttribute("aria-busy"));
  await page.evaluate(
    () =>
      new Promise((done) => {
        requestAnimationFrame(() => requestAnimationFrame(done));
      }),
  );
}

/** Waits until `check()` neither throws nor is false, at most `within` milliseconds. */
export async function eventually(check, sentence, within = 5000) {
  const end = Date.now() + within;
  for (;;) {
    try {
      if (await check()) return;
    } catch (error) {
      if (Date.now() > end) throw error;
    }
    assert.ok(Date.now() < end, `${sentence} (not within ${within} ms)`);
    await new Promise((done) => {
      setTimeout(done, 25);
    });
  }
}

/** Exports by the menu of the open view, and returns { name, bytes, text }. */
export async function saved(page, label) {
  await page.click(".export-button");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator(".export-menu").getByRole("menuitem", { name: label, exact: true }).click(),
  ]);
  const bytes = readFileSync(await download.path());
  return { name: download.suggestedFilename(), bytes, text: bytes.toString("utf8") };
}

// The slowest test takes a few seconds; a browser that has died may never answer.
const TEST_SECONDS = 120;

/** The result of a promise, or an error if there is none after some seconds. */
function within(seconds, promise) {
  let timer = null;
  const late = new Promise((_, fail) => {
    timer = setTimeout(() => fail(new Error(`no result after ${seconds} seconds`)), 1000 * seconds);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/**
 * Runs tests [[point, sentence, async function (context)], …] one after another, a line for each: "ok 1.2
 * sentence" or "FAILED …" with what was wrong, and ends the process: with 1 if one failed; with 0 and a message
 * where there is no browser. A browser that has died is started again.
 */
export async function runTests(tests, context = {}) {
  if (!hasBrowser()) {
    console.log("skipped: PLAYWRIGHT_CORE and CHROMIUM name no browser");
    return;
  }
  let browser = await launchBrowser();
  const only = process.env.ONLY;
  let failed = 0;
  for (const [point, sentence, test] of tests.filter(([point]) => !only || point.startsWith(only))) {
    try {
      if (!browser.isConnected()) browser = await launchBrowser();
      await within(TEST_SECONDS, test({ browser, ...context }));
      console.log(`ok ${point} ${sentence}`);
    } catch (error) {
      failed += 1;
      console.log(
        `FAILED ${point} ${sentence}\n  ${String(error.stack ?? error)
          .split("\n")
          .slice(0, 12)
          .join("\n  ")}`,
      );
    }
  }
  await within(10, browser.close()).catch((error) =>
    console.log(`the browser was not closed: ${error.message}`),
  );
  // What a dead browser has left open does not keep the process alive.
  process.exit(failed ? 1 : 0);
}

/**
 * The contrast ratio of WCAG of the text of an element to its background, 1 to 21.
 */
export function contrastOf(locator) {
  return locator.evaluate((element) => {
    // A canvas converts colours of any notation.
    const context = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const rgba = (color) => {
      context.clearRect(0, 0, 1, 1);
      context.fillStyle = color;
      context.fillRect(0, 0, 1, 1);
      return [...context.getImageData(0, 0, 1, 1).data];
    };
    const behind = (node) => {
      for (let up = node; up; up = up.parentElement) {
        const color = rgba(getComputedStyle(up).backgroundColor);
        if (color[3] === 255) return color;
      }
      return [255, 255, 255, 255];
    };
    const part = (level) =>
      level / 255 <= 0.04045 ? level / 255 / 12.92 : ((level / 255 + 0.055) / 1.055) ** 2.4;
    const luminance = ([r, g, b]) => 0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b);
    const [text, ground] = [luminance(rgba(getComputedStyle(element).color)), luminance(behind(element))];
    return (Math.max(text, ground) + 0.05) / (Math.min(text, ground) + 0.05);
  });
}
