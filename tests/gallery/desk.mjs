// What the tests of the gallery's pages share: their atlases, their register, and hands that point.

import { opened, settled } from "./browser.mjs";

/** The folders of the atlas of atlas.toml, and of one of 7,800 curves. */
export const [atlas, large] = process.argv.slice(2);

/** A telephone held upright. */
export const PHONE = {
  viewport: { width: 360, height: 740 },
  hasTouch: true,
  isMobile: true,
  deviceScaleFactor: 2,
};

/** All tests, as runTests() of browser.mjs takes them. */
export const CHECKS = [];

/** Where a test begins: an atlas, a fragment, and the options of the browser's context. */
export const on = (folder, fragment, options = {}) => ({ folder, fragment, options });

/**
 * Puts down a test. With a place to begin on, it is given the opened gallery and its page, which is closed
 * after it: the test fails if the page was not quiet. Without, it is given { browser }.
 */
export function check(point, sentence, place, test) {
  const opening = async ({ browser }) => {
    const gallery = await opened(browser, place.folder, place.fragment, place.options);
    await settled(gallery.page);
    await test(gallery, gallery.page);
    await gallery.close();
  };
  CHECKS.push([point, sentence, place ? opening : test]);
}

/** The box, in pixels of the window, of a curve on the page that is shown. */
export function boxOfCurve(page, id, key) {
  return page.locator(`.overlay a[href$="/${id}/curve/${key}"] .link-area`).evaluate((spot) => {
    const { left, right, top, bottom } = spot.getBoundingClientRect();
    return { left, right, top, bottom };
  });
}

/** Moves the pointer over the box of a curve until it is forward; true if it ever was. */
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

/** How near the page is, in per cent of the whole. */
export const nearness = (page) =>
  page.locator(".zoom-level").evaluate((element) => parseInt(element.textContent, 10));

/** Where the sheet is in the window. */
export const sheetBox = (page) => page.locator(".page-sheet").boundingBox();

/** What was last said to screen readers. */
export const announced = (page) => page.locator("[role=status]").textContent();

/** The centre of the viewport, in pixels. */
export async function middleOfDesk(page) {
  const box = await page.locator(".viewport").boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2, box };
}
