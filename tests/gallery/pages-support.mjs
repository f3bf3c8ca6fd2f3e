// Helpers of the tests of the gallery's pages: their atlases, the list of tests, and pointing at curves.

import { openGallery, waitUntilSettled } from "./browser.mjs";

/** The folders of the atlas of atlas.toml, and of one of 7,800 curves. */
export const [atlas, large] = process.argv.slice(2);

/** The options of a phone in portrait format. */
export const PHONE = {
  viewport: { width: 360, height: 740 },
  hasTouch: true,
  isMobile: true,
  deviceScaleFactor: 2,
};

/** All tests, in the form of runTests() of browser.mjs. */
export const TESTS = [];

/** The start of a test: an atlas, a fragment, and the options of the browser's context. */
export const startAt = (folder, fragment, options = {}) => ({ folder, fragment, options });

/**
 * Adds a test. With a start, it is called with the opened gallery and its page, which is closed after it: the
 * test fails if the page logged errors. Without, it is called with { browser }.
 */
export function addTest(point, sentence, place, test) {
  const opening = async ({ browser }) => {
    const gallery = await openGallery(browser, place.folder, place.fragment, place.options);
    await waitUntilSettled(gallery.page);
    await test(gallery, gallery.page);
    await gallery.close();
  };
  TESTS.push([point, sentence, place ? opening : test]);
}

/** The box, in pixels of the window, of a curve on the page that is shown. */
export function boxOfCurve(page, id, key) {
  return page.locator(`.overlay a[href$="/${id}/curve/${key}"] .link-area`).evaluate((spot) => {
    const { left, right, top, bottom } = spot.getBoundingClientRect();
    return { left, right, top, bottom };
  });
}

/** Moves the pointer over the box of a curve until the curve is highlighted; false if it never is. */
export async function pointAt(page, id, key) {
  const { left, right, top, bottom } = await boxOfCurve(page, id, key);
  for (let y = top; y <= bottom; y += 2) {
    await page.mouse.move((left + right) / 2, y);
    const href = await page
      .locator(".page-panel .button")
      .first()
      .getAttribute("href", { timeout: 200 })
      .catch(() => null);
    if (href === `#/${id}/curve/${key}` && (await page.locator(".viewport.dimmed").count())) return true;
  }
  return false;
}

/** The zoom of the page, in per cent of the whole. */
export const zoomPercent = (page) =>
  page.locator(".zoom-level").evaluate((element) => parseInt(element.textContent, 10));

/** The box of the sheet in the window. */
export const sheetBox = (page) => page.locator(".page-sheet").boundingBox();

/** The last announcement to screen readers. */
export const announced = (page) => page.locator("[role=status]").textContent();

/** The centre of the viewport, in pixels. */
export async function viewportCentre(page) {
  const box = await page.locator(".viewport").boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2, box };
}
