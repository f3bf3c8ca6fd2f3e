// The shape indexes of families: in parts, so that a family of any size can be searched in bounded memory.

import { buildIndex, addWindows } from "../../shape/shape-index.js";
import { needPieces } from "../../data/needs.js";

// The number of curves of a part: its index takes up to 4 kB a curve.
const PART_CURVES = 20_000;
// The number of curves whose indexes are kept while the page is open.
const MAX_KEPT_CURVES = 100_000;

// The kept indexes of each family, by the first curve of their parts.
const SHAPE_INDEXES = new WeakMap();

/**
 * The parts of families that are searched, up to `limit` bytes of data and at least one, with the pieces of the
 * table and of the points. The index of a part that is not kept is built for each search.
 * @param {Family[]} families
 */
export function searchedParts(/** @type {Family[]} */ families, limit) {
  const parts = [];
  let [bytes, curves] = [0, 0];
  for (const family of families) {
    let part = null;
    for (const piece of family.outlines.pieces) {
      if (piece.curves === 0) continue;
      const tables = tablesOf(family, piece);
      const added =
        piece.bytes + tables.reduce((sum, { bytes: size }) => sum + size, 0) * tableShare(tables, piece);
      if (parts.length > 0 && bytes + added > limit) return parts;
      bytes += added;
      curves += piece.curves;
      if (!part || part.count + piece.curves > PART_CURVES) {
        part = { family, first: piece.firstCurve, count: 0, pieces: new Set(), isKept: true };
        parts.push(part);
      }
      part.count += piece.curves;
      [piece, ...tables].forEach((one) => part.pieces.add(one));
      part.isKept &&= curves <= MAX_KEPT_CURVES;
    }
  }
  return parts;
}

/** The pieces of the table with the curves of a piece of points. @param {Family} _ @param {Piece} _1 */
function tablesOf({ table }, { firstCurve, curves }) {
  const [first, last] = [table.ofCurve(firstCurve), table.ofCurve(firstCurve + curves - 1)];
  return table.pieces.slice((first?.number ?? 1) - 1, last?.number);
}

/** The share of some pieces of a table that a piece of points takes. */
function tableShare(/** @type {Piece[]} */ tables, /** @type {Piece} */ { curves }) {
  return curves / tables.reduce((sum, table) => sum + table.curves, 0);
}

/** Releases the indexes of families that are not searched as a whole: they would take too much memory. */
export function releaseIndexes(/** @type {SearchedPart[]} */ parts) {
  for (const { family } of parts) SHAPE_INDEXES.delete(family);
}

/** Loads the data of a part; null if they are loaded. @param {SearchedPart} _ */
export function needPart({ family, pieces }) {
  return needPieces(family, pieces);
}

/**
 * The shape index of a part, whose data must be loaded, with windows no shorter than `least` of a curve
 * unless that is null. Null if stopped.
 * @param {SearchedPart} _
 */
export async function shapeIndex({ family, first, count, isKept }, least, stopped) {
  if (!SHAPE_INDEXES.has(family)) SHAPE_INDEXES.set(family, new Map());
  const known = SHAPE_INDEXES.get(family);
  let index = known.get(first);
  if (index?.count !== count) {
    index = await runInSlices(buildIndex(family, first, count), stopped);
    if (!index) return null;
    if (isKept) known.set(first, index);
  }
  if (least !== null) await runInSlices(addWindows(index, least), stopped);
  return stopped() ? null : index;
}

// The length of a slice, in milliseconds.
const SLICE_MS = 12;

/**
 * Runs a generator to its end in slices and returns its value; null as soon as `stopped()` is true. The page
 * handles input between slices.
 */
export async function runInSlices(generator, stopped = () => false) {
  const channel = new MessageChannel();
  const turn = () =>
    new Promise((resume) => {
      channel.port1.onmessage = resume;
      channel.port2.postMessage(null);
    });
  try {
    for (;;) {
      const until = performance.now() + SLICE_MS;
      do {
        const { value, done } = generator.next();
        if (done) return value;
      } while (performance.now() < until);
      await turn();
      if (stopped()) return null;
    }
  } finally {
    channel.port1.close();
  }
}
