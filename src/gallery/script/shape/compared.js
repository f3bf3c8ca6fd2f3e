// A curve of an index beside a shape: as a whole, or a portion of it.

import { curvePoints } from "../data/family.js";
import { closestFit } from "./fit.js";
import { KEPT } from "./indexing.js";
import { cleaned, mirroredOutline, portion, resampled, reversedOutline } from "./outline.js";
import { composed } from "./similarity.js";

// How exactly a curve is compared: its points, those of a portion, the rounds of fitting, and their reach
// along the curve.
const CARE = {
  rough: { points: 64, piece: 48, rounds: 2, reach: 0.08 },
  exact: { points: 192, piece: 128, rounds: 5, reach: 0.05 },
};
// What a portion is continued by at its ends, by its own length, so that its ends can be found.
const MARGIN = 0.15;

/**
 * Fits a whole curve to a shape, beginning with a seed { mirror, reversed, start }: { rms, greatest,
 * similarity: from the curve's own plane to the shape's outline, from, to, start: in the way it is passed }.
 */
export function wholeFit(index, curve, asked, seed, care) {
  const closed = index.closed[curve] === 1;
  const { points: count, rounds, reach } = CARE[care];
  const even = resampled(outlineOf(index, curve, care), closed, count);
  const seen = passed(even, seed, closed);
  const span = closed ? count : count - 1;
  const fit = closestFit(closed ? asked.closed : asked.open, seen, {
    start: seed.start * count,
    span,
    whole: true,
    rounds,
    reach,
  });
  const { rms, greatest, similarity } = fit;
  return {
    rms,
    greatest,
    similarity: composed(similarity, seen.frame),
    from: 0,
    to: 1,
    start: closed ? fit.start / count : 0,
  };
}

/**
 * Fits a portion of a curve to a shape, likewise; the seed has a `span`, and `start` is in the curve's own
 * direction.
 */
export function partFit(index, curve, asked, seed, care) {
  const closed = index.closed[curve] === 1;
  const { piece: count, rounds, reach } = CARE[care];
  const { start, span } = seed;
  const margin = MARGIN * span;
  const piece = portion(outlineOf(index, curve, care), closed, start - margin, start + span + margin, count);
  const seen = passed(piece.points, seed, false);
  const share = (count - 1) / (piece.to - piece.from);
  const before = seed.reversed ? piece.to - start - span : start - piece.from;
  const given = { start: before * share, span: span * share, whole: false, rounds, reach };
  const fit = closestFit(asked.open, seen, given);
  const [near, far] = seed.reversed
    ? [piece.to - fit.to / share, piece.to - fit.from / share]
    : [piece.from + fit.from / share, piece.from + fit.to / share];
  const { rms, greatest, similarity } = fit;
  const turns = Math.floor(near);
  return { rms, greatest, similarity: composed(similarity, seen.frame), from: near - turns, to: far - turns };
}

/**
 * The points of a curve: those that the index keeps, in units of its own, for a rough look, and its own for
 * an exact one.
 */
function outlineOf(index, curve, care) {
  if (care === "rough") return index.kept.subarray(2 * KEPT * curve, 2 * KEPT * (curve + 1));
  return cleaned(curvePoints(index.family, curve), index.closed[curve] === 1);
}

/**
 * A curve as it is passed, about its middle and with a size of 1: { points, closed, frame }, the frame from
 * its own plane.
 */
function passed(points, { mirror, reversed }, closed) {
  const [x0, y0, x1, y1] = boxOf(points);
  const scale = 1 / (Math.hypot(x1 - x0, y1 - y0) || 1);
  const [x, y] = [(x0 + x1) / 2, (y0 + y1) / 2];
  const own = Float64Array.from(points, (value, k) => scale * (value - (k % 2 ? y : x)));
  const seen = mirror ? mirroredOutline(own) : own;
  return {
    points: reversed ? reversedOutline(seen, closed) : seen,
    closed,
    frame: { mirror, re: scale, im: 0, x: -scale * x, y: mirror ? scale * y : -scale * y },
  };
}

function boxOf(points) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < points.length; k += 2) {
    box[0] = Math.min(box[0], points[k]);
    box[1] = Math.min(box[1], points[k + 1]);
    box[2] = Math.max(box[2], points[k]);
    box[3] = Math.max(box[3], points[k + 1]);
  }
  return box;
}
