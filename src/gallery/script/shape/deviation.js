// Computes the deviation between two outlines in place.

import { extentOf, resampled } from "./outline.js";

const COMPARED_POINTS = 160;

/**
 * The root mean square and the greatest of the distances from evenly spaced points of each of two outlines to
 * the other, by the extent of the first.
 * @param {Outline} first @param {Outline} second
 */
export function deviationBetween(/** @type {Outline} */ first, /** @type {Outline} */ second) {
  const one = distancesTo(second, resampled(first.points, first.closed, COMPARED_POINTS));
  const other = distancesTo(first, resampled(second.points, second.closed, COMPARED_POINTS));
  const extent = extentOf(first.points) || 1;
  return {
    rms: Math.sqrt((one.mean + other.mean) / 2) / extent,
    greatest: Math.sqrt(Math.max(one.most, other.most)) / extent,
  };
}

function distancesTo(/** @type {Outline} */ outline, places) {
  let [mean, most] = [0, 0];
  for (let p = 0; p < places.length; p += 2) {
    const least = squaredDistance(outline, places[p], places[p + 1]);
    mean += (2 * least) / places.length;
    most = Math.max(most, least);
  }
  return { mean, most };
}

/** The square of the distance of a point from an outline; infinite if it has no points. */
export function squaredDistance(/** @type {Outline} */ { points, closed }, x, y) {
  const n = points.length;
  let least = n === 2 ? (x - points[0]) ** 2 + (y - points[1]) ** 2 : Infinity;
  for (let b = closed ? 0 : 2; b < n; b += 2) {
    const a = b === 0 ? n - 2 : b - 2;
    const [dx, dy] = [points[b] - points[a], points[b + 1] - points[a + 1]];
    const [u, v] = [x - points[a], y - points[a + 1]];
    const size = dx * dx + dy * dy;
    const t = size > 0 ? Math.min(Math.max((u * dx + v * dy) / size, 0), 1) : 0;
    least = Math.min(least, (u - t * dx) ** 2 + (v - t * dy) ** 2);
  }
  return least;
}
