// Computes the deviation between two outlines in place.

import { extentOf, resampled } from "./outline.js";

const COMPARED_POINTS = 160;

/**
 * The root mean square and the greatest of the distances from evenly spaced points of each of two outlines, {
 * points, closed }, to the other, by the extent of the first: { rms, greatest }.
 */
export function deviationBetween(first, second) {
  const one = distancesTo(second, resampled(first.points, first.closed, COMPARED_POINTS));
  const other = distancesTo(first, resampled(second.points, second.closed, COMPARED_POINTS));
  const extent = extentOf(first.points) || 1;
  return {
    rms: Math.sqrt((one.mean + other.mean) / 2) / extent,
    greatest: Math.sqrt(Math.max(one.most, other.most)) / extent,
  };
}

function distancesTo({ points, closed }, places) {
  const count = points.length / 2;
  let [mean, most] = [0, 0];
  for (let p = 0; p < places.length; p += 2) {
    let least = Infinity;
    for (let k = 0; k < count - (closed ? 0 : 1); k += 1) {
      const [a, b] = [2 * k, 2 * ((k + 1) % count)];
      const [dx, dy] = [points[b] - points[a], points[b + 1] - points[a + 1]];
      const [u, v] = [places[p] - points[a], places[p + 1] - points[a + 1]];
      const size = dx * dx + dy * dy;
      const t = size > 0 ? Math.min(Math.max((u * dx + v * dy) / size, 0), 1) : 0;
      least = Math.min(least, (u - t * dx) ** 2 + (v - t * dy) ** 2);
    }
    mean += (2 * least) / places.length;
    most = Math.max(most, least);
  }
  return { mean, most };
}
