// Helpers of the tests of the plate: positions of its joints on the screen, and the values it shows.

import assert from "node:assert/strict";

export const REDUCED_MOTION = { reducedMotion: "reduce" };

/** The position of a joint on the screen, from the handle it is dragged by. */
export const gripAt = (page, joint) =>
  page.locator(`.grip[data-joint="${joint}"]:not(.crank-grip)`).evaluate((grip) => {
    const box = grip.ownerSVGElement.getBoundingClientRect();
    return [box.left + Number(grip.getAttribute("cx")), box.top + Number(grip.getAttribute("cy"))];
  });

/** The input that the plate shows, in degrees or as a length. */
export const inputNow = async (page) =>
  Number((await page.locator(".input-now").inputValue()).replace("−", "-").replace("°", ""));

export const fieldOf = (page, name) =>
  page.getByRole("spinbutton", { name: `Value of ${name}`, exact: true });

export const sliderOf = (page, name) =>
  page.locator(`.parameter:has(input[aria-label="Value of ${name}"]) input[type=range]`);

/** Waits until the plate shows the last change. */
export const plateIsUpdated = (page) =>
  page.waitForFunction(() => !document.querySelector(".stage").hasAttribute("aria-busy"));

/** Enters the value of a parameter and waits until the plate is updated. */
export async function changeParameter(page, name, value) {
  await fieldOf(page, name).fill(String(value));
  await fieldOf(page, name).press("Tab");
  await plateIsUpdated(page);
}

export async function measureNow(page, name) {
  const row = page.locator("table.measures tr", {
    has: page.locator(".measure-name", { hasText: new RegExp(`^${name}$`) }),
  });
  return (await row.locator("td").allTextContents()).map((text) => text.replace("−", "-").replace("°", ""));
}

export const assertNear = (a, b, within, what) =>
  assert.ok(Math.abs(a - b) <= within, `${what}: ${a}, not ${b} within ${within}`);

/** The angle of a crank on the screen, counter-clockwise from the x-axis, in degrees. */
export async function crankAngle(page, pivot, pin) {
  const [px, py] = await gripAt(page, pin);
  const [ox, oy] = pivot;
  return (Math.atan2(oy - py, px - ox) * 180) / Math.PI;
}

/** The positions of fixed pivots on the screen, from left to right. */
export const pivotsOf = (page) =>
  page.locator(".pivot:not(.inner)").evaluateAll((all) =>
    all
      .map((circle) => {
        const box = circle.ownerSVGElement.getBoundingClientRect();
        return [box.left + Number(circle.getAttribute("cx")), box.top + Number(circle.getAttribute("cy"))];
      })
      .sort((a, b) => a[0] - b[0]),
  );
