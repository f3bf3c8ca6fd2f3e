// Searches the limits of dyads that do not connect crank and frame.
//
// The program uses certified enclosures of the extent and its rate, so that it misses no limit, however
// narrow the gap. This is a dense scan with 720 pieces to a turn, refined where the extent has an extremum
// near a bound, with bisection to the last bit: it can miss a gap or a window narrower than a few
// ten-thousandths of a turn.

import { placeAsSeries } from "./joint-series.js";
import { inputColumns, newPositions, placeJoints, inputPosition } from "./positions.js";
import { placeAtEnd } from "./pass-ends.js";
import { passOfInterval } from "./pass.js";
import {
  differenceOfSeries,
  constantSeries,
  planarCross,
  planarDifference,
  planarDot,
  planarUnit,
} from "./series.js";
import { dyadSigns, sideOf } from "./assembly-mode.js";
import { endWithFlatDyad, endFromFlatDyad, shiftedEnd, wrapIntoSpan } from "./span.js";

/** The approximate least and greatest extent of a dyad over a span. */
export function extentRange(linkage, dyad, span, signs) {
  const finite = sampleExtents(newSearch(linkage, dyad, span, signs)).filter(
    (extent) => !Number.isNaN(extent),
  );
  return [Math.min(...finite), Math.max(...finite)];
}

/** The parts of a span where a dyad closes, as in dyad-limits.js. */
export function searchClosingSpans(linkage, dyad, span, signs, nextId) {
  const search = newSearch(linkage, dyad, span, signs);
  const survey = sampleExtents(search);
  search.tolerance = toleranceOf(dyad, survey);
  // Two joints that are one point throughout leave their dyad free to turn: it has no place.
  if (dyad.vanishes && survey.every((extent) => extent <= search.tolerance)) return [];
  const { inputs, extents, touched } = bracketLimits(search);
  // Where an earlier joint has no place, at an end, this dyad is as it is next to that.
  const known = extents.map((extent, i) => (Number.isNaN(extent) ? extents[i === 0 ? 1 : i - 1] : extent));
  const open = known.map((extent) => extentMargin(dyad, extent) >= -search.tolerance);
  const limit = (inside, outside) =>
    endFromFlatDyad(
      inputPosition(linkage.input, bisectLimit(search, inside, outside)),
      "limit",
      dyad.index,
      nextId(),
    );
  const arcs = [];
  let lower = open[0] ? [null] : null;
  for (let i = 1; i < inputs.length; i++) {
    if (!open[i - 1] && open[i]) lower = [limit(inputs[i], inputs[i - 1])];
    if (open[i - 1] && !open[i]) {
      arcs.push([lower[0], limit(inputs[i - 1], inputs[i])]);
      lower = null;
    }
  }
  if (lower) arcs.push([lower[0], null]);
  let spans = joinArcs(search, arcs);
  for (const at of touched) {
    const end = endFromFlatDyad(inputPosition(linkage.input, at), "change", dyad.index, nextId());
    const vanishes = dyad.vanishes && extentsAt(search, [at])[0] <= search.tolerance;
    spans = splitSpans(spans, endWithFlatDyad(end, dyad.index, vanishes), linkage.input);
  }
  return spans;
}

function newSearch(linkage, dyad, span, signs) {
  const ends = span.lower ? [span.lower.at, span.upper.at] : [0, linkage.input.period];
  const pass = passOfInterval({ span, signs }, true, linkage.input.period);
  return { linkage, dyad, span, signs, ends, pass, tolerance: 0 };
}

// The extent at each input; at the ends of the span with the dyad flat that ends it.
function extentsAt({ linkage, dyad, span, signs, pass }, ats) {
  const inputs = inputColumns(ats.map((at) => inputPosition(linkage.input, at)));
  const columns = newPositions(linkage.joints.length, ats.length);
  placeJoints(linkage, [0, dyad.joint], inputs, dyadSigns(signs, 0, linkage.dyads), columns, 0, ats.length);
  ats.forEach((at, i) => {
    // Where the base of an earlier dyad vanishes, this one depends on joints placed by continuity.
    if (span.lower && pass.from === at) placeAtEnd(linkage, pass, true, inputs, columns, i);
    if (span.lower && pass.to === at) placeAtEnd(linkage, pass, false, inputs, columns, i);
  });
  return ats.map((_, i) => extentOfColumns(dyad.step, columns, i));
}

