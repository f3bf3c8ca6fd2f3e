// Tests the motion of the plate of a curve, and dragging its joints.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import { REDUCED_MOTION, gripAt, inputNow, assertNear, crankAngle, pivotsOf } from "./plate-support.mjs";

export const MOTION = [
  [
    "3.1",
    "the motion starts by itself, and the space bar pauses and plays it",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1");
      const { page } = plate;
      const before = await inputNow(page);
      await eventually(async () => (await inputNow(page)) !== before, "nothing moves");
      await page.keyboard.press("Space");
      const paused = await inputNow(page);
      await page.waitForTimeout(200);
      assert.equal(await inputNow(page), paused);
      await page.keyboard.press("Space");
      await eventually(async () => (await inputNow(page)) !== paused, "it does not continue");
      await plate.close();
    },
  ],
  [
    "3.1",
    "the motion does not start by itself if reduced motion is preferred",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const before = await inputNow(plate.page);
      await plate.page.waitForTimeout(300);
      assert.equal(await inputNow(plate.page), before);
      assert.equal(await plate.page.getByRole("button", { name: "Play" }).count(), 1);
      await plate.close();
    },
  ],
  [
    "3.1",
    "the motion stops when the plate is left",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1");
      await plate.go("/");
      const frames = await plate.page.evaluate(
        () =>
          new Promise((done) => {
            const ask = window.requestAnimationFrame;
            let asked = 0;
            window.requestAnimationFrame = (f) => {
              asked += 1;
              return ask.call(window, f);
            };
            setTimeout(() => {
              window.requestAnimationFrame = ask;
              done(asked);
            }, 300);
          }),
      );
      assert.equal(frames, 0);
      await plate.close();
    },
  ],
  [
    "3.2",
    "the slider changes the input, and its keys step by a degree and to limits",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/watt/curve/3.1.1", REDUCED_MOTION);
      const { page } = plate;
      const scrub = page.getByRole("slider", { name: "Position on the circuit" });
      await scrub.focus();
      const before = await inputNow(page);
      await page.keyboard.press("ArrowRight");
      assertNear(await inputNow(page), before + 1, 0.11, "a step of a degree");
      await page.keyboard.press("Shift+ArrowLeft");
      assertNear(await inputNow(page), before - 9, 0.11, "ten degrees back");
      // Crank and coupler in line: 9 = 4 + 16 - 16 cos, so the limits are at arccos(11 / 16).
      const limit = (Math.acos(11 / 16) * 180) / Math.PI;
      await page.keyboard.press("End");
      assertNear(await inputNow(page), limit, 0.051, "the limit");
      await page.keyboard.press("End");
      assertNear(await inputNow(page), -limit, 0.051, "the other limit");
      assert.match(await scrub.getAttribute("aria-valuetext"), /^input −46\.6°$/);
      assert.match(await page.locator(".ends").textContent(), /−46\.6° to 46\.6°/);
      await plate.close();
    },
  ],
  [
    "3.3",
    "the crank follows a drag turn after turn",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      const [pivot] = await pivotsOf(page);
      const at = await gripAt(page, 2);
      const radius = Math.hypot(at[0] - pivot[0], at[1] - pivot[1]);
      await page.mouse.move(...at);
      await page.mouse.down();
      const from = await crankAngle(page, pivot, 2);
      for (let deg = 0; deg <= 500; deg += 10) {
        const angle = ((from + deg) * Math.PI) / 180;
        await page.mouse.move(
          pivot[0] + 1.4 * radius * Math.cos(angle),
          pivot[1] - 1.4 * radius * Math.sin(angle),
        );
      }
      await page.mouse.up();
      const wanted = (((from + 500) % 360) + 360) % 360;
      assertNear(((await crankAngle(page, pivot, 2)) + 360) % 360, wanted, 1, "the crank's direction");
      assertNear(await inputNow(page), wanted, 1, "the input");
      await plate.close();
    },
  ],
  [
    "3.3",
    "a drag beyond a limit comes back on the other branch",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/watt/curve/3.1.1", REDUCED_MOTION);
      const { page } = plate;
      const [pivot] = await pivotsOf(page);
      await page.getByRole("slider", { name: "Position on the circuit" }).fill("0.2");
      const rocker = await gripAt(page, 3);
      const input = await inputNow(page);
      const at = await gripAt(page, 2);
      const radius = Math.hypot(at[0] - pivot[0], at[1] - pivot[1]);
      const to = async (deg) => {
        const angle = (deg * Math.PI) / 180;
        await page.mouse.move(pivot[0] + radius * Math.cos(angle), pivot[1] - radius * Math.sin(angle));
      };
      await page.mouse.move(...at);
      await page.mouse.down();
      for (let deg = input; deg <= 70; deg += 3) await to(deg);
      await to(70);
      assertNear(await inputNow(page), 46.567, 0.06, "it stays at the limit");
      for (let deg = 70; deg >= input; deg -= 3) await to(deg);
      await to(input);
      await page.mouse.up();
      assertNear(await inputNow(page), input, 0.3, "back at the input");
      const other = await gripAt(page, 3);
      assert.ok(
        Math.hypot(other[0] - rocker[0], other[1] - rocker[1]) > 20,
        "the rocker's pin is where it was",
      );
      await plate.close();
    },
  ],
  [
    "3.3",
    "any other joint can be dragged along its path",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/jansen/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      const foot = await gripAt(page, 7);
      await page.mouse.move(...foot);
      await page.mouse.down();
      await page.mouse.move(foot[0] + 60, foot[1] - 2, { steps: 12 });
      await page.mouse.up();
      const after = await gripAt(page, 7);
      assert.ok(Math.abs(after[0] - foot[0]) > 30, `the foot went from ${foot} to ${after}`);
      await plate.close();
    },
  ],
  [
    "3.3",
    "a finger drags joints, and two fingers zoom and move the picture",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/chebyshev/curve/1.1.1", {
        ...REDUCED_MOTION,
        hasTouch: true,
        viewport: { width: 360, height: 740 },
      });
      const { page } = plate;
      await page.locator(".stage").scrollIntoViewIfNeeded();
      const session = await page.context().newCDPSession(page);
      const touch = (type, ...points) =>
        session.send("Input.dispatchTouchEvent", {
          type,
          touchPoints: points.map(([x, y], id) => ({ x, y, id })),
        });
      const joint = Number(await page.locator(".grip:not(.crank-grip)").first().getAttribute("data-joint"));
      const [x, y] = await gripAt(page, joint);
      const before = await inputNow(page);
      await touch("touchStart", [x, y]);
      for (let k = 1; k <= 8; k += 1) await touch("touchMove", [x + 4 * k, y + 2 * k]);
      await touch("touchEnd");
      assert.notEqual(await inputNow(page), before);
      const scale = async () =>
        Number(/matrix\(([\d.]+)/.exec(await page.locator(".still > g").getAttribute("transform"))[1]);
      const fitted = await scale();
      const { left, top } = await page
        .locator(".stage")
        .evaluate((stage) => stage.getBoundingClientRect().toJSON());
      await touch("touchStart", [left + 20, top + 20]);
      await touch("touchStart", [left + 20, top + 20], [left + 60, top + 20]);
      for (let k = 1; k <= 8; k += 1)
        await touch("touchMove", [left + 20, top + 20], [left + 60 + 8 * k, top + 20]);
      await touch("touchEnd");
      assert.ok((await scale()) > 1.5 * fitted, `the scale went from ${fitted} to ${await scale()}`);
      const sheetAt = async () => {
        const matrix = await page.locator(".still > g").getAttribute("transform");
        return matrix
          .match(/-?[\d.]+/g)
          .slice(-2)
          .map(Number);
      };
      const [fromX, fromY] = await sheetAt();
      await touch("touchStart", [left + 20, top + 20], [left + 60, top + 20]);
      for (let k = 1; k <= 8; k += 1)
        await touch("touchMove", [left + 20 + 5 * k, top + 20], [left + 60 + 5 * k, top + 20]);
      await touch("touchEnd");
      const [toX, toY] = await sheetAt();
      // Each finger ends 40 pixels to the right; the zoom while one is ahead of the other is undone.
      assertNear(toX - fromX, 40, 4, "two fingers move it across");
      assertNear(toY, fromY, 1, "and not down");
      await plate.close();
    },
  ],
  [
    "3.4",
    "both branches can be chosen, and the choice is in the address",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      const before = await gripAt(page, 3);
      await page.getByRole("radio", { name: /^2: a full turn, branch −1/ }).check();
      await eventually(async () => /circuit=2/.test(await plate.fragment()), "the address does not say it");
      const after = await gripAt(page, 3);
      assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) > 20);
      await plate.go("/evans/curve/1.1.1");
      assert.ok(await page.getByRole("radio", { name: /^1: .*this curve/ }).isChecked());
      await plate.close();
    },
  ],
];
