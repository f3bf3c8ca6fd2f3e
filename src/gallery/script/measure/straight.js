// The straightest portion of a curve.
//
// A portion lies in a strip, the narrowest band between two parallel lines that holds it. Its length is that
// of its projection on that band's line, and its deviation half the band's width.
//
// Of a tolerance, the longest portion is wanted whose strip is no wider than that part of its length. A
// portion that is too wide asks for a length that goes with its width, and any that begins there and goes
// further is as wide at least: so from each point the search leaps to where that length may be. The longest
// by points, and whatever might come to be longer, is then drawn out between them, a short one among many
// more. A portion may go over sample 0 of a closed curve, and over limits.

import {
  bendBetween,
  clampedPlaces,
  distanceOnCourse,
  flattestPoints,
  lastOfCourse,
  pieceOfCourse,
  placeAfterInput,
  placeAfterLength,
  placeOnCourse,
  portionOfCourse,
  spannedInput,
  wayBeyond,
} from "./course.js";
import { drawnOut } from "./drawn-out.js";
import { straightestEnds } from "./straightest.js";
import { heightOfTriangle, stripOfPoints, stripOfRow } from "./strip.js";

// How often a portion of few points is looked for again among many, and how few say little.
const STRAIGHT_DEPTH = 4;
const FEW_POINTS = 8;
// What fits only between two points is found by asking the points for a little less.
const LOOSER_PART = 1.02;

/**
 * The straight portion asked for, { tolerance | input | length }, of a course: { length, deviation, start,
 * input, x, y }, with its points; null where there is none so long.
 */
export function straightPortion(course, asked) {
  let ends;
  if (asked.input !== undefined) {
    ends = straightestEnds(course, (from, isRough) => placeAfterInput(course, from, asked.input, isRough));
  } else if (asked.length !== undefined) {
    ends = straightestEnds(course, (from, isRough) => placeAfterLength(course, from, asked.length, isRough));
  } else ends = longestOfAll({ course, tolerance: asked.tolerance ?? 0.001, least: 1 });
  if (!ends) return null;
  const { x, y } = portionOfCourse(course, ends);
  const { width, length } = stripOfPoints(x, y, 0, x.length);
  return {
    length,
    deviation: width / 2,
    start: placeOnCourse(course, ends[0])[2],
    input: spannedInput(course, ends),
    x,
    y,
  };
}

// The ends of the longest portion anywhere.
function longestOfAll(search) {
  // So many portions are drawn out that might come to be the longest.
  const RIVALS = 2;
  const { course } = search;
  const flattest = () =>
    longerOf(
      ...flattestPoints(course)
        .slice(0, RIVALS + 1)
        .map((k) => longestAbout(search, k)),
    );
  const byPoints = longestByPoints(search, LOOSER_PART);
  if (!byPoints) return flattest()?.ends ?? null;
  const { ends: found, width } = byPoints;
  // So few points say little: they may only be far apart. Likelier is a portion where the curve is flattest,
  // or one of more points that is shorter than those seem.
  if (found[1] - found[0] < FEW_POINTS) {
    const byMore = longestByPoints({ ...search, least: FEW_POINTS }, LOOSER_PART);
    const more = byMore && refinedPortion(search, byMore.ends, STRAIGHT_DEPTH);
    return longerOf(flattest(), refinedPortion(search, found, STRAIGHT_DEPTH), more)?.ends ?? null;
  }
  // Where nothing is straight between points, those are all that is known.
  let best = refinedPortion(search, found, STRAIGHT_DEPTH) ??
    stricterPortion(search, STRAIGHT_DEPTH) ?? { size: distanceOnCourse(course, found), ends: found };
  for (const [from, to] of rivalPortions(search, width, best.size, found).slice(0, RIVALS)) {
    const drawn = refinedPortion(search, [from, to], STRAIGHT_DEPTH);
    best = longerOf(best, drawn ?? finePortion(search, [from - 1, to + 1], STRAIGHT_DEPTH));
  }
  return best.ends;
}

function longerOf(...portions) {
  return portions.reduce((best, other) => (other && (!best || other.size > best.size) ? other : best), null);
}

