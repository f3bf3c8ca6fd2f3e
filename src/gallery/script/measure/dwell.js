// Finds the best circular arc of a curve: a link from the coupler point to the arc's centre would have a
// dwell.
//
// A portion is such an arc if it lies in an annulus no wider than 0.001 of the curve's greatest extent, with
// a radius no larger than the length of the curve. The best is the one that spans the most input. Every part
// of a portion that fits an annulus fits it too, so that it is found by moving both ends along the curve
// once, and then between its points.

import { enclosingAnnulus, narrowestAnnulusWithin } from "./annulus.js";
import { clampEnds, lastEnd, pointAt, portionPoints, inputSpan } from "./curve-segment.js";
import { extendPortion } from "./portion-extension.js";
import { hullDiameter, convexHull } from "./hull.js";

/**
 * The best circular portion of a segment: { x, y, radius, deviation, start, input }, the centre and the
 * radius of its circle, the greatest distance of its points from that, the input at which it begins and the
 * input it spans, forth and back over limits; null for a point or a straight line.
 */
export function circularPortion(segment) {
  const TOLERANCE = 0.001;
  const corners = convexHull(segment.x, segment.y, 0, Math.min(segment.starts + 1, segment.count));
  const search = {
    segment,
    width: TOLERANCE * hullDiameter(corners),
    maxRadius: segment.way[segment.starts],
    fitting: [],
  };
  const ends = longestArc(search);
  if (!ends) return null;
  const { x, y } = portionPoints(segment, ends);
  // On a long arc the exchange of points may end at an annulus that is not the narrowest: then the portion
  // has a better one, by which it was found to fit.
  const anew = narrowestAnnulusWithin(x, y, 0, x.length, {}, Infinity, search.maxRadius);
  const known = search.fitting.findLast((other) => other.ends[0] === ends[0] && other.ends[1] === ends[1]);
  const before = known ? enclosingAnnulus(x, y, 0, x.length, known.annulus.x, known.annulus.y) : null;
  const annulus = anew && before ? (before.width < anew.width ? before : anew) : (anew ?? before);
  if (!annulus) return null;
  const start = pointAt(segment, ends[0])[2];
  return {
    x: annulus.x,
    y: annulus.y,
    radius: annulus.radius,
    deviation: annulus.width / 2,
    start,
    input: inputSpan(segment, ends),
  };
}

function longestArc(search) {
  const MOVES = 4;
  const { segment } = search;
  const found = longestArcBetweenPoints(search);
  if (!found) return null;
  const [from, to] = found;
  // All of a closed curve is a portion that ends where it begins.
  if (segment.isClosed && to === lastEnd(segment, from)) return [0, segment.starts];
  const longer = narrowestLonger(search, segment.travel[to] - segment.travel[from]);
  const isApart = !longer || Math.abs(longer[0] - from) > 1;
  const drawn = longer && extendArc(search, longer);
  const other = isApart || !drawn ? extendArc(search, found) : null;
  let best = { size: 0, ends: found };
  for (const portion of [drawn, other]) if (portion && portion.size >= best.size) best = portion;
  for (let move = 0; move < MOVES; move++) {
    // Extended from its new ends it may go further in the same way.
    const further = extendArc(search, best.ends);
    if (!further || further.size <= best.size * (1 + 1e-6)) break;
    best = further;
  }
  return best.ends;
}

// How much input a portion spans, and its ends, extended between points.
function extendArc({ segment, width, maxRadius, fitting }, ends) {
  const [from, to] = clampEnds(segment, ends);
  const core = portionPoints(segment, [from + 1, to - 1]);
  // What is passed on the way out is in the portion too.
  const passed = (end, inner) => [0, 0.5].map((part) => pointAt(segment, end + part * (inner - end)));
  const beginning = (start) => {
    const before = passed(start, from + 1);
    const x = [...before.map((p) => p[0]), ...core.x];
    const y = [...before.map((p) => p[1]), ...core.y];
    const kept = x.length;
    const turns = {};
    const size = inputSpan(segment, [start, from + 1]);
    return (end) => {
      passed(end, to - 1).forEach((p, k) => {
        [x[kept + 1 - k], y[kept + 1 - k]] = p;
      });
      const annulus = narrowestAnnulusWithin(x, y, 0, kept + 2, turns, Infinity, maxRadius);
      const excess = annulus ? annulus.width - width : Infinity;
      if (excess <= 0) fitting.push({ ends: [start, end], annulus });
      return { size: size + inputSpan(segment, [from + 1, end]), excess };
    };
  };
  return extendPortion(segment, [from, to], beginning);
}

// The points at the ends of the portion that spans the most input.
function longestArcBetweenPoints({ segment, width, maxRadius }) {
  let [best, found] = [0, null];
  for (let from = 0; from < segment.starts; from++) {
    const beyond = firstEndBeyond(segment, from, best);
    if (beyond < 0) continue;
    const to = lastHolding([beyond, lastEnd(segment, from)], (end) =>
      fitsAnnulus(segment, [from, end], width, maxRadius),
    );
    if (to >= 0) [best, found] = [segment.travel[to] - segment.travel[from], [from, to]];
  }
  return found;
}

function fitsAnnulus({ x, y }, [from, to], most, maxRadius) {
  return narrowestAnnulusWithin(x, y, from, to + 1, {}, most, maxRadius);
}

// The ends, between points, of a portion that spans a little more than `span` and lies in the narrowest
// annulus of those: as every portion from point to point that fits spans no more, this one comes nearest to
// it.
function narrowestLonger({ segment, maxRadius }, span) {
  let [narrowest, found] = [Infinity, null];
  for (let from = 0; from < segment.starts; from++) {
    const to = firstEndBeyond(segment, from, span);
    const annulus = to < 0 ? null : fitsAnnulus(segment, [from, to], narrowest, maxRadius);
    if (annulus) [narrowest, found] = [annulus.width, [from + 0.5, to - 0.5]];
  }
  return found;
}

// The first point that portions from another may end at which span more than some input; -1 where there is
// none.
function firstEndBeyond(segment, from, span) {
  // Fewer points lie on a circle, or nearly so, whatever the curve does between them.
  const FEW = 5;
  const { travel } = segment;
  const last = lastEnd(segment, from);
  let [low, high] = [from + FEW, last + 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (travel[middle] - travel[from] <= span * (1 + 1e-9)) low = middle + 1;
    else high = middle;
  }
  return low <= last ? low : -1;
}

// The furthest of some places up to which something holds, in longer and longer steps, and then between the
// last two; -1 where it does not at the first.
function lastHolding([first, last], holds) {
  if (!holds(first)) return -1;
  let [low, step] = [first, 1];
  while (low + step <= last && holds(low + step)) {
    low += step;
    step *= 2;
  }
  let high = Math.min(low + step, last + 1);
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (holds(middle)) low = middle;
    else high = middle;
  }
  return low;
}
