// A page near and far: by wheel, drag, fingers, keys and buttons.

import assert from "node:assert/strict";

import { eventually, settled } from "./browser.mjs";
import { atlas, check, large, middleOfDesk, nearness, on, PHONE, sheetBox } from "./desk.mjs";

check(
  "1.5",
  "a page is its SVG, sized and never scaled",
  on(large, "/hrones-nelson/100"),
  async (g, page) => {
    const image = page.locator(".page-sheet img");
    assert.match(await image.getAttribute("src"), /hrones-nelson-100\.svg$/);
    await page.locator(".viewport").focus();
    for (let k = 0; k < 12; k += 1) await page.keyboard.press("+");
    await eventually(async () => (await nearness(page)) === 3200, "as near as may be");
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

check(
  "1.6",
  "nearer and further by wheel, about the pointer; the address keeps it",
  on(large, "/hrones-nelson/3"),
  async (g, page) => {
    const { box } = await middleOfDesk(page);
    // A wheel is told at whole pixels.
    const [x, y] = [Math.round(box.x + box.width * 0.3), Math.round(box.y + box.height * 0.6)];
    const placeUnder = async () => {
      const sheet = await sheetBox(page);
      return [(x - sheet.x) / sheet.width, (y - sheet.y) / sheet.height];
    };
    await page.mouse.move(x, y);
    const before = await placeUnder();
    for (let k = 0; k < 4; k += 1) {
      await page.mouse.wheel(0, -200);
      await settled(page);
    }
    const after = await placeUnder();
    // The pointer is over the same place, to half a pixel of 3,000.
    assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 2e-4, `${before} and ${after}`);
    assert.ok((await nearness(page)) > 300);
    await eventually(async () => /zoom=3\.\d+&at=/.test(await g.fragment()), "the address says where");
    const address = await g.fragment();
    const where = await sheetBox(page);
    await page.reload();
    await page.waitForSelector(".page-sheet img");
    await settled(page);
    const again = await sheetBox(page);
    assert.ok(
      Math.abs(again.width - where.width) < 20 && Math.abs(again.x - where.x) < 8,
      `${address} leads elsewhere`,
    );
    await page.mouse.wheel(0, 5000);
    for (let k = 0; k < 8; k += 1) await page.mouse.wheel(0, 300);
    await eventually(async () => (await nearness(page)) === 100, "never further than the whole page");
  },
);

check("1.7", "moved by drag, keys and buttons", on(atlas, "/watt/1"), async (g, page) => {
  const { x, y } = await middleOfDesk(page);
  await page.getByRole("button", { name: "Zoom in" }).click();
  await page.getByRole("button", { name: "Zoom in" }).click();
  await settled(page);
  const start = await sheetBox(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y - 30, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  const dragged = await sheetBox(page);
  assert.deepEqual([Math.round(dragged.x - start.x), Math.round(dragged.y - start.y)], [40, -30]);
  await page.locator(".viewport").focus();
  await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.ok((await sheetBox(page)).x < dragged.x);
  await page.keyboard.press("0");
  await eventually(async () => (await nearness(page)) === 100, "0 shows the whole page");
  assert.equal(await page.getByRole("button", { name: "Fit" }).getAttribute("aria-pressed"), "true");
});

check("1.8", "nearer by two fingers", on(large, "/hrones-nelson/5", PHONE), async (g, page) => {
  const { x, y } = await middleOfDesk(page);
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
  await eventually(async () => (await nearness(page)) > 250, "two fingers bring the page nearer");
});

check(
  "1.15",
  "what is in the middle stays there in a window of another size, and on the next page",
  on(large, "/hrones-nelson/123?zoom=20.00&at=200.0,120.0"),
  async (g, page) => {
    const asked = async () => {
      const [, zoom, x, y] = (await g.fragment()).match(/zoom=([\d.]+)&at=([\d.]+),([\d.]+)/) ?? [];
      return [zoom, x, y].map(Number);
    };
    await page.setViewportSize({ width: 1024, height: 700 });
    await eventually(async () => Math.abs((await asked())[0] - 20) > 1, "the address says how near it is");
    const [zoom, x, y] = await asked();
    assert.ok(zoom <= 32, "no nearer than can be");
    assert.ok(Math.hypot(x - 200, y - 120) < 0.25, `the middle is at ${x}, ${y}`);
    await page.keyboard.press("n");
    await eventually(
      async () => (await g.fragment()).startsWith("/hrones-nelson/124?zoom="),
      "the address of the next page is as near",
    );
    assert.deepEqual(await asked(), [zoom, x, y]);
  },
);

const low = { viewport: { width: 700, height: 500 } };
check("1.16", "arrows scroll to what is below a whole page", on(atlas, "/evans/1", low), async (g, page) => {
  await page.locator(".viewport").focus();
  await page.keyboard.press("ArrowDown");
  await eventually(async () => (await page.evaluate(() => window.scrollY)) > 10, "the window is scrolled");
});
