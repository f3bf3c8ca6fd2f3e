// Tests the quantities shown on the plate of a curve.

import assert from "node:assert/strict";

import { openGallery } from "./browser.mjs";
import { REDUCED_MOTION, assertNear } from "./plate-support.mjs";

export const READINGS = [
  [
    "3.5",
    "the dial shows the transmission angle and its range",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      await page.getByRole("slider", { name: "Position on the circuit" }).fill("0");
      // At input 0 the crank lies on the frame: coupler and rocker close a triangle with p - r = 1.
      const mu = (Math.acos((2 * 2.59 * 2.59 - 1) / (2 * 2.59 * 2.59)) * 180) / Math.PI;
      assertNear(
        Number((await page.locator(".dial-now").textContent()).replace("°", "")),
        mu,
        0.051,
        "the angle now",
      );
      const note = await page.locator(".dial-gauge .note").textContent();
      assert.match(note, /least 22\.3°, greatest 70\.8°/);
      await plate.close();
    },
  ],
  [
    "3.6",
    "the speed is shown, on request with an arrow",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/scotch-yoke/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      assert.ok((await page.locator(".graph-line").getAttribute("d")).length > 200);
      assert.equal(await page.locator(".moving .velocity").getAttribute("d"), "");
      await page.getByRole("checkbox", { name: "Velocity" }).check();
      assert.match(await page.locator(".moving .velocity").getAttribute("d"), /^M.*L/);
      assert.match(await plate.fragment(), /show=.*velocity/);
      await plate.close();
    },
  ],
  [
    "3.7",
    "the marked straight portion has the length recorded in the atlas",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      const [length, scale] = await page.evaluate(() => {
        const band = document.querySelector(".band");
        const numbers = band
          .getAttribute("d")
          .match(/-?[\d.e-]+/g)
          .map(Number);
        const n = numbers.length;
        const bar =
          document.querySelector(".scale-bar").getBBox().width /
          Number(document.querySelector(".scale-label").textContent);
        return [Math.hypot(numbers[n - 2] - numbers[0], numbers[n - 1] - numbers[1]), bar];
      });
      assertNear(length, 1.71034663, 2e-3, "the band");
      assert.ok(scale > 10);
      await plate.close();
    },
  ],
  [
    "3.8",
    "the cognates draw the same curve",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/cognates/curve/2.1.1", REDUCED_MOTION);
      const { page } = plate;
      await page.getByRole("checkbox", { name: "Cognates" }).check();
      for (const part of ["0.1", "0.5", "0.85"]) {
        await page.getByRole("slider", { name: "Position on the circuit" }).fill(part);
        const apart = await page.evaluate(() => {
          const [x, y] = ["cx", "cy"].map((name) =>
            Number(document.querySelector(".tracer").getAttribute(name)),
          );
          return [...document.querySelectorAll(".cognate.first, .cognate.second")].map((path) => {
            // Crank, then the plate's third corner, then the rocker.
            const numbers = path
              .getAttribute("d")
              .match(/-?[\d.]+/g)
              .map(Number);
            return Math.hypot(numbers[8] - x, numbers[9] - y);
          });
        });
        assert.equal(apart.length, 2);
        for (const far of apart) assert.ok(far < 0.05, `the coupler points are ${far} px apart`);
      }
      assert.equal(await page.locator(".cognate-lengths thead th").count(), 4);
      await plate.close();
    },
  ],
  [
    "3.9",
    "the centrodes touch at the pole, where crank and rocker intersect",
    async ({ browser, folder }) => {
      const plate = await openGallery(
        browser,
        folder,
        "/evans/curve/1.1.1?show=names,centrodes,inflection",
        REDUCED_MOTION,
      );
      const { page } = plate;
      const found = await page.evaluate(() => {
        const number = (element, name) => Number(element.getAttribute(name));
        const at = (joint) => {
          const g = document.querySelector(`.grip[data-joint="${joint}"]:not(.crank-grip)`);
          return [number(g, "cx"), number(g, "cy")];
        };
        const pivots = [...document.querySelectorAll(".pivot:not(.inner)")].map((c) => [
          number(c, "cx"),
          number(c, "cy"),
        ]);
        const [o, c] = pivots.sort((p, q) => p[0] - q[0]);
        const [a, b] = [at(2), at(3)];
        const cross = (u, v) => u[0] * v[1] - u[1] * v[0];
        const [u, v] = [
          [a[0] - o[0], a[1] - o[1]],
          [b[0] - c[0], b[1] - c[1]],
        ];
        const t = cross([c[0] - o[0], c[1] - o[1]], v) / cross(u, v);
        const pole = document
          .querySelector(".pole")
          .getAttribute("d")
          .match(/-?[\d.]+/g)
          .map(Number);
        return { meet: [o[0] + t * u[0], o[1] + t * u[1]], pole: [pole[0] + 6, pole[1]] };
      });
      assertNear(found.pole[0], found.meet[0], 1.5, "the pole's x");
      assertNear(found.pole[1], found.meet[1], 1.5, "the pole's y");
      for (const name of [".centrode.fixed", ".centrode.moving", ".inflection"]) {
        assert.ok((await page.locator(name).getAttribute("d")).length > 30, name);
      }
      await plate.close();
    },
  ],
];
