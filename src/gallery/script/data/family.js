// Reads the data of a family (reader.js), whose pieces must be loaded (needs.js).

import { sumOf } from "./number.js";
import { unpackPoints } from "./packed.js";
import { upperBound } from "./series.js";

/** The code of a missing word. */
export const NO_WORD = 255;

/** The loaded piece of either series, which have the same rows, with a cell. @param {Family} _ @param {"ofCell" | "ofNumber"} of @param {number} cell */
function loadedPiece({ table, outlines }, of, cell) {
  return [table[of](cell), outlines[of](cell)].find((piece) => piece?.data);
}

/** The index of the cell with a number, or undefined. @param {Family} family */
function findCell(family, /** @type {number} */ number) {
  const { cells } = family;
  const piece = loadedPiece(family, "ofNumber", number);
  if (!piece) return undefined;
  const { firstCell, cells: count } = piece;
  const cell = firstCell + upperBound(count, (k) => cells.number[firstCell + k] < number);
  return cell < firstCell + count && cells.number[cell] === number ? cell : undefined;
}

/** The index of the first curve of a cell, or of a later one. @param {Family} family */
function firstCurveOf(family, /** @type {number} */ cell) {
  const { firstCurve = 0, curves: count = 0 } = loadedPiece(family, "ofCell", cell) ?? {};
  return firstCurve + upperBound(count, (k) => family.curves.cell[firstCurve + k] < cell);
}

/** The key of a curve in addresses: the numbers of its cell, its trace and its circuit. */
export function curveKey(/** @type {Family} */ family, /** @type {number} */ curve) {
  const { cell, trace, circuit } = family.curves;
  return `${family.cells.number[cell[curve]]}.${trace[curve]}.${circuit[curve]}`;
}

/** The numbers in a key: [cell, trace, circuit], or null. */
export function parseCurveKey(/** @type {string | undefined} */ key) {
  return key && /^[0-9]+\.[0-9]+\.[0-9]+$/.test(key) ? key.split(".").map(Number) : null;
}

/** The index of the curve with a key, or undefined. @param {Family} family */
export function findCurve(family, /** @type {string | undefined} */ key) {
  const [number, trace, circuit] = parseCurveKey(key) ?? [];
  const cell = number === undefined ? undefined : findCell(family, number);
  if (cell === undefined) return undefined;
  const { curves } = family;
  for (let curve = firstCurveOf(family, cell); curves.cell[curve] === cell; curve += 1)
    if (curves.trace[curve] === trace && curves.circuit[curve] === circuit)
      return curveKey(family, curve) === key ? curve : undefined;
  return undefined;
}

/** The number of curves of a cell, by its index. @param {Family} family */
export function curveCountOf(family, /** @type {number} */ cell) {
  const first = firstCurveOf(family, cell);
  let curve = first;
  while (family.curves.cell[curve] === cell) curve += 1;
  return curve - first;
}

/** A curve as an outline. @param {Family} family @returns {Outline} */
export function curveOutline(family, /** @type {number} */ curve) {
  return { points: curvePoints(family, curve), closed: family.curves.closed[curve] === 1 };
}

/** The points of a curve, [x0, y0, x1, y1, …], accurate to 1/65535 of its extent. @param {Family} family @param {number} curve */
export function curvePoints(family, curve) {
  return givenCurves(family, [curve]).points;
}

/**
 * Curves of a piece for the kernel, with their points one after another, in `room` if it is large enough.
 * @param {Family} _ @param {number[]} curves @returns {GivenCurves}
 */
