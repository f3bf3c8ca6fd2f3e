// Aligns curves with the first of them.

import { curveOutline } from "../../data/family.js";
import { boxOfPoints, transformed } from "../../draw/plane-view.js";
import { bestFit, deviationInPlace } from "../../kernel/shape-search.js";
import { parseCurveName } from "../../data/address.js";
import { holdPieces, needCurveWithKey, needCurves, piecesOfCurves } from "../../data/needs.js";
import { familyOfCell } from "../../data/reader.js";

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

/**
 * The curve with a name, "evans:12.1.1" or "evans:12.1.1?p=2.5", or a sentence that says why there is none. Its
 * data are kept until `release()`.
 * @param {App} app @param {string} name @returns {Promise<ComparedCurve | { name: string, reason: string }>}
 */
export async function loadComparedCurve(app, name) {
  try {
    const { key, changes, ...named } = parseCurveName(name) ?? { family: name, key: "", changes: new Map() };
    const family = await app.atlas.family(named.family);
    const curve = await needCurveWithKey(family, key);
    if (curve === undefined) return { name, reason: "not in this atlas" };
    await needCurves(family, [curve]);
    if (changes.size > 0) {
      const kernel = await app.kernel.load();
      const changed = changedFamily(kernel, { family, curve, changes });
      return { name, ...changed, curve: 0, key, changes, release: () => {} };
    }
    return { name, family, curve, key, changes, release: holdPieces(piecesOfCurves(family, [curve])) };
  } catch (error) {
    return { name, reason: error.message };
  }
}

/**
 * A family that contains only a curve with changed parameters, so that it can be drawn, aligned and described like the
 * curves of the atlas: { family, requested, shown }.
 *
 * @throws {Error} a sentence that says why it cannot be assembled
 * @param {Kernel} kernel @param {CurveOfFamily & { changes: Map<string, number> }} _1
 */
function changedFamily(kernel, { family, curve, changes }) {
  const parameters = new Map(changes);
  // The number of a circuit among all, unless it is a parameter.
  const number = family.names.includes("circuit") ? undefined : parameters.get("circuit");
  if (number !== undefined) parameters.delete("circuit");
  const requested = kernel.curve(family, curve, parameters);
  const data = kernel.curveData(kernel.curve(family, curve, changes));
  return { family: familyOfCell(data, family), requested, shown: number === undefined ? null : number - 1 };
}
