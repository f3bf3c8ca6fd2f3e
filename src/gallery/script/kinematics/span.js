// Ends of intervals of the input, and parts of spans; see interval.js for their fields.

import { remainderOf } from "./angles.js";

/** An end of the requested range, at an input { at, cos, sin }. */
export function rangeEnd({ at, cos, sin }, id) {
  return { at, cos, sin, cause: "range", flat: 0, flips: 0, bound: 0, id };
}

/** An end where one dyad lies flat. */
export function endFromFlatDyad({ at, cos, sin }, cause, dyad, id) {
  return { at, cos, sin, cause, flat: 1 << dyad, flips: 1 << dyad, bound: 0, id };
}

/** The same end where another dyad lies flat too; it changes its side together with the others. */
export function endWithFlatDyad(end, dyad, vanishes) {
  const bit = 1 << dyad;
  const bound = vanishes ? end.bound | bit : end.bound;
  return { ...end, flat: end.flat | bit, flips: end.flips | bit, bound };
}

/** The same end shifted by whole turns. */
export function shiftedEnd(end, by) {
  return { ...end, at: end.at + by };
}

// Ends closer than this, in degrees or in parts of a length, are at one input: the rounding of an angle near
// 360.
const COINCIDENT_ENDS = 1e-12;

// Whether two inputs are one but for rounding; of lengths there is no unit to compare them with.
function isOneInput(a, b, input) {
  const unit = input.isLength ? 0 : 1;
  return Math.abs(a - b) <= COINCIDENT_ENDS * Math.max(Math.abs(a), Math.abs(b), unit);
}

// Two ends at one input. Where one of them is a limit the motion turns round, and the dyads that would have
// gone on keep their sides.
function mergedEnds(a, b) {
  const isOther = a.cause === "range" || (b.cause === "limit" && a.cause === "change");
  const { cause, flips } = isOther ? b : a;
  const together = a.cause === b.cause ? a.flips | b.flips : flips;
  return { ...a, cause, flips: together, flat: a.flat | b.flat, bound: a.bound | b.bound };
}

// The end that comes later as the input rises (`way` 1) or falls (-1); both in one where they are at one
// input, with the number of the earlier dyad's.
function laterEnd(earlierDyads, own, way, input) {
  if (isOneInput(earlierDyads.at, own.at, input)) return mergedEnds(earlierDyads, own);
  return (own.at - earlierDyads.at) * way > 0 ? own : earlierDyads;
}

/** The parts of a span that are in one of `allowed`, which may be shifted by up to `turns` turns. */
export function intersectSpans(span, allowed, turns, input) {
  if (!span.lower) return allowed;
  const out = [];
  for (const piece of allowed) {
    if (!piece.lower) {
      out.push(span);
      continue;
    }
    for (let turn = -turns; turn <= turns; turn++) {
      const lower = laterEnd(span.lower, shiftedEnd(piece.lower, 360 * turn), 1, input);
      const upper = laterEnd(span.upper, shiftedEnd(piece.upper, 360 * turn), -1, input);
      if (lower.at < upper.at) out.push({ lower, upper });
    }
  }
  return out.sort((a, b) => a.lower.at - b.lower.at);
}

/** The input that differs from `at` by whole periods and lies in a span; null where none does. */
export function wrapIntoSpan({ lower, upper }, at, period) {
  if (!lower) return remainderOf(at, period);
  const over = remainderOf(at - lower.at, period);
  const length = upper.at - lower.at;
  // At a change point the start pose is that of the interval above.
  const isInside = over < length || (over === length && upper.cause !== "change");
  return isInside ? lower.at + over : null;
}
