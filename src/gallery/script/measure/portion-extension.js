// Extends portions by moving their ends between the points of a segment.

import { clampEnds } from "./curve-segment.js";

const GOLDEN_SECTION = 0.6180339887498949;

/**
 * Moves the ends of a portion, by a point at most, to where it is largest and still fits: { size, ends };
 * null if nothing fits. beginning(start) is a function of an end that returns { size, excess } of the portion
 * between them, which fits if the excess is not positive.
 */
export function extendPortion(segment, ends, beginning) {
  // Golden sections of the two points between which it begins: to a tenth of the way between points. How near
  // to its furthest its end is taken, by the way between points, on the way and at last.
  const [ROUNDS, ROUGHLY, FINELY] = [6, 1e-2, 1e-5];
  const fit = beginning(ends[0])(ends[1]);
  const whole = fit.excess <= 0 ? { size: fit.size, ends } : null;
  if (ends[1] - ends[0] < 3) return whole;
  const [low, high] = clampEnds(segment, [ends[0] - 1, ends[1] + 1]);
  const shift = low > ends[0] ? segment.starts : 0;
  const [from, to] = ends.map((place) => place + shift);
  const endOf = (start, near) => {
    const of = beginning(start - shift);
    return furthestFittingEnd(near, [to - 1, high], (end) => of(end - shift));
  };
  let [a, b] = [low, from + 1];
  let [c, d] = [b - GOLDEN_SECTION * (b - a), a + GOLDEN_SECTION * (b - a)];
  let [atC, atD] = [endOf(c, ROUGHLY), endOf(d, ROUGHLY)];
  let best = { size: -Infinity, start: from };
  for (let round = 0; round < ROUNDS; round++) {
    if (atC.size > best.size) best = { size: atC.size, start: c };
    if (atD.size > best.size) best = { size: atD.size, start: d };
    if (atC.size > atD.size) {
      [b, d, atD] = [d, c, atC];
      c = b - GOLDEN_SECTION * (b - a);
      atC = endOf(c, ROUGHLY);
    } else {
      [a, c, atC] = [c, d, atD];
      d = a + GOLDEN_SECTION * (b - a);
      atD = endOf(d, ROUGHLY);
    }
  }
  const { end, size } = endOf(best.start, FINELY);
  const found = size > 0 ? { size, ends: [best.start - shift, end - shift] } : null;
  return found && (!whole || found.size > whole.size) ? found : whole;
}

// The furthest end, of those between two, up to which a portion fits, and its size there, { end, size };
// where none does, the end at which it fits best, with a negative size: by how much it does not fit.
function furthestFittingEnd(near, [from, to], fit) {
  let [low, high] = [from, to];
  let first = fit(low);
  const last = fit(high);
  if (last.excess <= 0) return { end: high, size: last.size };
  if (first.excess > 0) {
    // What is too wide for its length may not be when it is longer.
    for (const part of [0.25, 0.5, 0.75]) {
      const end = from + (to - from) * part;
      const other = fit(end);
      if (other.excess < first.excess) [low, first] = [end, other];
    }
    if (first.excess > 0) return { end: low, size: -first.excess };
  }
  let [below, above, size] = [first.excess, last.excess, first.size];
  // By secants, and halves where those are slow.
  for (let round = 0; round < 20 && high - low >= near; round++) {
    const secant = Math.min(Math.max(below / (below - above), 0.02), 0.98);
    const middle = low + (round % 3 === 2 || !Number.isFinite(above) ? 0.5 : secant) * (high - low);
    const found = fit(middle);
    if (found.excess > 0) [high, above] = [middle, found.excess];
    else [low, below, size] = [middle, found.excess, found.size];
  }
  return { end: low, size };
}