// A portion that leaves something of the tolerance to the curve between its points.
function stricterPortion(search, depth) {
  for (const part of [1, 0.99, 0.95, 0.85, 0.7]) {
    const byPoints = longestByPoints(search, part);
    if (!byPoints) return null;
    const refined = refinedPortion(search, byPoints.ends, depth);
    if (refined) return refined;
  }
  return null;
}

// The longest portion about a point, as far as it goes.
function longestAbout(search, point) {
  let found = null;
  for (let round = 1; round <= FEW_POINTS; round *= 2) {
    const around = [point - round, point + round];
    const fine = finePortion(search, around, STRAIGHT_DEPTH);
    if (!fine) break;
    found = longerOf(found, fine);
    const [from, to] = clampedPlaces(search.course, around);
    // What fills the window may go on outside.
    if (fine.ends[0] > from + 0.05 * round && fine.ends[1] < to - 0.05 * round) break;
  }
  return found;
}

// The points at the ends of the longest portion, for a part of the tolerance, and the width no portion may
// have more of.
function longestByPoints({ course, tolerance, least }, part) {
  // The sooner something long is found, the less has to be looked at: first from points so far apart.
  const STRIDE = 16;
  const { x, y, starts, longestChord } = course;
  const search = { course, tolerance: tolerance * part };
  let reach = 0;
  for (let i = 0; i <= starts; i++) reach = Math.max(reach, distanceOnCourse(course, [0, i]));
  const widest = search.tolerance * 2 * reach;
  let [best, found] = [0, null];
  const lookFrom = (from) => {
    // However straight, a portion is not as long before its way is.
    const to = Math.max(wayBeyond(course, from, best), from + least);
    const longer = longestFrom(search, [from, to], () => 0, widest, best);
    if (longer) [best, found] = [longer.length, [from, longer.to]];
  };
  for (let from = 0; from < starts; from += STRIDE) lookFrom(from);
  for (let from = 0; from < starts; from++) lookFrom(from);
  if (!found) return null;
  const own = stripOfPoints(x, y, found[0], found[1] + 1);
  // Between points it may be longer by the way to the next at either end.
  return { ends: found, width: Math.min(widest, search.tolerance * (own.length + 2 * longestChord)) };
}

// The end and the length of the longest portion from a point, if it is longer than `longest`; it ends no
// sooner than at another point, and is not `widest` or wider. It is as wide as it may be if it goes `further`
// than the point at its end by so much.
function longestFrom({ course, tolerance }, [from, begun], further, widest, longest) {
  const last = lastOfCourse(course, from);
  let [to, best, found] = [begun, longest, null];
  while (to <= last) {
    const far = distanceOnCourse(course, [from, to]);
    if (far <= best) {
      to = wayBeyond(course, to, best - far);
      continue;
    }
    const more = further(to);
    const width = excessWidth(course, [from, to], tolerance * (far + more));
    if (width === null) {
      [best, found] = [far, { to, length: far }];
      to += 1;
    } else if (width >= widest) break;
    // What goes further is as wide at least, and has to be as long as that asks for.
    else to = Math.max(wayBeyond(course, from, width / tolerance - more), to + 1);
  }
  return found;
}

// How wide a portion is at least, by the points at its ends, if it is too wide; null where it may lie in a
// strip of a width.
function excessWidth(course, [from, to], most) {
  const { x, y } = course;
  const last = to - from;
  if (last < FEW_POINTS) {
    const bent = bendBetween(course, [from, to]);
    if (bent > most) return bent;
    const { width } = last < 2 ? { width: 0 } : stripOfPoints(x, y, from, to + 1);
    return width > most ? width : null;
  }
  // First by triangles: one in a strip is no higher, over its longest side, than the strip is wide.
  const quarter = Math.floor(last / 4);
  const middle = from + Math.floor(last / 2);
  const triangles = [
    [from, middle, to],
    [from, from + quarter, to - quarter],
    [from + quarter, to - quarter, to],
  ];
  for (const corners of triangles) {
    const height = heightOfTriangle(x, y, ...corners);
    if (height > most) return height;
  }
  const three = [from, middle, to];
  if (stripOfRow(x, y, from, to + 1, three, most)) return null;
  return Math.max(heightOfTriangle(x, y, ...three), most);
}

