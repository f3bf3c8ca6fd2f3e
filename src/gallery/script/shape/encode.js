// Encodes a drawn shape as a word of an address.

import { boxOfPoints } from "../draw/plane-view.js";
import { resampled } from "./outline.js";

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
