// Prepares the shape to search for: a drawn one is smoothed, and has points enough for its form to be seen.

import { withoutDuplicates, extentOf, resampled, lengthOf } from "./outline.js";

// The number of points that are taken as they are, and of those that other shapes get.
const FEWEST_POINTS = 30;
const MOST_POINTS = 200;
const PATH_POINTS = 100;

/**
 * A shape from its points: `points` without repetitions, and the `path` to search for. Null if there are fewer than
 * two different points.
 * @param {Float64Array} points @param {boolean} closed
 */
export function queryShape(/** @type {Float64Array} */ points, closed) {
  const given = withoutDuplicates(points, closed);
  if (given.length < 4 || !(extentOf(given) > 0)) return null;
  const outline = smoothed(given, closed);
  const count = given.length / 2;
  const isPath = outline === given && count >= FEWEST_POINTS && count <= MOST_POINTS;
  return { closed, points: given, path: isPath ? given : resampled(outline, closed, PATH_POINTS) };
}

/** The path of a shape, whether it is closed; as a part of a curve, it is open and ends where it begins. */
export function searchedPath(/** @type {Shape} */ { closed, path }, isPart) {
  if (!isPart || !closed) return { points: path, closed };
  return { points: Float64Array.of(...path, path[0], path[1]), closed: false };
}

// The number of even points of a smoothed outline, and the numbers of points on either side to smooth over.
const SMOOTHED = 160;
const REACHES = [2, 3, 4, 6, 8];
// Smoothing that shortens an outline by less than this part of its length removes no more noise.
const SHORTENED = 0.01;

/**
 * An outline without noise: smoothed more and more widely as long as that shortens it, in even points; the
 * same array if it has no noise.
 */
export function smoothed(/** @type {Float64Array} */ points, closed) {
  const even = resampled(points, closed, SMOOTHED);
  let quiet = points;
  let length = lengthOf(even, closed);
  for (const reach of REACHES) {
    const wider = smoothedOutline(even, closed, reach);
    const shorter = lengthOf(wider, closed);
    if (shorter > (1 - SHORTENED) * length) break;
    [quiet, length] = [wider, shorter];
  }
  return quiet;
}

/**
 * Even points of an outline, each replaced by the value of the parabola that best fits the points within a
 * reach on both sides of it (Savitzky and Golay 1964), or those available at the ends of an open outline.
 */
function smoothedOutline(points, closed, reach) {
  const count = points.length / 2;
  const out = new Float64Array(points.length);
  for (let n = 0; n < count; n += 1) {
    const first = closed ? n - reach : Math.min(Math.max(n - reach, 0), count - 1 - 2 * reach);
    const weights = parabolaWeights(reach, n - first - reach);
    for (let k = 0; k <= 2 * reach; k += 1) {
      const at = 2 * ((((first + k) % count) + count) % count);
      out[2 * n] += weights[k] * points[at];
      out[2 * n + 1] += weights[k] * points[at + 1];
    }
  }
  return out;
}

/** The weights of the values at −reach … reach in the value of their best parabola at a position. */
function parabolaWeights(reach, place) {
  const count = 2 * reach + 1;
  const square = (reach * (reach + 1)) / 3;
  let fourth = 0;
  for (let k = -reach; k <= reach; k += 1) fourth += (k * k - square) ** 2;
  return Float64Array.from({ length: count }, (_, n) => {
    const k = n - reach;
    return (
      1 / count + (k * place) / (count * square) + ((k * k - square) * (place * place - square)) / fourth
    );
  });
}
