// Draws a curve in dashes that show its speed: each dash covers the same amount of input, so that dashes are
// long where the point is fast. Dash k starts at the input k times the period, or ends there if the input
// falls.

import { dataNumber } from "./path-data.js";

/** The dash pattern of a period: the first three fifths are drawn, such as 3 of every 5 degrees of input. */
export function dashPattern(period) {
  return { period, drawn: 0.6 * period };
}

/**
 * Path data of the dashes of a path { points: [x, y, …], inputs, starts } (kinematics/path.js), separate for
 * each pass: `starts` has the first point of each. `dashes` is { period, drawn } in the unit of the inputs.
 */
export function dashData({ points, inputs, starts }, dashes, digits = 7) {
  const data = [];
  starts.forEach((first, k) => {
    const last = starts[k + 1] ?? inputs.length - 1;
    dashesOfPass(points, inputs, first, last, dashes, digits, data);
  });
  return data.join("");
}

function dashesOfPass(points, inputs, first, last, { period, drawn }, digits, data) {
  const number = (x) => dataNumber(x, digits);
  const isDrawn = (at) => at - Math.floor(at / period) * period < drawn;
  // The next end of a dash after an input, in the direction of the pass.
  const heading = inputs[last] >= inputs[first] ? 1 : -1;
  const border = (at) => {
    const k = Math.floor(at / period);
    const rest = at - k * period;
    const slack = 1e-9 * period;
    if (heading > 0)
      return rest < drawn - slack
        ? k * period + drawn
        : rest < period - slack
          ? (k + 1) * period
          : (k + 1) * period + drawn;
    return rest > drawn + slack ? k * period + drawn : rest > slack ? k * period : (k - 1) * period + drawn;
  };
  let isDown = false;
  const to = (x, y) => {
    data.push(isDown ? "L" : "M", number(x), " ", number(y));
    isDown = true;
  };
  for (let i = first; i < last; i++) {
    const [a, b] = [inputs[i], inputs[i + 1]];
    const [x0, y0, x1, y1] = [points[2 * i], points[2 * i + 1], points[2 * i + 2], points[2 * i + 3]];
    if (!Number.isFinite(x0 + y0 + x1 + y1) || a === b) {
      isDown = false;
      continue;
    }
    let at = a;
    for (;;) {
      const next = border(at);
      const end = heading * (next - b) < 0 ? next : b;
      if (isDrawn((at + end) / 2)) {
        const [s, t] = [(at - a) / (b - a), (end - a) / (b - a)];
        if (!isDown) to(x0 + (x1 - x0) * s, y0 + (y1 - y0) * s);
        to(x0 + (x1 - x0) * t, y0 + (y1 - y0) * t);
        if (end === next) isDown = false;
      } else isDown = false;
      if (end === b) break;
      at = end;
    }
  }
}
