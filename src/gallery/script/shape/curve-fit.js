// Fits a curve of an index to a shape: the whole curve, or a portion of it.

import { boxOfPoints } from "../draw/plane-view.js";
import { closestFit } from "./fit.js";
import { INDEX_POINTS, pointsOf } from "./shape-index.js";
import { withoutDuplicates, mirroredOutline, portion, resampled, reversedOutline } from "./outline.js";
import { composed } from "./similarity.js";

// Settings of a comparison: the points of a curve and of a portion, the rounds of fitting, and how far along
// the curve nearest points are searched.
const PRECISION = {
  rough: { points: 64, piece: 48, rounds: 2, reach: 0.08 },
  exact: { points: 192, piece: 128, rounds: 5, reach: 0.05 },
};
// A portion is extended at both ends by this part of its length, so that its ends can move.
const MARGIN = 0.15;

/**
 * Fits a whole curve to a shape, starting from a seed: the similarity maps the curve's plane to the shape's
 * outline; `start` is in the direction of the seed.
 * @param {ShapeIndex} index @param {number} curve @param {QueryOutlines} query @param {Seed} seed
 * @returns {Fit & { start: number }}
 */
export function wholeFit(index, curve, query, seed, care) {
  const closed = index.closed[curve] === 1;
  const { points: count, rounds, reach } = PRECISION[care];
  const even = resampled(outlineOf(index, curve, care), closed, count);
  const seen = orientedCurve(even, seed, closed);
  const span = closed ? count : count - 1;
  const fit = closestFit(closed ? query.closed : query.open, seen, {
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
 * Fits a portion of a curve to a shape; the seed also has a `span`, and `start` is in the curve's own
 * direction.
 * @param {ShapeIndex} index @param {QueryOutlines} query @param {Seed} seed
 */
export function partFit(index, curve, query, seed, care) {
  const closed = index.closed[curve] === 1;
  const { piece: count, rounds, reach } = PRECISION[care];
  const { start, span = 1 } = seed;
  const margin = MARGIN * span;
  const piece = portion(outlineOf(index, curve, care), closed, start - margin, start + span + margin, count);
  const seen = orientedCurve(piece.points, seed, false);
  const share = (count - 1) / (piece.to - piece.from);
  const before = seed.reversed ? piece.to - start - span : start - piece.from;
  const given = { start: before * share, span: span * share, whole: false, rounds, reach };
  const fit = closestFit(query.open, seen, given);
  const [near, far] = seed.reversed
    ? [piece.to - fit.to / share, piece.to - fit.from / share]
    : [piece.from + fit.from / share, piece.from + fit.to / share];
  const { rms, greatest, similarity } = fit;
  const turns = Math.floor(near);
  return { rms, greatest, similarity: composed(similarity, seen.frame), from: near - turns, to: far - turns };
}

/**
 * The points of a curve: those stored in the index, in its units, for a rough comparison, and the original
 * ones for an exact one.
 */
function outlineOf(/** @type {ShapeIndex} */ index, curve, care) {
  if (care === "rough") return index.kept.subarray(2 * INDEX_POINTS * curve, 2 * INDEX_POINTS * (curve + 1));
  return withoutDuplicates(pointsOf(index, curve), index.closed[curve] === 1);
}

/**
 * A curve in the direction and orientation of a seed, centred, with a size of 1; the frame is the similarity from
 * its own plane.
 */
function orientedCurve(/** @type {Float64Array} */ points, /** @type {Seed} */ { mirror, reversed }, closed) {
  const [x0, y0, x1, y1] = boxOfPoints(points);
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
