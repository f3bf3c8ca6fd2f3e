// Prepares the shape to search for.

import { withoutDuplicates, extentOf, resampled, lengthOf } from "./outline.js";

/**
 * A shape from its points: `outline` is centred, with an extent of 1, `frame` is the similarity from the given
 * points to it, and `isNoisy` whether it was smoothed. Null if there are fewer than two different points.
 * @param {Float64Array} points @param {boolean} closed
 */
export function queryShape(/** @type {Float64Array} */ points, closed) {
  const given = withoutDuplicates(points, closed);
  const extent = given.length >= 4 ? extentOf(given) : 0;
  if (!(extent > 0)) return null;
  const [x, y] = middleOf(given);
  const frame = { mirror: false, re: 1 / extent, im: 0, x: -x / extent, y: -y / extent };
  const own = given.map((value, k) => (value - (k % 2 ? y : x)) / extent);
  const outline = smoothed(own, closed);
  return { closed, points: given, extent, frame, outline, isNoisy: outline !== own };
}

/** Evenly spaced points of a shape; with `open`, a closed one is cut open at its first point. */
export function resampledShape(/** @type {Shape} */ shape, count, open = false) {
  if (!(shape.closed && open))
    return { points: resampled(shape.outline, shape.closed, count), closed: shape.closed };
  const round = Float64Array.from([...shape.outline, shape.outline[0], shape.outline[1]]);
  return { points: resampled(round, false, count), closed: false };
}

/**
 * An open shape traversed forth and back: a closed one, like the curve of a circuit that rocks on one path.
 */
export function thereAndBack(/** @type {Shape} */ shape) {
  const { outline } = shape;
  const back = [];
  for (let k = outline.length - 4; k >= 2; k -= 2) back.push(outline[k], outline[k + 1]);
  return { ...shape, closed: true, outline: Float64Array.from([...outline, ...back]) };
}

function middleOf(/** @type {Float64Array} */ points) {
  let [x, y] = [0, 0];
  for (let k = 0; k < points.length; k += 2) {
    x += (2 * points[k]) / points.length;
    y += (2 * points[k + 1]) / points.length;
  }
  return [x, y];
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
