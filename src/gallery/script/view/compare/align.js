// Aligns curves with the first of them.

import { curvePoints } from "../../data/family.js";
import { boxOfPoints } from "../../draw/plane-view.js";
import { queryShape } from "../../shape/query-shape.js";
import { buildIndex } from "../../shape/shape-index.js";
import { deviationBetween } from "../../shape/deviation.js";
import { searchByShape } from "../../shape/search.js";
import { identity, transformed } from "../../shape/similarity.js";

/** The maximum number of curves compared. */
export const MAX_COMPARED = 12;
/** How curves are aligned: { name: label }. */
export const ALIGNMENTS = {
  none: "none",
  place: "centred",
  size: "centred and scaled",
  similar: "best fit",
  mirrored: "best fit with mirroring",
};

/** Parses a query: { names or null, view: "side" | "over", align }. @param {Query} query */
export function parseComparisonQuery(query) {
  const names = query.get("c");
  const align = query.get("align") ?? "";
  return {
    names: names ? names.split(",").filter((name) => name.includes(":")) : null,
    view: query.get("view") === "over" ? "over" : "side",
    align: align in ALIGNMENTS ? align : "similar",
  };
}

/** The inverse of parseComparisonQuery. */
export function formatComparisonQuery(/** @type {ComparisonQuery} */ { view, align }, names) {
  return {
    c: names.join(","),
    view: view === "over" ? "over" : null,
    align: align === "similar" ? null : align,
  };
}

/**
 * Aligns a curve with the first; deviations are relative to the extent of the first. `align` is a key of
 * ALIGNMENTS; the best fit is that of the search by shape.
 * @param {CurveOfFamily} first @param {CurveOfFamily} one
 */
export function alignCurve(/** @type {CurveOfFamily} */ first, /** @type {CurveOfFamily} */ one, align) {
  const closed = one.family.curves.closed[one.curve] === 1;
  const own = curvePoints(one.family, one.curve);
  const base = curvePoints(first.family, first.curve);
  const baseClosed = first.family.curves.closed[first.curve] === 1;
  if (align === "similar" || align === "mirrored") {
    const shape = queryShape(base, baseClosed);
    const found = shape && compareWithShape(shape, one, align === "mirrored");
    if (found) {
      const { similarity, rms, greatest } = found;
      return { points: transformed(similarity, own), closed, similarity, rms, greatest };
    }
  }
  const similarity = boxAlignment(base, own, align);
  const points = transformed(similarity, own);
  const deviation = deviationBetween({ points: base, closed: baseClosed }, { points, closed });
  return { points, closed, similarity, ...deviation };
}

/**
 * Compares one curve with a shape, as the search by shape does.
 * @param {Shape} shape @param {CurveOfFamily} _1
 */
function compareWithShape(shape, { family, curve }, mirror) {
  const index = runToEnd(buildIndex(family, curve, 1));
  return runToEnd(searchByShape([index], shape, { mirror }))[0];
}

function runToEnd(generator) {
  for (;;) {
    const { value, done } = generator.next();
    if (done) return value;
  }
}

/** The similarity that matches the centres of the bounding boxes and, for "size", their diagonals. */
function boxAlignment(base, own, align) {
  if (align === "none") return identity();
  const [a, b] = [middleAndSize(base), middleAndSize(own)];
  const scale = align === "size" && b.size > 0 ? a.size / b.size : 1;
  return { mirror: false, re: scale, im: 0, x: a.x - scale * b.x, y: a.y - scale * b.y };
}

function middleAndSize(/** @type {Points} */ points) {
  const [x0, y0, x1, y1] = boxOfPoints(points);
  return { x: (x0 + x1) / 2, y: (y0 + y1) / 2, size: Math.hypot(x1 - x0, y1 - y0) };
}
