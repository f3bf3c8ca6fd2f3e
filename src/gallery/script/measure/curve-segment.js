// A curve or a segment of one, as a row of points on which portions are searched.
//
// A position on it is a number: 2.5 is between points 2 and 3. The points of a closed curve are repeated for
// a second round, so that a portion over its first point is a row of points too.

import { pointAndTravelAt, pointAndInputAt } from "./interpolation.js";
import { curvatureThrough } from "./sampled-curve.js";

/**
 * A whole sampled curve as a segment: { curve, first, spacing, x, y, travel, way, count, starts, isClosed,
 * longestChord }: the sample its first point is at and the spacing of its points in samples; the points; the
 * total variation of the input up to each; the cumulative chord length up to each; the number of points at
 * which a portion may begin; and whether its first point follows its last.
 */
export function wholeCurve(curve) {
  const segment = evenlySpaced(curve, 0, 1, curve.intervals + (curve.closed ? 0 : 1));
  return curve.closed ? appendSecondRound(segment) : segment;
}

/** The part of a segment between two positions, resampled with many points. */
export function resampleSegment({ curve, first, spacing }, [from, to]) {
  const INTERVALS = 96;
  return evenlySpaced(curve, first + from * spacing, ((to - from) * spacing) / INTERVALS, INTERVALS + 1);
}

// So many points, as far apart, of an open row.
function evenlySpaced(curve, first, spacing, count) {
  const [x, y, travel, way] = [0, 1, 2, 3].map(() => new Float64Array(count));
  const start = pointAndTravelAt(curve, first)[2];
  let longestChord = Number.MIN_VALUE;
  for (let k = 0; k < count; k++) {
    const at = pointAndTravelAt(curve, first + k * spacing);
    [x[k], y[k]] = at;
    travel[k] = at[2] - start;
    if (k === 0) continue;
    const chord = Math.hypot(x[k] - x[k - 1], y[k] - y[k - 1]);
    longestChord = Math.max(longestChord, chord);
    way[k] = way[k - 1] + chord;
  }
  return {
    curve,
    first,
    spacing,
    x,
    y,
    travel,
    way,
    count,
    starts: Math.max(count - 1, 0),
    isClosed: false,
    longestChord,
  };
}

// Closes the row, and goes round a second time.
function appendSecondRound(segment) {
  const { curve, x, y, way, count } = segment;
  const closing = Math.hypot(x[0] - x[count - 1], y[0] - y[count - 1]);
  const twice = (values, round) => {
    const out = new Float64Array(2 * count);
    out.set(values);
    for (let k = 0; k < count; k++) out[count + k] = values[k] + round;
    return out;
  };
  return {
    ...segment,
    x: twice(x, 0),
    y: twice(y, 0),
    travel: twice(segment.travel, curve.travel[curve.count]),
    way: twice(way, way[count - 1] + closing),
    count: 2 * count,
    starts: count,
    isClosed: true,
    longestChord: Math.max(segment.longestChord, closing),
  };
}

/** The signed curvature at a point, by its neighbours. */
function curvatureAtPoint({ x, y, count }, at) {
  const k = Math.min(Math.max(at, 1), Math.max(count, 3) - 2);
  return curvatureThrough(
    x,
    y,
    Math.min(k - 1, count - 1),
    Math.min(k, count - 1),
    Math.min(k + 1, count - 1),
  );
}

/** The last point at which a portion that begins at a position may end. */
export function lastEnd({ isClosed, starts, count }, from) {
  return isClosed ? from + starts - 1 : count - 1;
}

/** The distance of two points of a segment. */
export function pointSpacing({ x, y }, [from, to]) {
  const [dx, dy] = [x[to] - x[from], y[to] - y[from]];
  return Math.sqrt(dx * dx + dy * dy);
}

