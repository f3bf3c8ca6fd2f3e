// Encodes a drawn shape as a word of an address.

import { boxOfPoints } from "../draw/plane-view.js";

const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
// Twelve bits of a coordinate: one in 4,096 of the greater side of the shape's box.
const COORDINATE_MAX = 4095;

/**
 * A shape, simplified to at most `most` points: { word, place }. The word is in letters of base64url: "c" if it is closed or "o", then
 * four letters for each point in the box of the shape; the place is the corner of that box and its greater side.
 */
export function encodeShape(/** @type {Float64Array} */ points, closed, most = 48) {
  const few = simplified(points, closed, most);
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
export function decodeShape(word, place = null) {
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

/**
 * Simplifies an outline to `most` points: removes, one after another, the point with the smallest triangle
 * with its neighbours (Visvalingam and Whyatt 1993). The ends of an open outline are kept.
 */
export function simplified(/** @type {Float64Array} */ points, closed, most) {
  const kept = Array.from({ length: points.length / 2 }, (_, k) => k);
  const area = (a, b, c) =>
    Math.abs(
      (points[2 * b] - points[2 * a]) * (points[2 * c + 1] - points[2 * a + 1]) -
        (points[2 * c] - points[2 * a]) * (points[2 * b + 1] - points[2 * a + 1]),
    );
  // A path of very many points is thinned evenly first: the choice below takes the square of their number.
  while (kept.length > 2000) for (let k = kept.length - 2; k > 0; k -= 2) kept.splice(k, 1);
  const at = (k) => kept[(k + kept.length) % kept.length];
  while (kept.length > Math.max(most, 3)) {
    let [least, which] = [Infinity, -1];
    for (let k = closed ? 0 : 1; k < kept.length - (closed ? 0 : 1); k += 1) {
      const here = area(at(k - 1), kept[k], at(k + 1));
      if (here < least) [least, which] = [here, k];
    }
    kept.splice(which, 1);
  }
  return Float64Array.from(kept.flatMap((k) => [points[2 * k], points[2 * k + 1]]));
}