// Portions that might come to be longer than `best` between points, the longest first, none upon another.
function rivalPortions({ course, tolerance, least }, width, best, found) {
  const { starts, longestChord, count } = course;
  const all = [];
  const shortest = best - 2 * longestChord;
  for (let from = 0; from < starts; from++) {
    // Drawn out it reaches no further than the next points, and is as much longer at most.
    const before = from > 0 ? distanceOnCourse(course, [from - 1, from]) : longestChord;
    const further = (to) => before + (to + 1 < count ? distanceOnCourse(course, [to, to + 1]) : 0);
    const first = Math.max(wayBeyond(course, from, shortest), from + least);
    const longest = longestFrom({ course, tolerance }, [from, first], further, width, shortest);
    if (!longest) continue;
    const { to, length } = longest;
    if (length + further(to) > best) all.push({ length, ends: [from, to] });
  }
  all.sort((a, b) => b.length - a.length);
  const kept = [found];
  const middle = ([from, to]) => Math.floor((from + to) / 2) % starts;
  for (const { ends } of all) {
    const half = Math.max(Math.floor((ends[1] - ends[0]) / 2), 1);
    const isUpon = (other) => {
      const apart = Math.abs(middle(ends) - middle(other));
      return Math.min(apart, starts - apart) < half;
    };
    if (!kept.some(isUpon)) kept.push(ends);
  }
  return kept.slice(1);
}

// A portion between points, { size, ends }, drawn out; one of few points by many more.
function refinedPortion(search, ends, depth) {
  if (ends[1] - ends[0] >= FEW_POINTS || depth === 0) return drawnFurthest(search, ends);
  return finePortion(search, [ends[0] - 1, ends[1] + 1], depth);
}

// A portion drawn out, and again from where it has come to while an end of it has gone nearly as far as it
// may.
function drawnFurthest(search, ends) {
  const [MOVES, FAR] = [4, 0.95];
  let best = drawnOutStrip(search, ends);
  for (let k = 0; best && k < MOVES; k++) {
    if (Math.max(Math.abs(best.ends[0] - ends[0]), Math.abs(best.ends[1] - ends[1])) < FAR) break;
    ends = best.ends;
    const further = drawnOutStrip(search, ends);
    if (!further || further.size <= best.size * (1 + 1e-6)) break;
    best = further;
  }
  return best;
}

// The longest portion between two places, by many more points.
function finePortion(search, ends, depth) {
  const [from, to] = clampedPlaces(search.course, ends);
  const piece = pieceOfCourse(search.course, [from, to]);
  const part = (to - from) / (piece.count - 1);
  if (depth === 0) return null;
  const finer = { course: piece, tolerance: search.tolerance, least: 1 };
  const byPoints = longestByPoints(finer, LOOSER_PART);
  let found;
  if (byPoints) found = refinedPortion(finer, byPoints.ends, depth - 1) ?? stricterPortion(finer, depth - 1);
  else {
    const [k] = flattestPoints(piece);
    found = k === undefined ? null : finePortion(finer, [k - 1, k + 1], depth - 1);
  }
  return found && { size: found.size, ends: found.ends.map((place) => from + place * part) };
}

// A portion whose ends are moved, by a point at most, as far as its own length allows.
function drawnOutStrip({ course, tolerance }, ends) {
  const [from, to] = clampedPlaces(course, ends);
  const core = portionOfCourse(course, [from + 1, to - 1]);
  // What is passed on the way out is in the portion too.
  const passed = (end, inner) =>
    [0, 1 / 3, 2 / 3].map((part) => placeOnCourse(course, end + part * (inner - end)));
  const beginning = (start) => {
    const before = passed(start, from + 1);
    const x = [...before.map((p) => p[0]), ...core.x];
    const y = [...before.map((p) => p[1]), ...core.y];
    const kept = x.length;
    const three = [0, kept >> 1, kept + 2];
    return (end) => {
      passed(end, to - 1).forEach((p, k) => {
        [x[kept + 2 - k], y[kept + 2 - k]] = p;
      });
      const strip = stripOfRow(x, y, 0, kept + 3, three, Infinity) ?? stripOfPoints(x, y, 0, kept + 3);
      return { size: strip.length, excess: strip.width - tolerance * strip.length };
    };
  };
  return drawnOut(course, [from, to], beginning);
}
