// Finds the straight portion of a curve.
//
// A portion lies in a strip, the narrowest band between two parallel lines that encloses it. Its length is
// that of its projection on that band's line, and its deviation half the band's width.
//
// For a tolerance, the result is the longest portion whose strip is no wider than that part of its length. A
// portion that is too wide requires a length proportional to its width, and any longer one from the same
// start is at least as wide: so from each point the search skips to that length. The longest between points,
// and every portion that might become longer, is then extended between them, a short one with many more
// points. A portion may go over sample 0 of a closed curve, and over limits.

import {
  stripWidthBound,
  clampEnds,
  pointSpacing,
  flattestPoints,
  lastEnd,
  resampleSegment,
  endAfterInput,
  endAfterLength,
  pointAt,
  portionPoints,
  inputSpan,
  firstPointBeyond,
} from "./curve-segment.js";
import { extendPortion } from "./portion-extension.js";
import { straightestEnds } from "./straightest.js";
import { triangleHeight, enclosingStrip, stripByExchange } from "./strip.js";

// How often a portion of few points is searched again with more points, and how few are too few.
const STRAIGHT_DEPTH = 4;
const FEW_POINTS = 8;
// What fits only between two points is found among the points by a slightly looser requirement.
const LOOSER_PART = 1.02;

/**
 * The straight portion of a segment by a criterion { tolerance | input | length }: { length, deviation,
 * start, input, x, y }, with its points; null if there is none so long.
 */
export function straightPortion(segment, criterion) {
  let ends;
  if (criterion.input !== undefined) {
    ends = straightestEnds(segment, (from, isRough) =>
      endAfterInput(segment, from, criterion.input, isRough),
    );
  } else if (criterion.length !== undefined) {
    ends = straightestEnds(segment, (from, isRough) =>
      endAfterLength(segment, from, criterion.length, isRough),
    );
  } else ends = longestPortion({ segment, tolerance: criterion.tolerance ?? 0.001, least: 1 });
  if (!ends) return null;
  const { x, y } = portionPoints(segment, ends);
  const { width, length } = enclosingStrip(x, y, 0, x.length);
  return {
    length,
    deviation: width / 2,
    start: pointAt(segment, ends[0])[2],
    input: inputSpan(segment, ends),
    x,
    y,
  };
}

// The ends of the longest portion anywhere.
function longestPortion(search) {
  // So many portions are extended that might come to be the longest.
  const RIVALS = 2;
  const { segment } = search;
  const flattest = () =>
    longerOf(
      ...flattestPoints(segment)
        .slice(0, RIVALS + 1)
        .map((k) => longestAround(search, k)),
    );
  const byPoints = longestBetweenPoints(search, LOOSER_PART);
  if (!byPoints) return flattest()?.ends ?? null;
  const { ends: found, width } = byPoints;
  // So few points are no evidence: they may only be far apart. Likelier is a portion where the curve is
  // flattest, or one of more points that is shorter than those seem.
  if (found[1] - found[0] < FEW_POINTS) {
    const byMore = longestBetweenPoints({ ...search, least: FEW_POINTS }, LOOSER_PART);
    const more = byMore && refinePortion(search, byMore.ends, STRAIGHT_DEPTH);
    return longerOf(flattest(), refinePortion(search, found, STRAIGHT_DEPTH), more)?.ends ?? null;
  }
  // Where nothing is straight between points, those are all that is known.
  let best = refinePortion(search, found, STRAIGHT_DEPTH) ??
    portionAtStricterTolerance(search, STRAIGHT_DEPTH) ?? { size: pointSpacing(segment, found), ends: found };
  for (const [from, to] of rivalPortions(search, width, best.size, found).slice(0, RIVALS)) {
    const drawn = refinePortion(search, [from, to], STRAIGHT_DEPTH);
    best = longerOf(best, drawn ?? resampledPortion(search, [from - 1, to + 1], STRAIGHT_DEPTH));
  }
  return best.ends;
}

function longerOf(...portions) {
  return portions.reduce((best, other) => (other && (!best || other.size > best.size) ? other : best), null);
}

// A portion that leaves something of the tolerance to the curve between its points.
function portionAtStricterTolerance(search, depth) {
  for (const part of [1, 0.99, 0.95, 0.85, 0.7]) {
    const byPoints = longestBetweenPoints(search, part);
    if (!byPoints) return null;
    const refined = refinePortion(search, byPoints.ends, depth);
    if (refined) return refined;
  }
  return null;
}

// The longest portion about a point, as far as it goes.
function longestAround(search, point) {
  let found = null;
  for (let round = 1; round <= FEW_POINTS; round *= 2) {
    const around = [point - round, point + round];
    const fine = resampledPortion(search, around, STRAIGHT_DEPTH);
    if (!fine) break;
    found = longerOf(found, fine);
    const [from, to] = clampEnds(search.segment, around);
    // What fills the window may go on outside.
    if (fine.ends[0] > from + 0.05 * round && fine.ends[1] < to - 0.05 * round) break;
  }
  return found;
}

// The points at the ends of the longest portion, for a part of the tolerance, and the width no portion may
// have more of.
function longestBetweenPoints({ segment, tolerance, least }, part) {
  // The sooner a long portion is found, the fewer points are tested: first those this far apart.
  const STRIDE = 16;
  const { x, y, starts, longestChord } = segment;
  const search = { segment, tolerance: tolerance * part };
  let reach = 0;
  for (let i = 0; i <= starts; i++) reach = Math.max(reach, pointSpacing(segment, [0, i]));
  const widest = search.tolerance * 2 * reach;
  let [best, found] = [0, null];
  const lookFrom = (from) => {
    // However straight, a portion is not as long before its way is.
    const to = Math.max(firstPointBeyond(segment, from, best), from + least);
    const longer = longestFromPoint(search, [from, to], () => 0, widest, best);
    if (longer) [best, found] = [longer.length, [from, longer.to]];
  };
  for (let from = 0; from < starts; from += STRIDE) lookFrom(from);
  for (let from = 0; from < starts; from++) lookFrom(from);
  if (!found) return null;
  const own = enclosingStrip(x, y, found[0], found[1] + 1);
  // Between points it may be longer by the way to the next at either end.
  return { ends: found, width: Math.min(widest, search.tolerance * (own.length + 2 * longestChord)) };
}

