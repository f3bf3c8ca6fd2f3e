// The indexes of the curves of families, in the kernel: in parts, so that a family of any size can be searched in bounded memory.

import { givenCurves } from "../../data/family.js";
import { needPieces } from "../../data/needs.js";
import { sumOf } from "../../data/number.js";

// The number of curves of a part, 60 bytes each.
const PART_CURVES = 20_000;
// The number of curves whose indexes are kept while the page is open.
const MAX_KEPT_CURVES = 100_000;
// The number of curves that are added in a step.
const CURVES_PER_CALL = 128;

/**
 * The kept indexes of each instance of the kernel, by family and the first curve of their parts.
 * @type {WeakMap<object, Map<Family, Map<number, ShapeIndex>>>}
 */
const KEPT_INDEXES = new WeakMap();

/**
 * The parts of families that are searched, up to `limit` bytes of data and at least one, with the pieces of their points. The index of a part
 * that is not kept is built for each search.
 * @param {Family[]} families
 */
export function searchedParts(/** @type {Family[]} */ families, /** @type {number} */ limit) {
  /** @type {SearchedPart[]} */ const parts = [];
  let [bytes, curves] = [0, 0];
  for (const family of families) {
    /** @type {SearchedPart | null} */ let part = null;
    for (const piece of family.outlines.pieces) {
      if (piece.curves === 0) continue;
      bytes += piece.bytes;
      if (parts.length > 0 && bytes > limit) return parts;
      curves += piece.curves;
      if (!part || part.count + piece.curves > PART_CURVES) {
        part = { family, first: piece.firstCurve, count: 0, pieces: [], isKept: true };
        parts.push(part);
      }
      part.count += piece.curves;
      part.pieces.push(piece);
      part.isKept &&= curves <= MAX_KEPT_CURVES;
    }
  }
  return parts;
}

/** How much of what is listed is searched. @param {ListedFamily[]} listed @param {{ count: number }[]} parts @returns {LoadState} */
export function loadStateOf(listed, parts) {
  const [curves, total] = [sumOf(parts, ({ count }) => count), sumOf(listed, (one) => one.curves)];
  // A small family has everything in its head.
  const bytes = sumOf(listed, (one) => one.bytes - one.table_bytes || one.bytes);
  return { done: true, curves, total, bytes };
}

/**
 * The index of the curves of a part, whose data are loaded for it; null if stopped. One that is not kept is released by `releaseIndex`.
 * @param {SearchKernel} kernel @param {SearchedPart} _ @param {AbortSignal} signal @returns {Promise<ShapeIndex | null>}
 */
export async function shapeIndex(kernel, { family, first, count, pieces, isKept }, signal) {
  const known = keptIndexes(kernel, family);
  const kept = known.get(first);
  if (kept?.count === count) return kept;
  if (kept) await releaseIndex(kernel, kept);
  const { instance } = kernel;
  const { curves } = await kernel.call({ method: "open_curves", count });
  const index = { family, first, count, curves };
  let isComplete = false;
  let room;
  try {
    for (const piece of pieces) {
      await needPieces(family, [piece]);
      const end = piece.firstCurve + piece.curves;
      for (let from = piece.firstCurve; from < end; from += CURVES_PER_CALL) {
        if (signal.aborted) return null;
        const added = Array.from({ length: Math.min(CURVES_PER_CALL, end - from) }, (_, k) => from + k);
        const request = { method: "add_curves", curves, ...givenCurves(family, added, room) };
        const { points = request.points } = await kernel.call(request, "points");
        room = points.buffer;
      }
    }
    isComplete = kernel.instance === instance;
  } finally {
    if (!isComplete && kernel.instance === instance) await releaseIndex(kernel, index);
  }
  if (isKept) known.set(first, index);
  return index;
}

/** @returns {Map<number, ShapeIndex>} */
function keptIndexes(/** @type {SearchKernel} */ { instance }, /** @type {Family} */ family) {
  const families = KEPT_INDEXES.get(instance) ?? new Map();
  KEPT_INDEXES.set(instance, families);
  const known = families.get(family) ?? new Map();
  families.set(family, known);
  return known;
}

/** Releases an index. @param {SearchKernel} kernel @param {ShapeIndex} _ */
export function releaseIndex(kernel, { curves }) {
  return kernel.call({ method: "close_curves", curves });
}

/**
 * Releases the indexes of families that are not searched as a whole: they would take too much memory.
 * @param {SearchKernel} kernel @param {SearchedPart[]} parts
 */
export async function releaseIndexes(kernel, parts) {
  for (const { family } of parts) {
    const known = keptIndexes(kernel, family);
    for (const index of known.values()) await releaseIndex(kernel, index);
    known.clear();
  }
}
