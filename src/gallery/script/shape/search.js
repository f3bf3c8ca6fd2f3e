// The curves most like a shape, ranked by how far they truly are from it.

import { curveKey } from "../data/family.js";
import { evenShape, thereAndBack } from "./asked.js";
import { partFit, wholeFit } from "./compared.js";
import { likelyParts } from "./part.js";
import { composed, inverted } from "./similarity.js";
import { likelyWhole } from "./whole.js";

// Curves that are compared roughly, those of them that are compared exactly, and the points of the shape for
// each.
const ROUGH = 320;
const EXACT = 64;
const ROUGH_POINTS = 32;
const EXACT_POINTS = 96;

/**
 * Searches indexes, step by step, for the curves most like a shape. `part`: a portion of a curve, no shorter
 * than `least` of it, may be like the shape; `mirror`: mirror images count as alike; `by`: "rms" or
 * "greatest", the deviation that ranks.
 *
 * The generator's value is [{ name, family, curve, rms, greatest, similarity, from, to }], the nearest first:
 * deviations by the extent of the shape, the similarity from the curve to the shape as it was given, and
 * between which fractions of the curve's length it was compared (`to` beyond 1 goes on round the first point;
 * 0 and 1 for a whole curve).
 */
export function* searching(indexes, shape, { part = false, mirror = true, least = 0.15, by = "rms" } = {}) {
  const likely = [];
  for (const index of indexes) {
    const found = yield* part
      ? likelyParts(index, shape, { mirror, least, most: ROUGH })
      : likelyWhole(index, shape, { mirror, most: ROUGH });
    likely.push(...found);
  }
  likely.sort((a, b) => b.value - a.value);
  const rough = outlinesOf(shape, part, ROUGH_POINTS);
  const chosen = yield* (part ? chosenParts : roughlyCompared)(likely.slice(0, ROUGH), rough, shape);
  const outlines = outlinesOf(shape, part, EXACT_POINTS);
  const results = [];
  for (const { index, curve, seed } of chosen) {
    const fit = (part ? partFit : wholeFit)(index, curve, outlines, seed, "exact");
    results.push(resultOf(index.family, curve, shape, fit));
    yield;
  }
  return results.sort((a, b) => a[by] - b[by]);
}

/**
 * The likeliest curves by rough comparisons, each with its best seed, begun where the comparison found it to
 * begin.
 */
function* roughlyCompared(likely, outlines) {
  const fits = [];
  for (const { index, curve, seeds } of likely) {
    for (const seed of seeds) {
      const { rms, start } = wholeFit(index, curve, outlines, seed, "rough");
      fits.push({ index, curve, rms, seed: { ...seed, start } });
    }
    if (fits.length % 8 < seeds.length) yield;
  }
  return nearestOnce(fits, EXACT);
}

/**
 * The likeliest portions: their places are settled already, better than a rough comparison would. What a
 * trembling shape's noise does along a curve spoils likeness, though, but not distances from the curve: half
 * of them are those that a rough comparison brings nearest.
 */
function* chosenParts(likely, outlines, { trembles }) {
  const settled = likely.map(({ index, curve, seeds: [seed] }) => ({ index, curve, seed }));
  if (!trembles) return settled.slice(0, EXACT);
  const fits = [];
  for (const { index, curve, seed } of settled.slice(EXACT / 2)) {
    const { rms } = partFit(index, curve, outlines, seed, "rough");
    fits.push({ index, curve, rms, seed });
    if (fits.length % 16 === 0) yield;
  }
  return [...settled.slice(0, EXACT / 2), ...nearestOnce(fits, EXACT / 2)];
}

/** A shape in even points, as it is compared with closed curves and with open ones. */
function outlinesOf(shape, part, count) {
  if (part) return { open: evenShape(shape, count, true) };
  return {
    open: evenShape(shape, count),
    closed: evenShape(shape.closed ? shape : thereAndBack(shape), count),
  };
}

/** The best fit of each curve, of the `most` curves with the best. */
function nearestOnce(fits, most) {
  const found = [];
  const seen = new Set();
  for (const fit of fits.sort((a, b) => a.rms - b.rms)) {
    const name = `${fit.index.family.id}:${fit.curve}`;
    if (!seen.has(name)) found.push(fit);
    seen.add(name);
    if (found.length === most) break;
  }
  return found;
}

function resultOf(family, curve, shape, { rms, greatest, similarity, from, to }) {
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