/** The first point after another by more than a distance along the chords; `count` if there is none. */
export function firstPointBeyond({ way, count }, from, distance) {
  const far = way[from] + distance;
  let [low, high] = [from + 1, count];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (way[middle] <= far) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Two positions brought into range: wrapped round a closed curve, or clamped to the ends of an open one. */
export function clampEnds({ isClosed, starts, count }, [from, to]) {
  if (!isClosed) return [Math.max(from, 0), Math.min(to, count - 1)];
  const turn = from < 0 ? starts : 0;
  return [from + turn, Math.min(to + turn, from + turn + starts - 1)];
}

/** The point and the input at a position: [x, y, input]. */
export function pointAt({ curve, first, spacing }, place) {
  return pointAndInputAt(curve, first + place * spacing);
}

/** The total variation of the input between two positions. */
export function inputSpan({ curve, first, spacing }, [from, to]) {
  const at = (place) => pointAndTravelAt(curve, first + place * spacing)[2];
  return Math.max(at(to) - at(from), 0);
}

/**
 * The points of a portion including its ends, { x, y } in arrays; interpolated points are added if they are
 * few.
 */
export function portionPoints(segment, [from, to]) {
  const POINTS = 48;
  const [x, y] = [[], []];
  const add = (place) => {
    const isPoint = place >= 0 && Number.isInteger(place) && place < segment.count;
    const [px, py] = isPoint ? [segment.x[place], segment.y[place]] : pointAt(segment, place);
    x.push(px);
    y.push(py);
  };
  add(from);
  if (to <= from) return { x, y };
  const parts = Math.max(Math.ceil(POINTS / (to - from)), 1);
  for (let k = Math.floor(from * parts) + 1; k / parts < to; k++) add(k / parts);
  add(to);
  return { x, y };
}

/**
 * The position a span of input after another; null if there is none. With `isRough`, the last point that is
 * not beyond it.
 */
export function endAfterInput(segment, from, wanted, isRough = false) {
  const { isClosed, starts, travel } = segment;
  if (isClosed && from >= starts) {
    const place = endAfterInput(segment, from - starts, wanted, isRough);
    return place === null ? null : place + starts;
  }
  const first = Math.floor(from);
  const start = from === first ? travel[first] : inputSpan(segment, [0, from]);
  // All of a closed curve ends where it begins.
  const last = isClosed ? first + starts : lastEnd(segment, first);
  const span = wanted * (1 - 1e-12);
  const beyond = firstBeyond(travel, first, last, start + span);
  if (beyond > last) return null;
  const low = Math.max(beyond - 1, from);
  return isRough ? low : placeOfValue(low, beyond, (place) => inputSpan(segment, [0, place]) - start - span);
}

/**
 * The first position at a distance from another; null if there is none. With `isRough`, the last point before
 * it.
 */
export function endAfterLength(segment, from, length, isRough = false) {
  const { isClosed, starts, x, y } = segment;
  if (isClosed && from >= starts) {
    const place = endAfterLength(segment, from - starts, length, isRough);
    return place === null ? null : place + starts;
  }
  const first = Math.floor(from);
  const [sx, sy] = from === first ? [x[first], y[first]] : pointAt(segment, from);
  const last = lastEnd(segment, first);
  let to = first + 1;
  while (to <= last) {
    const far = Math.hypot(x[to] - sx, y[to] - sy);
    if (far >= length) break;
    to = firstPointBeyond(segment, to, length - far);
  }
  if (to > last) return null;
  const low = Math.max(to - 1, from);
  const distance = (place) => {
    const [px, py] = pointAt(segment, place);
    return Math.hypot(px - sx, py - sy) - length;
  };
  return isRough ? low : placeOfValue(low, to, distance);
}

// The first of the places from `first` to `last` at which a rising row comes to a value; one more where none
// does.
function firstBeyond(row, first, last, value) {
  let [low, high] = [first, last + 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (row[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

// Where a function changes from negative to zero or positive between two places: by secants that keep it
// between them.
function placeOfValue(from, to, f) {
  let [low, high, below, above] = [from, to, f(from), f(to)];
  if (below >= 0) return low;
  for (let round = 0; round < 40 && high - low > 1e-12 * Math.max(1, high); round++) {
    const part = round % 4 === 3 || !(above > below) ? 0.5 : below / (below - above);
    const middle = low + Math.min(Math.max(part, 1e-3), 1 - 1e-3) * (high - low);
    const value = f(middle);
    if (value < 0) [low, below, above] = [middle, value, above / 2];
    else [high, above, below] = [middle, value, below / 2];
    if (value === 0) break;
  }
  return high;
}

/**
 * A lower bound of the width of the narrowest strip of the portion between two points: that of an arc with
 * the least curvature in it.
 */
export function stripWidthBound(segment, [from, to]) {
  let [least, left] = [Infinity, 0];
  for (let k = from; k <= to; k++) {
    const bend = curvatureAtPoint(segment, k);
    least = Math.min(least, Math.abs(bend));
    if (bend > 0) left += 1;
  }
  const chord = pointSpacing(segment, [from, to]);
  return left === 0 || left === to - from + 1 ? (least * chord * chord) / 8 : 0;
}

/** The points with a local minimum of curvature, the straightest first. */
export function flattestPoints(segment) {
  const { starts: n, count, isClosed } = segment;
  const curvatures = Array.from({ length: Math.min(n, count - 1) + 1 }, (_, k) =>
    Math.abs(curvatureAtPoint(segment, k)),
  );
  const found = [];
  for (let k = 0; k < n; k++) {
    const before = k > 0 ? curvatures[k - 1] : curvatures[isClosed ? n - 1 : 1];
    if (curvatures[k] <= before && curvatures[k] <= curvatures[Math.min(k + 1, curvatures.length - 1)])
      found.push(k);
  }
  return found.sort((a, b) => curvatures[a] - curvatures[b]);
}
