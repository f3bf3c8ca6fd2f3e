// Tests zooming and moving a page by wheel, drag, fingers, keys and buttons.

import assert from "node:assert/strict";

import { eventually, waitUntilSettled } from "./browser.mjs";
import {
  atlas,
  addTest,
  large,
  viewportCentre,
  zoomPercent,
  startAt,
  PHONE,
  sheetBox,
} from "./pages-support.mjs";

addTest(
  "1.5",
  "a page is its SVG, which is resized and never scaled",
  startAt(large, "/hrones-nelson/100"),
  async (g, page) => {
    const image = page.locator(".page-sheet img");
    assert.match(await image.getAttribute("src"), /hrones-nelson-100\.svg$/);
    await page.locator(".viewport").focus();
    for (let k = 0; k < 12; k += 1) await page.keyboard.press("+");
    await eventually(async () => (await zoomPercent(page)) === 3200, "as near as may be");
    const shown = await image.evaluate((element) => ({
      box: element.getBoundingClientRect().width,
      laid: element.clientWidth,
      transform: getComputedStyle(element.parentElement).transform,
    }));
    assert.equal(Math.round(shown.box), shown.laid, "no scaling");
    assert.match(shown.transform, /^matrix\(1, 0, 0, 1,/);
    assert.ok(shown.laid > 20000);
  },
);

addTest(
  "1.6",
  "the wheel zooms about the pointer, and the address keeps the zoom",
  startAt(large, "/hrones-nelson/3"),
  async (g, page) => {
    const { box } = await viewportCentre(page);
    // Wheel events have integer coordinates.
    const [x, y] = [Math.round(box.x + box.width * 0.3), Math.round(box.y + box.height * 0.6)];
    const placeUnder = async () => {
      const sheet = await sheetBox(page);
      return [(x - sheet.x) / sheet.width, (y - sheet.y) / sheet.height];
    };
    await page.mouse.move(x, y);
    const before = await placeUnder();
    for (let k = 0; k < 4; k += 1) {
      await page.mouse.wheel(0, -200);
      await waitUntilSettled(page);
    }
    const after = await placeUnder();
    // The pointer is over the same point, to half a pixel of 3,000.
    assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 2e-4, `${before} and ${after}`);
    assert.ok((await zoomPercent(page)) > 300);
    await eventually(async () => /zoom=3\.\d+&at=/.test(await g.fragment()), "the address says where");
    const address = await g.fragment();
    const where = await sheetBox(page);
    await page.reload();
    await page.waitForSelector(".page-sheet img");
    await waitUntilSettled(page);
    const again = await sheetBox(page);
    assert.ok(
      Math.abs(again.width - where.width) < 20 && Math.abs(again.x - where.x) < 8,
      `${address} leads elsewhere`,
    );
    await page.mouse.wheel(0, 5000);
    for (let k = 0; k < 8; k += 1) await page.mouse.wheel(0, 300);
    await eventually(async () => (await zoomPercent(page)) === 100, "never further than the whole page");
  },
);

addTest("1.7", "a page is moved by drag, keys and buttons", startAt(atlas, "/watt/1"), async (g, page) => {
  const { x, y } = await viewportCentre(page);
  await page.getByRole("button", { name: "Zoom in" }).click();
  await page.getByRole("button", { name: "Zoom in" }).click();
  await waitUntilSettled(page);
  const start = await sheetBox(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y - 30, { steps: 4 });
  await page.mouse.up();
  await waitUntilSettled(page);
  const dragged = await sheetBox(page);
  assert.deepEqual([Math.round(dragged.x - start.x), Math.round(dragged.y - start.y)], [40, -30]);
  await page.locator(".viewport").focus();
  await page.keyboard.press("ArrowRight");
  await waitUntilSettled(page);
  assert.ok((await sheetBox(page)).x < dragged.x);
  await page.keyboard.press("0");
  await eventually(async () => (await zoomPercent(page)) === 100, "0 shows the whole page");
  assert.equal(await page.getByRole("button", { name: "Fit" }).getAttribute("aria-pressed"), "true");
});

addTest("1.8", "two fingers zoom in", startAt(large, "/hrones-nelson/5", PHONE), async (g, page) => {
  const { x, y } = await viewportCentre(page);
  const client = await page.context().newCDPSession(page);
  const touch = (type, apart) =>
    client.send("Input.dispatchTouchEvent", {
      type,
      touchPoints:
        apart === null
          ? []
          : [
              { x: x - apart, y, id: 1 },
              { x: x + apart, y, id: 2 },
            ],
    });
  await touch("touchStart", 30);
  for (let apart = 32; apart <= 90; apart += 4) await touch("touchMove", apart);
  await touch("touchEnd", null);
  await eventually(async () => (await zoomPercent(page)) > 250, "two fingers zoom in");
});

addTest(
  "1.15",
  "the centre of the view is kept when the window is resized, and on the next page",
  startAt(large, "/hrones-nelson/123?zoom=20.00&at=200.0,120.0"),
  async (g, page) => {
    const zoomInAddress = async () => {
      const [, zoom, x, y] = (await g.fragment()).match(/zoom=([\d.]+)&at=([\d.]+),([\d.]+)/) ?? [];
      return [zoom, x, y].map(Number);
    };
    await page.setViewportSize({ width: 1024, height: 700 });
    await eventually(async () => Math.abs((await zoomInAddress())[0] - 20) > 1, "the address has the zoom");
    const [zoom, x, y] = await zoomInAddress();
    assert.ok(zoom <= 32, "no nearer than can be");
    assert.ok(Math.hypot(x - 200, y - 120) < 0.25, `the middle is at ${x}, ${y}`);
    await page.keyboard.press("n");
    await eventually(
      async () => (await g.fragment()).startsWith("/hrones-nelson/124?zoom="),
      "the address of the next page has the same zoom",
    );
    assert.deepEqual(await zoomInAddress(), [zoom, x, y]);
  },
);

const low = { viewport: { width: 700, height: 500 } };
addTest(
  "1.16",
  "arrow keys scroll below a page that fits",
  startAt(atlas, "/evans/1", low),
  async (g, page) => {
    await page.locator(".viewport").focus();
    await page.keyboard.press("ArrowDown");
    await eventually(async () => (await page.evaluate(() => window.scrollY)) > 10, "the window is scrolled");
  },
);
