// What the tests of the plate have in common: where its joints are on the screen, and what it says.

import assert from "node:assert/strict";

export const still = { reducedMotion: "reduce" };

/** The place of a joint on the screen, from the circle a hand takes hold of. */
export const gripAt = (page, joint) =>
  page.locator(`.grip[data-joint="${joint}"]:not(.crank-grip)`).evaluate((grip) => {
    const box = grip.ownerSVGElement.getBoundingClientRect();
    return [box.left + Number(grip.getAttribute("cx")), box.top + Number(grip.getAttribute("cy"))];
  });

/** The input that the plate shows, in degrees or as a length. */
export const inputNow = async (page) =>
  Number((await page.locator(".input-now").textContent()).replace("−", "-").replace("°", ""));

export const fieldOf = (page, name) =>
  page.getByRole("spinbutton", { name: `Value of ${name}`, exact: true });

export const sliderOf = (page, name) =>
  page.locator(`.parameter:has(input[aria-label="Value of ${name}"]) input[type=range]`);

/** Fills a number in, as a hand does, and waits until the plate rests. */
export async function changed(page, name, value) {
  await fieldOf(page, name).fill(String(value));
  await fieldOf(page, name).press("Tab");
  await page.waitForTimeout(300);
}

export async function measureNow(page, name) {
  const row = page.locator("table.measures tr", {
    has: page.locator(".measure-name", { hasText: new RegExp(`^${name}$`) }),
  });
  return (await row.locator("td").allTextContents()).map((text) => text.replace("−", "-").replace("°", ""));
}

export const near = (a, b, within, what) =>
  assert.ok(Math.abs(a - b) <= within, `${what}: ${a}, not ${b} within ${within}`);

/** The angle of a crank on the screen, counter-clockwise from the x-axis, in degrees. */
export async function crankAngle(page, pivot, pin) {
  const [px, py] = await gripAt(page, pin);
  const [ox, oy] = pivot;
  return (Math.atan2(oy - py, px - ox) * 180) / Math.PI;
}

/** The places of fixed pivots on the screen, from left to right. */
export const pivotsOf = (page) =>
  page.locator(".pivot:not(.inner)").evaluateAll((all) =>
    all
      .map((circle) => {
        const box = circle.ownerSVGElement.getBoundingClientRect();
        return [box.left + Number(circle.getAttribute("cx")), box.top + Number(circle.getAttribute("cy"))];
      })
      .sort((a, b) => a[0] - b[0]),
  );
