// Joins intervals into circuits: finds which interval follows which, where each circuit starts, and the order
// of the circuits.

import { cosSinOfDegrees, remainderOf } from "./angles.js";
import { intervalEnd, findIntervals, nextMode } from "./interval.js";
import { inputDirection, passBetween, passOfInterval, passRange, reversedPass, shiftedPass } from "./pass.js";
import { compareModes, sideOf } from "./assembly-mode.js";
import { wrapIntoSpan } from "./span.js";

/**
 * The circuits selected by a linkage's motion options, in order: { routes: [{ passes, closed }], shortfall }.
 */
export function findCircuits(linkage) {
  const { intervals, shortfall: reason } = findIntervals(linkage);
  const { travel } = linkage;
  let selected = intervals.map((_, k) => k);
  let shortfall = intervals.length === 0 ? reason : null;
  if (travel.circuits !== "all") {
    const found = startInterval(linkage, intervals);
    selected = found.interval === undefined ? [] : [found.interval];
    if (found.reason) shortfall = reason ?? found.reason;
  }
  const seen = new Set();
  const routes = [];
  for (const interval of selected) {
    if (!seen.has(interval)) routes.push(traceCircuit(linkage, intervals, interval, seen));
  }
  if (travel.range && shortfall === null) {
    shortfall =
      routes.map((route) => incompleteReason(route, linkage)).find((short) => short !== null) ?? null;
  }
  const isRight = ({ passes }) => (sideOf(passes[0].signs, 0) < 0 ? 1 : 0);
  routes.sort((a, b) => isRight(a) - isRight(b) || a.passes[0].from - b.passes[0].from);
  return { routes, shortfall };
}

// What a route lacks of the requested range.
function incompleteReason({ passes }, { input, travel: { range } }) {
  const [from, to] = range;
  const [low, high] = inputRangeOfPasses(passes);
  if ((low <= from && high >= to) || high - low >= input.period) return null;
  const unit = input.isLength ? "" : " deg";
  const short = (at) => Math.round(at * 1e4) / 1e4 + 0;
  const reached = `the input goes from ${short(low)} to ${short(high)}${unit} only`;
  return `${reached}, of the requested ${from} to ${to}${unit}`;
}

function inputRangeOfPasses(passes) {
  const ends = passes.flatMap((pass) => [pass.from, pass.to]);
  return [Math.min(...ends), Math.max(...ends)];
}

// The interval of the start pose, { interval } or { reason }.
function startInterval(linkage, intervals) {
  const { travel, input } = linkage;
  const { period } = input;
  const ours = intervals.map((_, k) => k).filter((k) => intervals[k].signs === travel.signs);
  const at = travel.start ?? middleOfFirstRange(intervals, ours, period);
  if (at === null) return { reason: "no input allows the sides requested at the start" };
  if (travel.start !== null && travel.range) {
    const [from, to] = travel.range;
    if (remainderOf(at - from, period) > to - from) {
      return { reason: `its start, an input of ${at}, is not in the requested range from ${from} to ${to}` };
    }
  }
  const interval = ours.find((k) => wrapIntoSpan(intervals[k].span, at, period) !== null);
  return interval === undefined
    ? { reason: `it cannot be assembled at the start, an input of ${at}` }
    : { interval };
}

// The middle of the first assemblable range met from 0 upward; change points do not part a range.
function middleOfFirstRange(intervals, ours, period) {
  if (ours.some((k) => !intervals[k].span.lower)) return period / 2;
  const ranges = ours.map((k) => [intervals[k].span.lower.at, intervals[k].span.upper.at]);
  for (let pair = joinedPair(ranges, period); pair; pair = joinedPair(ranges, period)) {
    const [i, j] = pair;
    ranges[i][1] += ranges[j][1] - ranges[j][0];
    ranges.splice(j, 1);
  }
  const met = ([from, to]) => {
    const lower = remainderOf(from, period);
    return lower + (to - from) >= period || lower === 0 ? 0 : lower;
  };
  const first = ranges.reduce((best, range) => (best && met(best) <= met(range) ? best : range), null);
  return first && (first[0] + first[1]) / 2;
}

function joinedPair(ranges, period) {
  for (let i = 0; i < ranges.length; i++) {
    for (let j = 0; j < ranges.length; j++) {
      if (i !== j && Math.abs((ranges[j][0] - ranges[i][1]) % period) < 1e-9) return [i, j];
    }
  }
  return null;
}

