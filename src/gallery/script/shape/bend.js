// Changes of a shape by handles on it: a handle moves the points near it, or takes them away.

import { pointPairs } from "../draw/plane-view.js";
import { resampled } from "./outline.js";

// A shape of more points is changed by so many handles, each of which moves the points up to the next two.
const MOST_HANDLES = 12;
const POINTS_PER_HANDLE = 8;
const BEND_REACH = 12;

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