function extentOfColumns({ kind, base, from, line, offset }, { x, y }, i) {
  const [p, q] = kind === "slide" ? line : base;
  const [dx, dy] = [x[q][i] - x[p][i], y[q][i] - y[p][i]];
  const d = Math.sqrt(dx * dx + dy * dy);
  if (kind !== "slide") return d;
  return offset - ((dx / d) * (y[from][i] - y[p][i]) - (dy / d) * (x[from][i] - x[p][i]));
}

// The margin of an extent within its bounds: its distance from the nearer one; negative where the dyad does
// not close.
function extentMargin({ bounds: [low, high] }, extent) {
  const margin = Math.min(high - extent, extent - low);
  return Number.isNaN(margin) ? -1 : margin;
}

function marginAt(search, at) {
  return extentMargin(search.dyad, extentsAt(search, [at])[0]);
}

function sampleExtents(search) {
  const INPUTS = 128;
  const [from, to] = search.ends;
  const at = (_, i) => (i === INPUTS ? to : from + ((to - from) * i) / INPUTS);
  return extentsAt(search, Array.from({ length: INPUTS + 1 }, at));
}

// Extents that differ by no more than their rounding: what is within this of a bound touches it.
function toleranceOf({ bounds: [low, high] }, extents) {
  const greatest = extents
    .filter(Number.isFinite)
    .reduce((most, extent) => Math.max(most, Math.abs(extent)), 0);
  return 64 * Number.EPSILON * (Math.abs(low) + (Number.isFinite(high) ? Math.abs(high) : 0) + greatest);
}

// Inputs between neighbours of which there is one limit at most, with the extents there; and inputs at which
// a bound is touched and not passed.
function bracketLimits(search) {
  const inputs = scanInputs(search);
  const extents = extentsAt(search, inputs);
  const margins = extents.map((extent) => extentMargin(search.dyad, extent));
  const [turning, touched] = [[], []];
  const last = inputs.length - 1;
  for (let i = 0; i <= last; i++) {
    const isSeam = i === 0 || i === last;
    if (isSeam && search.span.lower) continue;
    // On a whole turn the first input is the last: the extent may turn on either side of it.
    const [before, after] = i === 0 ? [last - 1, 1] : i === last ? [last - 1, 1] : [i - 1, i + 1];
    if (!mayCross(margins[before], margins[i], margins[after], search.tolerance)) continue;
    const bracket = [i === 0 ? 0 : inputs[i - 1], i === last ? inputs[last] : inputs[i + 1]];
    const found = inspectBracket(search, bracket, margins[i] >= -search.tolerance, isSeam);
    if (found?.turning !== undefined) turning.push(found.turning);
    if (found?.touch !== undefined) touched.push(found.touch);
  }
  if (turning.length === 0) return { inputs, extents, touched };
  const all = [
    ...inputs.map((at, i) => [at, extents[i]]),
    ...turning.map((at) => [at, extentsAt(search, [at])[0]]),
  ];
  all.sort((a, b) => a[0] - b[0]);
  return { inputs: all.map(([at]) => at), extents: all.map(([, extent]) => extent), touched };
}

// Even over a turn; over a part of one denser towards its ends, where places go with the root of the input.
function scanInputs({ linkage, span, ends: [from, to] }) {
  const PIECES = 720;
  const turns = linkage.input.isLength ? 1 : Math.max(1, (to - from) / 360);
  const count = Math.ceil(PIECES * Math.min(turns, 20));
  const eased = (part) => (span.lower ? (1 - Math.cos(Math.PI * part)) / 2 : part);
  return Array.from({ length: count + 1 }, (_, k) =>
    k === count ? to : from + (to - from) * eased(k / count),
  );
}

// Whether the margin may change its sign next to the middle one of three inputs, where it is least among them
// if the dyad closes there, or greatest if it does not.
function mayCross(before, here, after, tolerance) {
  const isOpen = here >= -tolerance;
  if (before >= -tolerance !== isOpen || after >= -tolerance !== isOpen) return false;
  const sign = isOpen ? 1 : -1;
  if (sign * here > sign * before || sign * here > sign * after) return false;
  const change = Math.max(Math.abs(before - here), Math.abs(after - here));
  return Math.abs(here) <= change + 2 * tolerance;
}

// What a bracket hides: a dip or a rise that passes a bound, or one that touches it.
function inspectBracket(search, [from, to], isOpen, isSeam) {
  const sign = isOpen ? 1 : -1;
  // Near where a bound is touched the margin varies by less than its rounding: its rate gives the input.
  const level = stationaryInput(search, from, to);
  if (level === null && isSeam) return null;
  const at = level ?? goldenSectionMinimum(from, to, (input) => sign * marginAt(search, input));
  const margin = marginAt(search, at);
  if (isOpen ? margin < -search.tolerance : margin >= -search.tolerance) return { turning: at };
  // On both sides of a touch the margin grows; where it does not, the extent stays at the bound.
  const [start, end] = search.ends;
  const aside = 1e-5 * (end - start);
  const grows = (input) => start <= input && input <= end && marginAt(search, input) > 100 * search.tolerance;
  const isTouch =
    isOpen && level !== null && margin <= search.tolerance && grows(at - aside) && grows(at + aside);
  return isTouch ? { touch: at } : null;
}

