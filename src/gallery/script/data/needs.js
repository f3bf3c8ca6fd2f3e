// What a view needs of a family's data, loaded in pieces.
//
// Each function returns null if everything is loaded, otherwise a promise: a view that has its data is shown
// at once, without waiting for a turn of the event loop.

import { cellNumbersOnPage, findCurve, parseCurveKey } from "./family.js";

// From more pieces than this, a thumbnail is not drawn from the data.
const SCATTERED_PIECES = 3;

/** Whether all data of a family are loaded. @param {Family} _ */
export function isFullyLoaded({ table, outlines }) {
  return [...table.pieces, ...outlines.pieces].every(({ data }) => data !== null);
}

/** Loads pieces, given as a list that may have gaps and repetitions. */
export function needPieces(/** @type {Family} */ family, /** @type {Iterable<Piece | undefined>} */ pieces) {
  const requested = [...new Set(pieces)].filter((piece) => piece !== undefined);
  const missing = requested.filter(({ data }) => data === null);
  for (const piece of requested) if (piece.data !== null) family.used(piece);
  return missing.length ? Promise.all(missing.map((piece) => family.load(piece))) : null;
}

/** The pieces with the table rows, the captions and the points of curves. */
export function piecesOfCurves(/** @type {Family} */ { table, outlines }, /** @type {number[]} */ curves) {
  const pieces = curves.flatMap((curve) => [table.ofCurve(curve), outlines.ofCurve(curve)]);
  return pieces.filter((piece) => piece !== undefined);
}

/** Loads curves: their rows of the table, their captions and their points. */
export function needCurves(/** @type {Family} */ family, /** @type {number[]} */ curves) {
  return needPieces(family, piecesOfCurves(family, curves));
}

/**
 * Loads the curve with a key, its neighbours' rows of the table, and the page that it is on if that follows
 * from its cell; resolves to its index, or undefined if there is none.
 */
export async function needCurveWithKey(/** @type {Family} */ family, /** @type {string | undefined} */ key) {
  const [number] = parseCurveKey(key) ?? [];
  if (number === undefined) return undefined;
  const { table, outlines, panels, pageCount } = family;
  await needPieces(family, [table.ofNumber(number)]);
  const curve = findCurve(family, key);
  if (curve === undefined) return undefined;
  const neighbours = [curve - 1, curve + 1].map((other) => table.ofCurve(other));
  const page = panels ? Math.floor(family.curves.cell[curve] / panels) + 1 : 0;
  const ofPage = page <= pageCount ? outlines.ofPage(page) : undefined;
  await needPieces(family, [...piecesOfCurves(family, [curve]), ...neighbours, ofPage]);
  return curve;
}

/** The indices of the cells of a page that follow from the number of panels: from the first to before the last. @param {number} page */
export function panelCells(/** @type {Family} */ { layout, panels, pageCount, cells: { count } }, page) {
  const each = panels ?? (layout === "panels" && pageCount === 1 ? count : 0);
  return [Math.min((page - 1) * each, count), Math.min(page * each, count)];
}

/**
 * Whether the curves of a page may be in any of many pieces, since its pages are in another order than its
 * cells: only the page itself needs them then, not its thumbnail.
 */
export function isScattered(/** @type {Family} */ { layout, panels, outlines, pageCount }) {
  return layout === "panels" && panels === null && pageCount > 1 && outlines.pieces.length > SCATTERED_PIECES;
}

/** Loads a page: its layout, and its cells and curves. @param {Family} family @returns {Promise<unknown> | null} */
export function needPage(family, /** @type {number} */ page) {
  const layout = needPieces(family, [family.outlines.ofPage(page)]);
  return layout ? layout.then(() => needPage(family, page)) : needPieces(family, piecesOfPage(family, page));
}

/** Loads a page and keeps its data, which may be in many pieces, until the function that it resolves to is called. */
export async function loadPage(/** @type {Family} */ family, /** @type {number} */ page) {
  await needPieces(family, [family.outlines.ofPage(page)]);
  const release = holdPieces(piecesOfPage(family, page));
  try {
    await needPage(family, page);
  } catch (error) {
    release();
    throw error;
  }
  return release;
}

/** The pieces that a page takes its cells and curves from; its layout must be loaded. */
function piecesOfPage(/** @type {Family} */ family, /** @type {number} */ page) {
  const { table, outlines } = family;
  const [first, end] = panelCells(family, page);
  const numbers = cellNumbersOnPage(family, page);
  const range = (/** @type {Series} */ series) =>
    series.pieces.slice((series.ofCell(first)?.number ?? 1) - 1, series.ofCell(end - 1)?.number);
  const piecesOf = (/** @type {Series} */ series) => [
    ...(first < end ? range(series) : []),
    ...numbers.map((number) => series.ofNumber(number)),
  ];
  const pieces = [outlines.ofPage(page), ...piecesOf(table), ...piecesOf(outlines)];
  return [...new Set(pieces)].filter((piece) => piece !== undefined);
}

/** Keeps loaded pieces from being dropped until the function that it returns is called. */
export function holdPieces(/** @type {Piece[]} */ pieces) {
  for (const piece of pieces) piece.holds += 1;
  return () => {
    for (const piece of pieces.splice(0)) piece.holds -= 1;
  };
}

/**
 * Calls `act` when a need is met: at once, or when its promise resolves; `failed(message)` if it cannot be.
 * @param {Promise<unknown> | null} need @param {() => unknown} act
 */
export function whenLoaded(need, act, failed = (/** @type {string} */ _) => {}) {
  if (need === null) act();
  else need.then(act, (error) => failed(error.message));
}
