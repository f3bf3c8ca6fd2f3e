// Finds the curves most like a shape, ranked by their deviation from it.

import { curveKey } from "../data/family.js";
import { resampledShape, thereAndBack } from "./query-shape.js";
import { partFit, wholeFit } from "./curve-fit.js";
import { candidateParts } from "./part-search.js";
import { singleCurveIndex } from "./shape-index.js";
import { composed, inverted } from "./similarity.js";
import { candidateCurves } from "./whole-search.js";

// The number of curves compared roughly, of those compared exactly, and of points of the shape for each.
const ROUGH = 320;
const EXACT = 64;
const ROUGH_POINTS = 32;
const EXACT_POINTS = 96;

/**
 * Searches indexes, step by step, for the curves most like a shape, the nearest first. With `part`, portions of
 * curves, no shorter than `least` of them, are searched; with `mirror`, mirror images count as alike; `by` is the
 * deviation to rank by.
 *
 * Deviations are by the extent of the shape, the similarity is from the curve to the given shape, and `from` and
 * `to` are the fractions of the curve's length between which it was compared (`to` beyond 1 continues over the
 * first point; 0 and 1 for a whole curve).
 * @param {ShapeIndex[]} indexes @param {Shape} shape @param {SearchOptions} [options]
 * @returns {Generator<void, Match[]>}
 */
export function* searchByShape(indexes, shape, options = {}) {
  let candidates = [];
  for (const index of indexes) candidates = yield* addCandidates(candidates, index, shape, options);
  return yield* rankCandidates(candidates, shape, options);
}

/**
 * Searches one index, step by step: the generator returns the best candidates among those of other indexes
 * and its own. With `isTransient`, the index can be dropped afterwards.
 * @param {Candidate[]} candidates @param {ShapeIndex} index @param {Shape} shape
 * @param {SearchOptions} options
 */
export function* addCandidates(candidates, index, shape, options, isTransient = false) {
  const { part = false, mirror = true, least = 0.15 } = options;
  const found = yield* part
    ? candidateParts(index, shape, { mirror, least, most: ROUGH })
    : candidateCurves(index, shape, { mirror, most: ROUGH });
  const best = [...candidates, ...found].sort((a, b) => b.value - a.value).slice(0, ROUGH);
  if (!isTransient) return best;
  return best.map((one) =>
    one.index === index ? { ...one, index: singleCurveIndex(index, one.curve), curve: 0 } : one,
  );
}

/**
 * Compares candidates with a shape, step by step; the generator returns what `searchByShape` does.
 * @param {Candidate[]} candidates @param {Shape} shape @param {SearchOptions} _2
 */
export function* rankCandidates(candidates, shape, { part = false, by = "rms" } = {}) {
  const rough = outlinesOf(shape, part, ROUGH_POINTS);
  const chosen = yield* (part ? chooseParts : chooseByRoughFit)(candidates, rough, shape);
  const outlines = outlinesOf(shape, part, EXACT_POINTS);
  const results = [];
  for (const { index, curve, seed } of chosen) {
    const fit = (part ? partFit : wholeFit)(index, curve, outlines, seed, "exact");
    results.push(resultOf(index.family, index.first + curve, shape, fit));
    yield;
  }
  return results.sort((a, b) => a[by] - b[by]);
}

/**
 * Chooses the curves with the best rough fits, each with its best seed, starting where the rough fit starts.
 */
function* chooseByRoughFit(/** @type {Candidate[]} */ candidates, /** @type {QueryOutlines} */ outlines) {
  const fits = [];
  for (const { index, curve, seeds } of candidates) {
    for (const seed of seeds) {
      const { rms, start } = wholeFit(index, curve, outlines, seed, "rough");
      fits.push({ index, curve, rms, seed: { ...seed, start } });
    }
    if (fits.length % 8 < seeds.length) yield;
  }
  return nearestPerCurve(fits, EXACT);
}

/**
 * Chooses the best portions, whose ends are already refined better than by a rough fit. The noise of a shape
 * along a curve affects correlations, but not distances from the curve: for a noisy shape, half of the
 * portions are those with the best rough fits.
 * @param {Candidate[]} candidates @param {QueryOutlines} outlines @param {Shape} _2
 */
function* chooseParts(candidates, outlines, { isNoisy }) {
  const refined = candidates.map(({ index, curve, seeds: [seed] }) => ({ index, curve, seed }));
  if (!isNoisy) return refined.slice(0, EXACT);
  const fits = [];
  for (const { index, curve, seed } of refined.slice(EXACT / 2)) {
    const { rms } = partFit(index, curve, outlines, seed, "rough");
    fits.push({ index, curve, rms, seed });
    if (fits.length % 16 === 0) yield;
  }
  return [...refined.slice(0, EXACT / 2), ...nearestPerCurve(fits, EXACT / 2)];
}

/** A shape in even points; portions of curves are compared as open ones. @returns {QueryOutlines} */
function outlinesOf(/** @type {Shape} */ shape, part, count) {
  const open = resampledShape(shape, count, part);
  return { open, closed: part ? open : resampledShape(shape.closed ? shape : thereAndBack(shape), count) };
}

/** The best fit of each curve, of the `most` curves with the best. */
function nearestPerCurve(fits, most) {
  const found = [];
  const seen = new Set();
  for (const fit of fits.sort((a, b) => a.rms - b.rms)) {
    const name = `${fit.index.family.id}:${fit.index.first + fit.curve}`;
    if (!seen.has(name)) found.push(fit);
    seen.add(name);
    if (found.length === most) break;
  }
  return found;
}

/** @param {Family} family @param {Shape} shape */
function resultOf(family, curve, shape, /** @type {Fit} */ { rms, greatest, similarity, from, to }) {
  return {
    name: `${family.id}:${curveKey(family, curve)}`,
    family,
    curve,
    rms,
    greatest,
    similarity: composed(inverted(shape.frame), similarity),
    from,
    to,
  };
}
