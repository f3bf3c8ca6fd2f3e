// The best circular arc of a curve: where a link from the coupler point to the arc's centre would let its far
// end dwell.
//
// A portion is such an arc if it lies in a ring between two circles about one centre no wider than 0.001 of
// the curve's greatest extent, about a circle of a radius no larger than the curve is long. Of all the one
// that spans the most input is the best. What fits a ring fits with any part of it, so that it is found by
// moving both ends along the curve once, and then between its points.

import { ringRound, ringWithin } from "./annulus.js";
import { clampedPlaces, lastOfCourse, placeOnCourse, portionOfCourse, spannedInput } from "./course.js";
import { drawnOut } from "./drawn-out.js";
import { diameterOfHull, hullOfPoints } from "./hull.js";

/**
 * The best circular portion of a course: { x, y, radius, deviation, start, input }, the centre and the radius
 * of its circle, the greatest distance of its points from that, the input at which it begins and how much it
 * spans, there and back over limits; null of a point or a straight line.
 */
export function circularPortion(course) {
  const TOLERANCE = 0.001;
  const corners = hullOfPoints(course.x, course.y, 0, Math.min(course.starts + 1, course.count));
  const search = {
    course,
    width: TOLERANCE * diameterOfHull(corners),
    largest: course.way[course.starts],
    fitting: [],
  };
  const ends = longestArc(search);
  if (!ends) return null;
  const { x, y } = portionOfCourse(course, ends);
  // On a long arc the exchange of points may end at a ring that is not the narrowest: then the portion has a
  // better one, by which it was found to fit.
  const anew = ringWithin(x, y, 0, x.length, {}, Infinity, search.largest);
  const known = search.fitting.findLast((other) => other.ends[0] === ends[0] && other.ends[1] === ends[1]);
  const before = known ? ringRound(x, y, 0, x.length, known.ring.x, known.ring.y) : null;
  const ring = anew && before ? (before.width < anew.width ? before : anew) : (anew ?? before);
  if (!ring) return null;
  const start = placeOnCourse(course, ends[0])[2];
  return {
    x: ring.x,
    y: ring.y,
    radius: ring.radius,
    deviation: ring.width / 2,
    start,
    input: spannedInput(course, ends),
  };
}

function longestArc(search) {
  const MOVES = 4;
  const { course } = search;
  const found = longestArcByPoints(search);
  if (!found) return null;
  const [from, to] = found;
  // All of a closed curve is a portion that ends where it begins.
  if (course.isClosed && to === lastOfCourse(course, from)) return [0, course.starts];
  const longer = nearestToLonger(search, course.travel[to] - course.travel[from]);
  const isApart = !longer || Math.abs(longer[0] - from) > 1;
  const drawn = longer && drawnOutRing(search, longer);
  const other = isApart || !drawn ? drawnOutRing(search, found) : null;
  let best = { size: 0, ends: found };
  for (const portion of [drawn, other]) if (portion && portion.size >= best.size) best = portion;
  for (let move = 0; move < MOVES; move++) {
    // Drawn out from where it has come to it may go further the same way.
    const further = drawnOutRing(search, best.ends);
    if (!further || further.size <= best.size * (1 + 1e-6)) break;
    best = further;
  }
  return best.ends;
}

// How much input a portion spans, and its ends, drawn out between points.
function drawnOutRing({ course, width, largest, fitting }, ends) {
  const [from, to] = clampedPlaces(course, ends);
  const core = portionOfCourse(course, [from + 1, to - 1]);
  // What is passed on the way out is in the portion too.
  const passed = (end, inner) => [0, 0.5].map((part) => placeOnCourse(course, end + part * (inner - end)));
  const beginning = (start) => {
    const before = passed(start, from + 1);
    const x = [...before.map((p) => p[0]), ...core.x];
    const y = [...before.map((p) => p[1]), ...core.y];
    const kept = x.length;
    const turns = {};
    const size = spannedInput(course, [start, from + 1]);
    return (end) => {
      passed(end, to - 1).forEach((p, k) => {
        [x[kept + 1 - k], y[kept + 1 - k]] = p;
      });
      const ring = ringWithin(x, y, 0, kept + 2, turns, Infinity, largest);
      const excess = ring ? ring.width - width : Infinity;
      if (excess <= 0) fitting.push({ ends: [start, end], ring });
      return { size: size + spannedInput(course, [from + 1, end]), excess };
    };
  };
  return drawnOut(course, [from, to], beginning);
}

// The points at the ends of the portion that spans the most input.
function longestArcByPoints({ course, width, largest }) {
  let [best, found] = [0, null];
  for (let from = 0; from < course.starts; from++) {
    const beyond = endBeyond(course, from, best);
    if (beyond < 0) continue;
    const to = furthestPoint([beyond, lastOfCourse(course, from)], (end) =>
      fitsRing(course, [from, end], width, largest),
    );
    if (to >= 0) [best, found] = [course.travel[to] - course.travel[from], [from, to]];
  }
  return found;
}

function fitsRing({ x, y }, [from, to], most, largest) {
  return ringWithin(x, y, from, to + 1, {}, most, largest);
}

// The ends, between points, of a portion that spans a little more than `span` and lies in the narrowest ring
// of those: as every portion from point to point that fits spans no more, this one comes nearest to it.
function nearestToLonger({ course, largest }, span) {
  let [narrowest, found] = [Infinity, null];
  for (let from = 0; from < course.starts; from++) {
    const to = endBeyond(course, from, span);
    const ring = to < 0 ? null : fitsRing(course, [from, to], narrowest, largest);
    if (ring) [narrowest, found] = [ring.width, [from + 0.5, to - 0.5]];
  }
  return found;
}

// The first point that portions from another may end at which span more than some input; -1 where there is
// none.
function endBeyond(course, from, span) {
  // Fewer points lie on a circle, or nearly so, whatever the curve does between them.
  const FEW = 5;
  const { travel } = course;
  const last = lastOfCourse(course, from);
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
function furthestPoint([first, last], holds) {
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
