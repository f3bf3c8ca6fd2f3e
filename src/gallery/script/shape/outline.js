// Outlines: polylines, open or closed, as flat arrays [x0, y0, x1, y1, …] without a repeated first point; handles on them, each of which
// moves the points near it or takes them away; and their words in addresses.

import { boxOfPoints, pointPairs } from "../draw/plane-view.js";

// A shape of more points is changed by so many handles, each of which moves the points up to the next two.
const MOST_HANDLES = 12;
const POINTS_PER_HANDLE = 8;
const BEND_REACH = 12;

/** The length of an outline up to each of its points; of a closed one also round to its first. */
export function lengthsAlong(/** @type {Points} */ points, /** @type {boolean} */ closed) {
  const count = points.length / 2;
  const along = new Float64Array(count + (closed ? 1 : 0));
  for (let k = 1; k < along.length; k += 1) {
    const [a, b] = [2 * (k - 1), 2 * (k % count)];
    const [dx, dy] = [points[b] - points[a], points[b + 1] - points[a + 1]];
    along[k] = along[k - 1] + Math.sqrt(dx * dx + dy * dy);
  }
  return along;
}

/**
 * `count` points spaced evenly along an outline: of an open one with both ends, of a closed one from its first point round.
 * @param {Points} points @param {boolean} closed
 */
export function resampled(points, closed, /** @type {number} */ count) {
  return portion(points, closed, 0, closed ? 1 - 1 / count : 1, count).points;
}

/** Whether an outline ends so near to its start, within 12 % of the greater side of its box, that it is probably meant to be closed. */
export function looksClosed(/** @type {Points} */ points) {
  const [x0, y0, x1, y1] = boxOfPoints(points);
  const end = points.length - 2;
  const gap = Math.hypot(points[end] - points[0], points[end + 1] - points[1]);
  return points.length >= 12 && gap <= 0.12 * Math.max(x1 - x0, y1 - y0);
}

/**
 * The portion of an outline between two fractions of its length as `count` even points; on a closed one it may
 * continue over the first point, on an open one it ends at the ends: `from` and `to` are the actual fractions.
 * @param {Points} points @param {boolean} closed @param {number} from @param {number} to @param {number} count
 */
export function portion(points, closed, from, to, count) {
  const along = lengthsAlong(points, closed);
  const whole = along[along.length - 1];
  const vertices = points.length / 2;
  const [a, b] = closed ? [from, to] : [Math.max(from, 0), Math.min(to, 1)];
  const out = new Float64Array(2 * count);
  for (let n = 0; n < count; n += 1) {
    const part = a + ((b - a) * n) / (count - 1);
    const s = whole * (closed ? part - Math.floor(part) : part);
    let [low, high] = [0, along.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (along[middle] <= s) low = middle;
      else high = middle;
    }
    const span = along[high] - along[low];
    const t = span > 0 ? Math.min((s - along[low]) / span, 1) : 0;
    const [p, q] = [2 * low, 2 * (high % vertices)];
    out[2 * n] = points[p] + t * (points[q] - points[p]);
    out[2 * n + 1] = points[p + 1] + t * (points[q + 1] - points[p + 1]);
  }
  return { points: out, from: a, to: b };
}

/** The places of the handles of a shape. */
export function handlesOf(/** @type {Outline} */ { points, closed }) {
  return pointPairs(points.length > 2 * MOST_HANDLES ? resampled(points, closed, MOST_HANDLES) : points);
}

/** The points that are changed, how many points each coordinate is away from a handle, and from where on none is changed. */
function aroundHandle(/** @type {Outline} */ { points, closed }, /** @type {number} */ handle) {
  const isFew = points.length <= 2 * MOST_HANDLES;
  const count = MOST_HANDLES * POINTS_PER_HANDLE - (closed ? 0 : POINTS_PER_HANDLE - 1);
  const base = isFew ? points : resampled(points, closed, count);
  const [at, reach] = isFew ? [handle, 1] : [handle * POINTS_PER_HANDLE, BEND_REACH];
  const away = (/** @type {number} */ k) => {
    const apart = Math.abs((k >> 1) - at);
    return closed ? Math.min(apart, base.length / 2 - apart) : apart;
  };
  return { base, reach, away };
}

/** A function that gives a shape with a handle moved by [dx, dy]. @param {Outline} shape @returns {(by: Point) => Outline} */
export function bending(shape, /** @type {number} */ handle) {
  const { base, reach, away } = aroundHandle(shape, handle);
  const share = (/** @type {number} */ k) =>
    away(k) < reach ? Math.cos((Math.PI * away(k)) / (2 * reach)) ** 2 : 0;
  const bent = (/** @type {Point} */ by) => base.map((value, k) => value + share(k) * by[k % 2]);
  return (by) => ({ points: bent(by), closed: shape.closed });
}

/** A shape without a handle and the points around it. @param {Outline} shape @returns {Outline} */
export function withoutHandle(shape, /** @type {number} */ handle) {
  const { base, reach, away } = aroundHandle(shape, handle);
  return { points: base.filter((_, k) => away(k) >= reach), closed: shape.closed };
}

const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
// Twelve bits of a coordinate: one in 4,096 of the greater side of the shape's box.
const COORDINATE_MAX = 4095;

/**
 * A shape, of more than `most` points so many even ones: { word, place }. The word is in letters of base64url: "c" if it is closed or "o", then
 * four letters for each point in the box of the shape; the place is the corner of that box and its greater side.
 */
export function encodeShape(/** @type {Float64Array} */ points, /** @type {boolean} */ closed, most = 48) {
  const few = points.length > 2 * most ? resampled(points, closed, most) : points;
  const [x0, y0, x1, y1] = boxOfPoints(few);
  const side = Math.max(x1 - x0, y1 - y0) || 1;
  let word = closed ? "c" : "o";
  few.forEach((value, k) => {
    const whole = Math.round(((value - (k % 2 ? y0 : x0)) / side) * COORDINATE_MAX);
    word += LETTERS[whole >> 6] + LETTERS[whole & 63];
  });
  return { word, place: [x0, y0, side].map((value) => Number(value.toPrecision(6))) };
}

/** The shape of such a word, { points, closed }, at a place, usually with a side of 100; null if it is not valid. @param {number[] | null} place */
export function decodeShape(/** @type {string} */ word, place = null) {
  if (!/^[co](?:[\w-]{4}){2,}$/.test(word)) return null;
  const [x0, y0, side] = place ?? [0, 0, 100];
  const points = new Float64Array((word.length - 1) / 2);
  for (let k = 0; k < points.length; k += 1) {
    const at = 1 + 2 * k;
    const whole = 64 * LETTERS.indexOf(word[at]) + LETTERS.indexOf(word[at + 1]);
    points[k] = (k % 2 ? y0 : x0) + (side * whole) / COORDINATE_MAX;
  }
  return { points, closed: word[0] === "c" };
}
