// Finds the straightest portion of a given span or length, first from the points of a segment, then between
// them.

import { clampEnds, portionPoints } from "./curve-segment.js";
import { triangleHeight, enclosingStrip } from "./strip.js";

/**
 * The ends of the portion with the narrowest strip, of those that begin anywhere on a segment and end at
 * `endAfter(from)`, which is null if there is no such end; endAfter(from, true) is the last point not beyond
 * it.
 */
export function straightestEnds(segment, endAfter) {
  const RIVALS = 3;
  const { starts } = segment;
  const width = (from) => {
    const to = endAfter(from);
    if (to === null) return Infinity;
    const { x, y } = portionPoints(segment, [from, to]);
    return enclosingStrip(x, y, 0, x.length).width;
  };
  const widths = widthsAtPoints(segment, endAfter, width);
  const least = [];
  for (let k = 0; k < starts; k++) {
    const isLeast = widths[k] <= widths[(k + starts - 1) % starts] && widths[k] <= widths[(k + 1) % starts];
    if (Number.isFinite(widths[k]) && isLeast) least.push(k);
  }
  least.sort((a, b) => widths[a] - widths[b]);
  let best = { width: Infinity, from: 0 };
  for (const k of least.slice(0, RIVALS)) {
    const refined = refineStart(segment, k, width);
    if (refined.width < best.width) best = refined;
  }
  return Number.isFinite(best.width) ? [best.from, endAfter(best.from)] : null;
}

// The widths of portions from each point. One of which three points show that it is wider than the narrowest
// so far need not be measured; widely spaced ones are first, for the sooner something narrow is found, the
// more is spared.
function widthsAtPoints(segment, endAfter, width) {
  const STRIDE = 16;
  const { x, y, starts, count } = segment;
  const widths = new Float64Array(starts).fill(Infinity);
  let narrowest = Infinity;
  for (let begin = 0; begin < STRIDE; begin++) {
    for (let from = begin; from < starts; from += STRIDE) {
      // No portion is narrower than a part of it.
      const to = endAfter(from, true);
      if (to === null) continue;
      const last = Math.min(Math.floor(to), count - 1);
      const at = (part) => from + Math.floor(((last - from) * part) / 4);
      const height = (a, b, c) => triangleHeight(x, y, at(a), at(b), at(c));
      widths[from] = Math.max(height(0, 2, 4), height(0, 1, 3), height(1, 3, 4));
      if (widths[from] > 2 * narrowest) continue;
      widths[from] = width(from);
      narrowest = Math.min(narrowest, widths[from]);
    }
  }
  return widths;
}

// By golden sections of the way to the points on either side.
function refineStart(segment, k, width) {
  const [PART, ROUNDS] = [0.6180339887498949, 26];
  let [a, b] = clampEnds(segment, [k - 1, k + 1]);
  const at = a > k ? k + segment.starts : k;
  b = Math.min(b, a + 2);
  let [c, d] = [b - PART * (b - a), a + PART * (b - a)];
  let [atC, atD] = [width(c), width(d)];
  for (let round = 0; round < ROUNDS; round++) {
    if (atC < atD) {
      [b, d, atD] = [d, c, atC];
      c = b - PART * (b - a);
      atC = width(c);
    } else {
      [a, c, atC] = [c, d, atD];
      d = a + PART * (b - a);
      atD = width(d);
    }
  }
  const refined = atC < atD ? { width: atC, from: c } : { width: atD, from: d };
  const whole = width(at);
  return refined.width < whole ? refined : { width: whole, from: at };
}
