// A curve, or a piece of one, as a row of points between which portions of it are looked for.
//
// A place on it is a number: place 2.5 is between points 2 and 3. A closed curve is gone round twice, so that
// a portion that goes over its first point is a row of points too.

import { arrivedAtPlace, pointOfTrail } from "./between.js";
import { bendThrough } from "./trail.js";

/**
 * The whole of a trail as a course, by its samples: { trail, first, apart, x, y, travel, way, count, starts,
 * isClosed, longestChord }: where its first point is among the trail's samples and how far its points are
 * apart there; the points; how far the input has gone, there and back, at each; the way by chords up to each;
 * at how many points a portion may begin; and whether it goes on at its first point after its last.
 */
export function courseOfTrail(trail) {
  const course = sampledCourse(trail, 0, 1, trail.intervals + (trail.closed ? 0 : 1));
  return trail.closed ? goneRoundTwice(course) : course;
}

/** A piece of a course, between two of its places, by many points. */
export function pieceOfCourse({ trail, first, apart }, [from, to]) {
  const INTERVALS = 96;
  return sampledCourse(trail, first + from * apart, ((to - from) * apart) / INTERVALS, INTERVALS + 1);
}

// So many points, as far apart, of an open row.
function sampledCourse(trail, first, apart, count) {
  const [x, y, travel, way] = [0, 1, 2, 3].map(() => new Float64Array(count));
  const start = arrivedAtPlace(trail, first)[2];
  let longestChord = Number.MIN_VALUE;
  for (let k = 0; k < count; k++) {
    const at = arrivedAtPlace(trail, first + k * apart);
    [x[k], y[k]] = at;
    travel[k] = at[2] - start;
    if (k === 0) continue;
    const chord = Math.hypot(x[k] - x[k - 1], y[k] - y[k - 1]);
    longestChord = Math.max(longestChord, chord);
    way[k] = way[k - 1] + chord;
  }
  return {
    trail,
    first,
    apart,
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
function goneRoundTwice(course) {
  const { trail, x, y, way, count } = course;
  const closing = Math.hypot(x[0] - x[count - 1], y[0] - y[count - 1]);
  const twice = (values, round) => {
    const out = new Float64Array(2 * count);
    out.set(values);
    for (let k = 0; k < count; k++) out[count + k] = values[k] + round;
    return out;
  };
  return {
    ...course,
    x: twice(x, 0),
    y: twice(y, 0),
    travel: twice(course.travel, trail.travel[trail.count]),
    way: twice(way, way[count - 1] + closing),
    count: 2 * count,
    starts: count,
    isClosed: true,
    longestChord: Math.max(course.longestChord, closing),
  };
}

/** The signed curvature at a point, by its neighbours. */
function bendOfCourse({ x, y, count }, at) {
  const k = Math.min(Math.max(at, 1), Math.max(count, 3) - 2);
  return bendThrough(x, y, Math.min(k - 1, count - 1), Math.min(k, count - 1), Math.min(k + 1, count - 1));
}

/** The last point a portion may end at that begins at a place. */
export function lastOfCourse({ isClosed, starts, count }, from) {
  return isClosed ? from + starts - 1 : count - 1;
}

/** How far two points of a course are apart. */
export function distanceOnCourse({ x, y }, [from, to]) {
  const [dx, dy] = [x[to] - x[from], y[to] - y[from]];
  return Math.sqrt(dx * dx + dy * dy);
}

/**
 * The first point after another that is further on along the way than some distance; `count` where none is.
 */
export function wayBeyond({ way, count }, from, distance) {
  const far = way[from] + distance;
  let [low, high] = [from + 1, count];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (way[middle] <= far) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Two places, moved round a closed curve, or to the end of an open one, so that they are its own. */
export function clampedPlaces({ isClosed, starts, count }, [from, to]) {
  if (!isClosed) return [Math.max(from, 0), Math.min(to, count - 1)];
  const turn = from < 0 ? starts : 0;
  return [from + turn, Math.min(to + turn, from + turn + starts - 1)];
}

/** The point at a place, and the input there: [x, y, input]. */
export function placeOnCourse({ trail, first, apart }, place) {
  return pointOfTrail(trail, first + place * apart);
}

/** How far the input goes, there and back, from one place to another. */
export function spannedInput({ trail, first, apart }, [from, to]) {
  const at = (place) => arrivedAtPlace(trail, first + place * apart)[2];
  return Math.max(at(to) - at(from), 0);
}

/** The points of a portion, its ends among them, { x, y } in arrays; more between them where they are few. */
export function portionOfCourse(course, [from, to]) {
  const POINTS = 48;
  const [x, y] = [[], []];
  const add = (place) => {
    const isPoint = place >= 0 && Number.isInteger(place) && place < course.count;
    const [px, py] = isPoint ? [course.x[place], course.y[place]] : placeOnCourse(course, place);
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
 * The place a span of input after another; null where there is none. Where it is asked only roughly, the last
 * point that is not beyond it.
 */
export function placeAfterInput(course, from, wanted, isRough = false) {
  const { isClosed, starts, travel } = course;
  if (isClosed && from >= starts) {
    const place = placeAfterInput(course, from - starts, wanted, isRough);
    return place === null ? null : place + starts;
  }
  const first = Math.floor(from);
  const start = from === first ? travel[first] : spannedInput(course, [0, from]);
  // All of a closed curve ends where it begins.
  const last = isClosed ? first + starts : lastOfCourse(course, first);
  const span = wanted * (1 - 1e-12);
  const beyond = firstBeyond(travel, first, last, start + span);
  if (beyond > last) return null;
  const low = Math.max(beyond - 1, from);
  return isRough
    ? low
    : placeOfValue(low, beyond, (place) => spannedInput(course, [0, place]) - start - span);
}

/**
 * The first place a distance away from another; null where there is none; roughly, the last point before it.
 */
export function placeAfterLength(course, from, length, isRough = false) {
  const { isClosed, starts, x, y } = course;
  if (isClosed && from >= starts) {
    const place = placeAfterLength(course, from - starts, length, isRough);
    return place === null ? null : place + starts;
  }
  const first = Math.floor(from);
  const [sx, sy] = from === first ? [x[first], y[first]] : placeOnCourse(course, from);
  const last = lastOfCourse(course, first);
  let to = first + 1;
  while (to <= last) {
    const far = Math.hypot(x[to] - sx, y[to] - sy);
    if (far >= length) break;
    to = wayBeyond(course, to, length - far);
  }
  if (to > last) return null;
  const low = Math.max(to - 1, from);
  const distance = (place) => {
    const [px, py] = placeOnCourse(course, place);
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

// Where a function goes from below nothing to nothing or more between two places: by secants that keep it
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
 * No more than the width of the narrowest strip of the portion between two points: that of a circle which
 * bends as little as any part of it does.
 */
export function bendBetween(course, [from, to]) {
  let [least, left] = [Infinity, 0];
  for (let k = from; k <= to; k++) {
    const bend = bendOfCourse(course, k);
    least = Math.min(least, Math.abs(bend));
    if (bend > 0) left += 1;
  }
  const chord = distanceOnCourse(course, [from, to]);
  return left === 0 || left === to - from + 1 ? (least * chord * chord) / 8 : 0;
}

/** The points at which a course bends less than at their neighbours, the straightest first. */
export function flattestPoints(course) {
  const { starts: n, count, isClosed } = course;
  const bends = Array.from({ length: Math.min(n, count - 1) + 1 }, (_, k) =>
    Math.abs(bendOfCourse(course, k)),
  );
  const found = [];
  for (let k = 0; k < n; k++) {
    const before = k > 0 ? bends[k - 1] : bends[isClosed ? n - 1 : 1];
    if (bends[k] <= before && bends[k] <= bends[Math.min(k + 1, bends.length - 1)]) found.push(k);
  }
  return found.sort((a, b) => bends[a] - bends[b]);
}
