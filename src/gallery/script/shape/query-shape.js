// Prepares the shape to search for.

import { withoutDuplicates, extentOf, resampled } from "./outline.js";
import { smoothed } from "./smoothing.js";

/**
 * A shape from its points: { closed, points, extent, frame, outline, isNoisy }: `outline` is centred, with an
 * extent of 1, `frame` is the similarity from the given points to it, and `isNoisy` whether it was smoothed.
 * Null if there are fewer than two different points.
 */
export function queryShape(points, closed) {
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
export function resampledShape(shape, count, open = false) {
  if (!(shape.closed && open))
    return { points: resampled(shape.outline, shape.closed, count), closed: shape.closed };
  const round = Float64Array.from([...shape.outline, shape.outline[0], shape.outline[1]]);
  return { points: resampled(round, false, count), closed: false };
}

/**
 * An open shape traversed forth and back: a closed one, like the curve of a circuit that rocks on one path.
 */
export function thereAndBack(shape) {
  const { outline } = shape;
  const back = [];
  for (let k = outline.length - 4; k >= 2; k -= 2) back.push(outline[k], outline[k + 1]);
  return { ...shape, closed: true, outline: Float64Array.from([...outline, ...back]) };
}

function middleOf(points) {
  let [x, y] = [0, 0];
  for (let k = 0; k < points.length; k += 2) {
    x += (2 * points[k]) / points.length;
    y += (2 * points[k + 1]) / points.length;
  }
  return [x, y];
}
