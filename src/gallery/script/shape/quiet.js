// The trembling of a hand, and the noise of a measurement, taken out of an outline: they add to the length
// along it, by which outlines are compared.

import { lengthsAlong, resampled } from "./outline.js";

// Even points in which an outline is smoothed, and over how many of them on either side.
const SMOOTHED = 160;
const REACHES = [2, 3, 4, 6, 8];
// What shortens an outline by more than this part of its length was no shape of it.
const SHORTENED = 0.01;

/**
 * An outline without what trembles about it: smoothed ever wider as long as that shortens it, in even points;
 * the outline itself, the very array, if it does not tremble.
 */
export function quieted(points, closed) {
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
 * Even points of an outline, each where the parabola lies that fits best the points within a reach on both
 * sides of it (Savitzky and Golay 1964); at the ends of an open outline those that there are.
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

/** What each of the values at −reach … reach weighs in their best parabola at a place. */
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

function lengthOf(points, closed) {
  return lengthsAlong(points, closed).at(-1);
}