// The end and the length of the longest portion from a point, if it is longer than `longest`; it ends no
// sooner than at another point, and is not `widest` or wider. It is as wide as it may be if it goes `further`
// than the point at its end by so much.
function longestFromPoint({ segment, tolerance }, [from, begun], further, widest, longest) {
  const last = lastEnd(segment, from);
  let [to, best, found] = [begun, longest, null];
  while (to <= last) {
    const far = pointSpacing(segment, [from, to]);
    if (far <= best) {
      to = firstPointBeyond(segment, to, best - far);
      continue;
    }
    const more = further(to);
    const width = excessWidth(segment, [from, to], tolerance * (far + more));
    if (width === null) {
      [best, found] = [far, { to, length: far }];
      to += 1;
    } else if (width >= widest) break;
    // What goes further is as wide at least, and has to be as long as that width requires.
    else to = Math.max(firstPointBeyond(segment, from, width / tolerance - more), to + 1);
  }
  return found;
}

// How wide a portion is at least, by the points at its ends, if it is too wide; null where it may lie in a
// strip of a width.
function excessWidth(segment, [from, to], most) {
  const { x, y } = segment;
  const last = to - from;
  if (last < FEW_POINTS) {
    const bent = stripWidthBound(segment, [from, to]);
    if (bent > most) return bent;
    const { width } = last < 2 ? { width: 0 } : enclosingStrip(x, y, from, to + 1);
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
    const height = triangleHeight(x, y, ...corners);
    if (height > most) return height;
  }
  const three = [from, middle, to];
  if (stripByExchange(x, y, from, to + 1, three, most)) return null;
  return Math.max(triangleHeight(x, y, ...three), most);
}

// Portions that might come to be longer than `best` between points, the longest first, none upon another.
function rivalPortions({ segment, tolerance, least }, width, best, found) {
  const { starts, longestChord, count } = segment;
  const all = [];
  const shortest = best - 2 * longestChord;
  for (let from = 0; from < starts; from++) {
    // Extended it reaches no further than the next points, and is as much longer at most.
    const before = from > 0 ? pointSpacing(segment, [from - 1, from]) : longestChord;
    const further = (to) => before + (to + 1 < count ? pointSpacing(segment, [to, to + 1]) : 0);
    const first = Math.max(firstPointBeyond(segment, from, shortest), from + least);
    const longest = longestFromPoint({ segment, tolerance }, [from, first], further, width, shortest);
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
      const spacing = Math.abs(middle(ends) - middle(other));
      return Math.min(spacing, starts - spacing) < half;
    };
    if (!kept.some(isUpon)) kept.push(ends);
  }
  return kept.slice(1);
}

// A portion between points, { size, ends }, extended; one of few points by many more.
function refinePortion(search, ends, depth) {
  if (ends[1] - ends[0] >= FEW_POINTS || depth === 0) return extendRepeatedly(search, ends);
  return resampledPortion(search, [ends[0] - 1, ends[1] + 1], depth);
}

// A portion extended, and again from where it has come to while an end of it has gone nearly as far as it
// may.
function extendRepeatedly(search, ends) {
  const [MOVES, FAR] = [4, 0.95];
  let best = extendStrip(search, ends);
  for (let k = 0; best && k < MOVES; k++) {
    if (Math.max(Math.abs(best.ends[0] - ends[0]), Math.abs(best.ends[1] - ends[1])) < FAR) break;
    ends = best.ends;
    const further = extendStrip(search, ends);
    if (!further || further.size <= best.size * (1 + 1e-6)) break;
    best = further;
  }
  return best;
}

// The longest portion between two places, by many more points.
function resampledPortion(search, ends, depth) {
  const [from, to] = clampEnds(search.segment, ends);
  const piece = resampleSegment(search.segment, [from, to]);
  const part = (to - from) / (piece.count - 1);
  if (depth === 0) return null;
  const finer = { segment: piece, tolerance: search.tolerance, least: 1 };
  const byPoints = longestBetweenPoints(finer, LOOSER_PART);
  let found;
  if (byPoints)
    found = refinePortion(finer, byPoints.ends, depth - 1) ?? portionAtStricterTolerance(finer, depth - 1);
  else {
    const [k] = flattestPoints(piece);
    found = k === undefined ? null : resampledPortion(finer, [k - 1, k + 1], depth - 1);
  }
  return found && { size: found.size, ends: found.ends.map((place) => from + place * part) };
}

// A portion whose ends are moved, by a point at most, as far as its own length allows.
function extendStrip({ segment, tolerance }, ends) {
  const [from, to] = clampEnds(segment, ends);
  const core = portionPoints(segment, [from + 1, to - 1]);
  // What is passed on the way out is in the portion too.
  const passed = (end, inner) =>
    [0, 1 / 3, 2 / 3].map((part) => pointAt(segment, end + part * (inner - end)));
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
      const strip = stripByExchange(x, y, 0, kept + 3, three, Infinity) ?? enclosingStrip(x, y, 0, kept + 3);
      return { size: strip.length, excess: strip.width - tolerance * strip.length };
    };
  };
  return extendPortion(segment, [from, to], beginning);
}