// Where the extent is least or greatest between two inputs, by bisection of its rate; null where that keeps
// its sign.
function stationaryInput(search, from, to) {
  const rises = rateOfExtent(search, to) > 0;
  if (rateOfExtent(search, from) > 0 === rises) return null;
  let [a, b] = [from, to];
  for (;;) {
    const middle = a + (b - a) / 2;
    if (middle === a || middle === b) return middle;
    if (rateOfExtent(search, middle) > 0 === rises) b = middle;
    else a = middle;
  }
}

function rateOfExtent({ linkage, dyad, signs }, at) {
  const { kind, base, from, line, offset } = dyad.step;
  const places = placeAsSeries(
    linkage,
    dyad.joint,
    inputPosition(linkage.input, at),
    (k) => sideOf(signs, k),
    2,
  );
  const [p, q] = (kind === "slide" ? line : base).map((joint) => places[joint]);
  const d = planarDifference(q, p);
  if (kind !== "slide") return planarDot(d, d)[1];
  const pin = planarCross(planarUnit(d), planarDifference(places[from], p));
  return differenceOfSeries(constantSeries(offset, 2), pin)[1];
}

// The last input, going from `inside` towards `outside`, at which the dyad still closes.
function bisectLimit(search, inside, outside) {
  const floor = Math.min(marginAt(search, inside), 0);
  let [a, b] = [inside, outside];
  for (;;) {
    const middle = a + (b - a) / 2;
    if (middle === a || middle === b) return a;
    if (marginAt(search, middle) >= floor) a = middle;
    else b = middle;
  }
}

// Gives the arcs that reach the ends of the span those ends; on a whole turn, joins them over input 0.
function joinArcs(search, arcs) {
  const { span, linkage } = search;
  if (span.lower) {
    return arcs
      .map(([from, to]) => ({
        lower: from ?? endOfSpan(search, span.lower),
        upper: to ?? endOfSpan(search, span.upper),
      }))
      .filter(({ lower, upper }) => lower.at < upper.at);
  }
  if (arcs.length > 1 && arcs[0][0] === null && arcs[arcs.length - 1][1] === null) {
    const [, upper] = arcs.shift();
    arcs[arcs.length - 1][1] = shiftedEnd(upper, linkage.input.period);
  }
  return arcs.map(([lower, upper]) => (lower && upper ? { lower, upper } : { lower: null, upper: null }));
}

// The end of the span, where this dyad lies flat too if its margin is zero.
function endOfSpan(search, end) {
  const [extent] = extentsAt(search, [end.at]);
  if (end.cause === "range" || Math.abs(extentMargin(search.dyad, extent)) > search.tolerance) return end;
  return endWithFlatDyad(end, search.dyad.index, search.dyad.vanishes && extent <= search.tolerance);
}

// The spans, of which the one that contains an end is split there.
function splitSpans(spans, end, { period }) {
  return spans.flatMap((span) => {
    if (!span.lower) return [{ lower: end, upper: shiftedEnd(end, period) }];
    const at = wrapIntoSpan(span, end.at, period);
    if (at === null || !(span.lower.at < at && at < span.upper.at)) return [span];
    const here = shiftedEnd(end, at - end.at);
    return [
      { lower: span.lower, upper: here },
      { lower: here, upper: span.upper },
    ];
  });
}

/** Where `f` is least between two places, by golden section. */
function goldenSectionMinimum(from, to, f) {
  const RATIO = (Math.sqrt(5) - 1) / 2;
  let [a, b] = [from, to];
  let [x, y] = [b - RATIO * (b - a), a + RATIO * (b - a)];
  let [fx, fy] = [f(x), f(y)];
  // 0.618^60 of a whole turn is below the rounding of an angle.
  for (let round = 0; round < 60; round++) {
    if (fx < fy) {
      [b, y, fy] = [y, x, fx];
      x = b - RATIO * (b - a);
      fx = f(x);
    } else {
      [a, x, fx] = [x, y, fy];
      y = a + RATIO * (b - a);
      fy = f(y);
    }
  }
  return fx < fy ? x : y;
}
