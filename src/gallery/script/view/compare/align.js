// Aligns curves with the first of them.

import { curveOutline } from "../../data/family.js";
import { boxOfPoints, transformed } from "../../draw/plane-view.js";
import { bestFit, deviationInPlace } from "../../kernel/shape-search.js";

/** The maximum number of curves compared. */
export const MAX_COMPARED = 12;
/** How curves are aligned: { name: label }. @type {Record<string, string>} */
export const ALIGNMENTS = {
  none: "none",
  place: "centred",
  size: "centred and scaled",
  similar: "best fit",
  mirrored: "best fit with mirroring",
};

/** Parses a query: { names or null, view: "side" | "over", align }. @param {AddressQuery} query */
export function parseComparisonQuery(query) {
  return {
    names: query.list("c", (name) => name.includes(":")) ?? null,
    view: query.word("view", ["side", "over"]) ?? "side",
    align: query.word("align", Object.keys(ALIGNMENTS)) ?? "similar",
  };
}

/** The inverse of parseComparisonQuery. */
export function formatComparisonQuery(/** @type {ComparisonQuery} */ { names, view, align }) {
  return {
    c: names?.join(","),
    view: view === "over" ? "over" : null,
    align: align === "similar" ? null : align,
  };
}

/**
 * Aligns a curve with the first; `fit` has the deviation of the first from it, relative to the size of the first, and is null without the
 * kernel. `align` is a key of ALIGNMENTS; the best fit is that of the search by shape, and without one the curve is centred.
 * @param {Kernel | null} kernel @param {CurveOfFamily} first @param {CurveOfFamily} one
 */
export function alignCurve(kernel, first, one, /** @type {string} */ align) {
  const [base, own] = [first, one].map(({ family, curve }) => curveOutline(family, curve));
  const isFitted = kernel && (align === "similar" || align === "mirrored");
  const found = isFitted ? bestFit(kernel, base, own, align === "mirrored") : null;
  const similarity = found?.similarity ?? boxAlignment(base.points, own.points, align);
  const { closed } = own;
  const points = transformed(similarity, own.points);
  const fit = found ?? (kernel && deviationInPlace(kernel, base, { points, closed }));
  return { points, closed, similarity, fit };
}

/** The similarity that matches the centres of the bounding boxes and, for "size", their diagonals. */
function boxAlignment(/** @type {Points} */ base, /** @type {Points} */ own, /** @type {string} */ align) {
  if (align === "none") return { mirror: false, re: 1, im: 0, x: 0, y: 0 };
  const [a, b] = [middleAndSize(base), middleAndSize(own)];
  const scale = align === "size" && b.size > 0 ? a.size / b.size : 1;
  return { mirror: false, re: scale, im: 0, x: a.x - scale * b.x, y: a.y - scale * b.y };
}

function middleAndSize(/** @type {Points} */ points) {
  const [x0, y0, x1, y1] = boxOfPoints(points);
  return { x: (x0 + x1) / 2, y: (y0 + y1) / 2, size: Math.hypot(x1 - x0, y1 - y0) };
}