export function givenCurves({ outlines, curves: { closed } }, curves, room = new ArrayBuffer()) {
  const { firstCurve = 0, data = null } = outlines.ofCurve(curves[0]) ?? {};
  if (!data) return { points: new Float64Array(), counts: new Float64Array(), closed: new Float64Array() };
  const { box, start, points } = data;
  const places = curves.map((curve) => curve - firstCurve);
  const counts = Float64Array.from(places, (own) => start[own + 1] - start[own]);
  const length = 2 * sumOf(counts, (count) => count);
  const out = new Float64Array(room.byteLength < 8 * length ? new ArrayBuffer(8 * length) : room, 0, length);
  let at = 0;
  places.forEach((own, n) => {
    const [x0, y0, x1, y1] = box.subarray(4 * own, 4 * own + 4);
    const isPacked = points instanceof Uint8Array;
    const steps = isPacked
      ? unpackPoints(points, data.places[own], counts[n])
      : points.subarray(2 * start[own]);
    for (let k = 0; k < 2 * counts[n]; k += 2) {
      out[at++] = x0 + ((x1 - x0) * steps[k]) / 65535;
      out[at++] = y0 + ((y1 - y0) * steps[k + 1]) / 65535;
    }
  });
  return { points: out, counts, closed: Float64Array.from(curves, (curve) => closed[curve]) };
}

/** The bounding box of a curve, [x0, y0, x1, y1]. @param {Family} _ */
export function curveBox({ outlines }, /** @type {number} */ curve) {
  const piece = outlines.ofCurve(curve);
  const at = 4 * (curve - (piece?.firstCurve ?? 0));
  return piece?.data ? piece.data.box.subarray(at, at + 4) : [NaN, NaN, NaN, NaN];
}

/**
 * A text of a cell: its "caption", its "note", or the "reason" why it is not assembled or only in part.
 * @param {Family} _ @param {"caption" | "note" | "reason"} name
 */
export function cellText({ outlines }, /** @type {number} */ cell, name) {
  const piece = outlines.ofCell(cell);
  return piece?.data?.[name][cell - piece.firstCell] ?? "";
}

/** The caption of a cell. @param {Family} family */
export function cellCaption(family, /** @type {number} */ cell) {
  return cellText(family, cell, "caption");
}

/** The caption of the cell of a curve. @param {Family} family */
export function curveCaption(family, /** @type {number} */ curve) {
  return cellCaption(family, family.curves.cell[curve]);
}

/** The views of a page; none if not loaded. @param {Family} family @param {number} page @returns {PageDrawing[]} */
export function pageViews(/** @type {Family} */ family, page) {
  const views = family.outlines.ofPage(page)?.data?.pages.get(page) ?? [];
  return views.map(({ cell, scale, origin, curves }) => ({
    cell: findCell(family, cell) ?? -1,
    scale,
    origin,
    curves: keysOfView(cell, curves).map((key) => findCurve(family, key) ?? -1),
  }));
}

/** The keys of the curves of a cell with some traces and circuits, in turn. @param {number} cell @param {number[]} curves */
function keysOfView(cell, curves) {
  return curves.flatMap((trace, k) => (k % 2 ? [] : [`${cell}.${trace}.${curves[k + 1]}`]));
}

/** The numbers of the cells drawn on a page. @param {Family} _ */
export function cellNumbersOnPage({ outlines }, /** @type {number} */ page) {
  return (outlines.ofPage(page)?.data?.pages.get(page) ?? []).map(({ cell }) => cell);
}

/** The page of a curve, from 1, among those that are loaded; 0 if it is on none of them. */
export function pageOfCurve(/** @type {Family} */ family, /** @type {number} */ curve) {
  const key = curveKey(family, curve);
  for (const { data } of family.outlines.pieces) {
    const page = data && (data.pageOfKey ??= pagesByKey(data)).get(key);
    if (page) return page;
  }
  return 0;
}

function pagesByKey(/** @type {PieceData} */ { pages }) {
  /** @type {Map<string, number>} */ const found = new Map();
  for (const [page, views] of pages)
    for (const { cell, curves } of views) for (const key of keysOfView(cell, curves)) found.set(key, page);
  return found;
}

/** The values of a cell's names, in the order of `family.names`. @param {Family} family */
export function cellValues(family, /** @type {number} */ cell) {
  const width = family.names.length;
  return family.cells.values.slice(cell * width, (cell + 1) * width);
}

/** The value of a measure of a curve: a number, a word, or undefined if it does not apply. @param {number} curve @param {string} name */
export function measureValue(/** @type {Family} */ family, curve, name) {
  const numbers = family.curves.measures[name];
  if (numbers) return Number.isNaN(numbers[curve]) ? undefined : numbers[curve];
  const words = family.curves.words[name];
  return words?.values[words.codes[curve]];
}
