// Finds the intervals of the input on which a linkage can be assembled, for each assembly mode.
//
// The dyads are processed in the order they are placed. Each reduces the intervals left by those before it to
// where its base is within its limits; both of its sides share the result. So an end of an interval belongs
// to one dyad, and has one number by which the intervals that meet there are recognised.
//
// An end is { at, cos, sin, cause, flat, flips, bound, id }: the input; its cause, "limit" where a dyad is
// extended or folded and the motion cannot continue, "change" where it can, or "range" where the requested
// range ends; the dyads that lie flat; those of them that change sides when the motion continues smoothly;
// those that must, because their bases vanish. A span is { lower, upper }, two ends at most a period apart,
// or both null: the whole period.

import { inputPosition } from "./positions.js";
import { closingSpans } from "./dyad-limits.js";
import { allModes, firstDyad, lastDyad, truncatedMode } from "./assembly-mode.js";
import { rangeEnd } from "./span.js";

/** The end of an interval that a rising or falling input reaches; null on a full turn. */
export function intervalEnd({ span }, rising) {
  return rising ? span.upper : span.lower;
}

/**
 * The assembly mode in which the motion continues after an end reached with a rising or falling input, and
 * whether the input then rises; null where the motion ends.
 */
export function nextMode(end, signs, rising, { coincident, continuation }) {
  if (end.cause === "range") return null;
  if (end.cause === "change" && continuation === "branch") return { signs: signs ^ end.bound, rises: rising };
  let flips = end.flips;
  if (coincident === "first") flips = firstDyad(flips) | end.bound;
  if (coincident === "last") flips = lastDyad(flips) | end.bound;
  return { signs: signs ^ flips, rises: end.cause === "limit" ? !rising : rising };
}

/**
 * The intervals within the requested range, { intervals: [{ span, signs }], shortfall }: of all assembly
 * modes, or, if only the circuit through the start pose is requested, of those that can be reached from it.
 * The shortfall is the reason why the requested mode has none, if one of its dyads closes nowhere.
 */
export function findIntervals(linkage) {
  const { travel, dyads } = linkage;
  const tree = { linkage, left: new Map(), nextId: 2, shortfall: null };
  const modes = travel.circuits === "all" ? allModes(dyads) : [travel.signs];
  const intervals = [];
  for (let done = 0; done < modes.length; done++) {
    const signs = modes[done];
    for (const span of spansOfMode(tree, dyads, signs)) {
      const interval = { span, signs };
      for (const rising of [true, false]) {
        const end = intervalEnd(interval, rising);
        const onward = end && nextMode(end, signs, rising, travel);
        if (onward && !modes.includes(onward.signs)) modes.push(onward.signs);
      }
      intervals.push(interval);
    }
  }
  return { intervals, shortfall: tree.shortfall };
}

// The whole range of the input that is requested.
function requestedSpan({ input, travel: { range } }) {
  const endAt = (at, id) => rangeEnd(inputPosition(input, at), id);
  if (range && range[1] - range[0] < input.period)
    return { lower: endAt(range[0], 0), upper: endAt(range[1], 1) };
  if (input.isLength) return { lower: endAt(0, 0), upper: endAt(Number.MAX_VALUE / 16, 1) };
  return { lower: null, upper: null };
}

// The spans on which the first `dyads` dyads close, with the sides of all but the last of them given. Modes
// that share these share the spans, and the numbers of their ends.
function spansOfMode(tree, dyads, signs) {
  const { linkage } = tree;
  if (dyads === 0) return [requestedSpan(linkage)];
  const before = truncatedMode(signs, dyads - 1);
  const key = `${dyads}.${before}`;
  if (tree.left.has(key)) return tree.left.get(key);
  const spans = [];
  for (const span of spansOfMode(tree, dyads - 1, signs)) {
    const { parts, reason } = closingSpans(linkage, dyads - 1, span, before, () => ++tree.nextId);
    spans.push(...parts);
    if (reason && before === truncatedMode(linkage.travel.signs, dyads - 1)) tree.shortfall ??= reason;
  }
  tree.left.set(key, spans);
  return spans;
}
