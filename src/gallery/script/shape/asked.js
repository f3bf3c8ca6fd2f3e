// The shape that is asked for, made ready to be compared.

import { cleaned, extentOf, resampled } from "./outline.js";
import { quieted } from "./quiet.js";

/**
 * A shape from its points: { closed, points, extent, frame, outline, trembles }: `outline` lies about its
 * middle with an extent of 1, `frame` is the similarity from the points as given to it, and `trembles` says
 * whether it had to be smoothed. Null where there are not two different points.
 */
export function askedShape(points, closed) {
  const given = cleaned(points, closed);
  const extent = given.length >= 4 ? extentOf(given) : 0;
  if (!(extent > 0)) return null;
  const [x, y] = middleOf(given);
  const frame = { mirror: false, re: 1 / extent, im: 0, x: -x / extent, y: -y / extent };
  const own = given.map((value, k) => (value - (k % 2 ? y : x)) / extent);
  const outline = quieted(own, closed);
  return { closed, points: given, extent, frame, outline, trembles: outline !== own };
}

/** The even points of a shape; `open`: also of a closed one from its first point round to it again. */
export function evenShape(shape, count, open = false) {
  if (!(shape.closed && open))
    return { points: resampled(shape.outline, shape.closed, count), closed: shape.closed };
  const round = Float64Array.from([...shape.outline, shape.outline[0], shape.outline[1]]);
  return { points: resampled(round, false, count), closed: false };
}

/** An open shape gone there and back: a closed one, as a linkage draws it that rocks along one path. */
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
