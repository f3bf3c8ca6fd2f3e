// The data of one curve, as the statements of a family that has no other.

import { cellText, cellValues, curveBox, measureValue, NO_WORD } from "../data/family.js";

/** The statements of a family with one cell, of one curve, whose pieces must be loaded. @param {Family} family @returns {CellStatements} */
export function statementsOfCurve(family, /** @type {number} */ curve) {
  const { cells, curves, measureNames, outlines, ranges, traces, table: _, ...rest } = family;
  const cell = curves.cell[curve];
  const number = cells.number[cell];
  const { load: _load, used: _used, pageCount: _pages, ...known } = rest;
  const entry = { bytes: 0, cells: 1, curves: 1, numbers: /** @type {Point} */ ([number, number]) };
  const pieces = { table: [{ ...entry, ranges, traces }], curves: [entry] };
  const points = pointsOf(outlines, curve);
  const text = (/** @type {"caption" | "note" | "reason"} */ name) => [cellText(family, cell, name)];
  const word = (/** @type {string} */ name) => {
    const value = measureValue(family, curve, name);
    return value === undefined ? { values: [], codes: NO_WORD } : { values: [String(value)], codes: 0 };
  };
  return {
    head: { ...known, measures: measureNames.numbers, words: measureNames.words, pieces },
    cells: {
      count: 1,
      number,
      values: Array.from(cellValues(family, cell), packedNumber),
      assignment: cells.assignment[cell],
      status: cells.status[cell],
      curves: 1,
      trace: curves.trace[curve],
      circuit: curves.circuit[curve],
      closed: curves.closed[curve],
      measures: measureNames.numbers.map((name) => packedNumber(curves.measures[name]?.[curve] ?? NaN)),
      words: measureNames.words.map(word),
    },
    curves: {
      reason: text("reason"),
      caption: text("caption"),
      note: text("note"),
      cells: 1,
      curves: 1,
      box: Array.from(curveBox(family, curve), packedNumber),
      count: points.length / 2,
      points: encodeBase64(points),
    },
  };
}

/** The stored points of a curve. @param {Series} outlines */
function pointsOf(outlines, /** @type {number} */ curve) {
  const piece = outlines.ofCurve(curve);
  if (!piece?.data) return new Uint16Array();
  const { start, points } = piece.data;
  const own = curve - piece.firstCurve;
  return points.slice(2 * start[own], 2 * start[own + 1]);
}

/** A column of one number, with all its bits: JSON has neither -0 nor infinity. */
function packedNumber(/** @type {number} */ value) {
  return Number.isNaN(value) ? null : encodeBase64(Float64Array.of(value));
}

function encodeBase64(/** @type {Float64Array | Uint16Array} */ array) {
  return btoa(String.fromCharCode(...new Uint8Array(array.buffer)));
}