// The circuit through an interval: on to what follows its upper end, and, where that ends, back from its
// lower.
function traceCircuit(linkage, intervals, first, seen) {
  seen.add(first);
  const { input, travel } = linkage;
  const begun = passOfInterval(intervals[first], true, input.period);
  if (!intervals[first].span.lower) return { passes: [begun], closed: true };
  let passes = [begun];
  const closed = appendFollowing(linkage, intervals, { interval: first, rising: true }, passes, seen);
  if (!closed) {
    const before = [passOfInterval(intervals[first], false, input.period)];
    appendFollowing(linkage, intervals, { interval: first, rising: false }, before, seen);
    passes = [...before.slice(1).reverse().map(reversedPass), ...passes];
  }
  return { passes: normalizePasses(passes, closed, travel.range !== null, input.period), closed };
}

// Appends the passes that follow; whether they come back to where they began.
function appendFollowing(linkage, intervals, begun, passes, seen) {
  let at = begun;
  for (;;) {
    const next = nextInterval(linkage, intervals, at);
    if (!next) return false;
    if (next.interval === begun.interval && next.rising === begun.rising) return true;
    // Only where several dyads lie flat at once does a third interval meet two that are already joined.
    if (seen.has(next.interval)) return false;
    seen.add(next.interval);
    passes.push(passOfInterval(intervals[next.interval], next.rising, linkage.input.period));
    at = next;
  }
}

// The interval that follows, and whether the input rises on it.
function nextInterval({ travel }, intervals, { interval, rising }) {
  const from = intervals[interval];
  const end = intervalEnd(from, rising);
  const onward = end && nextMode(end, from.signs, rising, travel);
  if (!onward) return null;
  // It begins where this one ends: falling from the same upper end, or rising from the same lower one.
  const begins = (other) => other.signs === onward.signs && intervalEnd(other, !onward.rises)?.id === end.id;
  const next = intervals.findIndex(begins);
  return next < 0 ? null : { interval: next, rising: onward.rises };
}

// The passes with a continuous input, started where a circuit starts.
function normalizePasses(passes, closed, isRequestedRange, period) {
  const turns = passes.some((pass) => inputDirection(pass) !== inputDirection(passes[0]));
  let best = null;
  for (const way of [passes, [...passes].reverse().map(reversedPass)]) {
    const direction = closed && !turns ? cutAtZero(way, period) : way;
    for (let start = 0; start < (closed ? direction.length : 1); start++) {
      const rotated = [...direction.slice(start), ...direction.slice(0, start)];
      const candidate = makeContinuous(joinPasses(rotated), turns, isRequestedRange, period);
      const fallsFirst =
        inputDirection(candidate[0]) < 0 && candidate.some((pass) => inputDirection(pass) > 0);
      if (closed && fallsFirst) continue;
      if (!best || precedesRoute(candidate, best)) best = candidate;
    }
  }
  return best ?? [];
}

// Whether a circuit that starts as `a` does is to be preferred: rising, from a lower input, on branch 1.
function precedesRoute([a], [b]) {
  const falls = (pass) => (inputDirection(pass) < 0 ? 1 : 0);
  return (falls(a) - falls(b) || a.from - b.from || compareModes(a.signs, b.signs)) < 0;
}

// A motion that never turns round starts at input 0: a pass over it is cut in two there.
function cutAtZero(passes, period) {
  return passes.flatMap((pass) => {
    const [low, high] = passRange(pass);
    const zero = Math.ceil(high / period) * period - period;
    if (!(zero > low)) return [pass];
    const [cos, sin] = cosSinOfDegrees(zero);
    const cut = { at: zero, cos, sin, flat: 0 };
    return [passBetween(pass.begin, cut, pass.signs), passBetween(cut, pass.end, pass.signs)];
  });
}

// The passes with those made one that were cut and a circuit does not start at.
function joinPasses(passes) {
  const out = [];
  for (const pass of passes) {
    const last = out[out.length - 1];
    const isCut = last && last.end.flat === 0 && last.signs === pass.signs && last.to === pass.from;
    if (isCut && pass.begin.flat === 0) out[out.length - 1] = passBetween(last.begin, pass.end, pass.signs);
    else out.push(pass);
  }
  return out;
}

// Shifts passes by whole turns so that each begins where the one before ends, and the whole lies where it
// should: the middle of a rocking circuit in (-180, 180], the start of a turning one in the first period, a
// requested range as given.
function makeContinuous(passes, turns, isRequestedRange, period) {
  const out = [passes[0]];
  for (const pass of passes.slice(1)) {
    const gap = out[out.length - 1].to - pass.from;
    out.push(shiftedPass(pass, Math.round(gap / period) * period));
  }
  const [low, high] = inputRangeOfPasses(out);
  let whole = 0;
  if (!isRequestedRange && (turns || high - low < period))
    whole = Math.floor(0.5 - (low + high) / (2 * period));
  else if (!isRequestedRange) whole = -Math.floor(out[0].from / period);
  return out.map((pass) => shiftedPass(pass, whole * period));
}
