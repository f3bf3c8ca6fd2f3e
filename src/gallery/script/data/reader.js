// Assembles the data of a family from the statements of its scripts.

import { NO_WORD } from "./family.js";
import { bytesOfComment, concatenateArrays, freeArray } from "./packed.js";
import { placesOfCurves, unpackColumn, unpackInto } from "./packed.js";
import { Series } from "./series.js";

const TEXTS = /** @type {const} */ (["reason", "caption", "note"]);

/** The family with a head, before any of its pieces is loaded. @returns {Family} */
function newFamily(/** @type {FamilyHead} */ { pieces, measures, words, ...head }) {
  const table = new Series(head.id, "table", pieces.table);
  const outlines = new Series(head.id, "curves", pieces.curves);
  const ranges = head.names.map((_, slot) => {
    const known = pieces.table.flatMap((entry) => (entry.ranges?.[slot] ? [entry.ranges[slot]] : []));
    return widestRange(known);
  });
  return {
    ...head,
    cells: tableOfCells(0, table.cells, 0),
    curves: tableOfCurves(0, table.curves, words),
    table,
    outlines,
    pageCount: outlines.pages,
    ranges,
    traces: Math.max(0, ...pieces.table.map((entry) => entry.traces ?? 0)),
    measureNames: { numbers: measures, words },
    load: () => Promise.resolve(),
    used: () => {},
  };
}

/** Reads the head of a family; a small family has everything in it: its pieces have no files. @param {FamilyHead} head */
export function headReader(head) {
  const family = newFamily(head);
  const pieces = [...family.table.pieces, ...family.outlines.pieces];
  return new PieceReader(
    family,
    pieces.filter(({ bytes }) => bytes === 0),
  );
}

/** @param {[number, number][]} ranges @returns {[number, number]} */
function widestRange(ranges) {
  return [Math.min(...ranges.map(([least]) => least)), Math.max(...ranges.map(([, most]) => most))];
}

/** The columns of `count` cells, with room for `room`. @returns {Cells} */
function tableOfCells(/** @type {number} */ room, /** @type {number} */ count, /** @type {number} */ width) {
  return {
    count,
    number: new Uint32Array(room),
    values: new Float64Array(room * width),
    assignment: new Uint16Array(room),
    status: new Uint8Array(room),
  };
}

/** The columns of `count` curves, with room for `room`. @returns {Curves} @param {number} room @param {number} count @param {string[]} words */
function tableOfCurves(room, count, words) {
  /** @param {string} name */
  const wordsOf = (name) => [name, { values: [], codes: new Uint8Array(room).fill(NO_WORD) }];
  return {
    count,
    cell: new Uint32Array(room),
    trace: new Uint16Array(room),
    circuit: new Uint16Array(room),
    closed: new Uint8Array(room),
    // Measures that no curve has take no room.
    measures: {},
    words: Object.fromEntries(words.map(wordsOf)),
  };
}

/** Makes room for the whole table, which takes memory only where it is filled. @param {Family} _ */
function allocateTable(/** @type {Family} */ { cells, curves, names, measureNames }) {
  if (cells.number.length === cells.count) return;
  Object.assign(cells, tableOfCells(cells.count, cells.count, names.length));
  Object.assign(curves, tableOfCurves(curves.count, curves.count, measureNames.words));
}

/** Collects the statements of pieces, those of one script; `finish()` adds their data to the family, and returns it. */
export class PieceReader {
  constructor(/** @type {Family} */ family, /** @type {Piece[]} */ pieces) {
    this.family = family;
    this.pieces = pieces;
    const { firstCell: cell = 0, firstCurve: curve = 0 } = pieces[0] ?? {};
    /** The next rows of the table, and those whose points come next: a small family has both in one script. */
    this.next = { table: { cell, curve }, curves: { cell, curve } };
    /** @type {Chunk[]} */ this.chunks = [];
    /** @type {PieceData["pages"]} */ this.pages = new Map();
  }

  /** Rows of the table, written to their places. */
  cells(/** @type {CellRows} */ rows) {
    const { cells, curves, names, measureNames } = this.family;
    const { count } = rows;
    const { cell, curve, all } = this.#rows(this.next.table, count, rows);
    const width = names.length;
    rows.values.forEach((column, slot) => {
      const values = unpackColumn(Float64Array, count, column);
      for (let k = 0; k < count; k += 1) cells.values[(cell + k) * width + slot] = values[k];
      freeArray(values);
    });
    unpackInto(cells.assignment, cell, count, rows.assignment ?? 0);
    unpackInto(cells.status, cell, count, rows.status);
    measureNames.numbers.forEach((name, k) => {
      const { measures } = curves;
      const column = rows.measures[k];
      if (column === null && !measures[name]) return;
      measures[name] ??= new Float64Array(curves.cell.length).fill(NaN);
      unpackInto(measures[name], curve, all, column);
    });
    measureNames.words.forEach((name, k) => {
      const { codes, values } = rows.words[k];
      addWords(curves.words[name], curve, unpackColumn(Uint8Array, all, codes), values);
    });
  }

  /** Which cells and curves come next: the first of both, and how many curves. @param {CurvePlace} next @param {number} count @param {IdentityRows} rows */
  #rows(next, count, rows) {
    const { cells, curves } = this.family;
    allocateTable(this.family);
    const { cell, curve } = next;
    if (typeof rows.number === "number")
      for (let k = 0; k < count; k += 1) cells.number[cell + k] = rows.number + k;
    else unpackInto(cells.number, cell, count, rows.number);
    const each = unpackColumn(Uint16Array, count, rows.curves);
    for (let k = 0; k < count; k += 1) {
      curves.cell.fill(cell + k, next.curve, next.curve + each[k]);
      next.curve += each[k];
    }
    next.cell += count;
    const all = next.curve - curve;
    for (const name of /** @type {const} */ (["trace", "circuit", "closed"]))
      unpackInto(curves[name], curve, all, rows[name]);
    return { cell, curve, all };
  }

  /** Captions of cells, and points of curves: those of the kernel are numbers, without rows. @param {CurveRows} _ @param {() => void} [comment] */
  curves({ reason, caption, note, cells, rows, box, count, curves, points }, comment) {
    if (rows) this.#rows(this.next.curves, cells, rows);
    const counts = unpackColumn(Uint16Array, curves, count);
    const sides = box.map((column) => unpackColumn(Float64Array, curves, column));
    const listed = (/** @type {string[]} */ texts) => (texts.length ? texts : new Array(cells).fill(""));
    this.chunks.push({
      reason: listed(reason),
      caption: listed(caption),
      note: listed(note),
      counts,
      box: Float64Array.from({ length: 4 * curves }, (_, k) => sides[k & 3][k >> 2]),
      points: comment ? bytesOfComment(comment) : Uint16Array.from(points ?? []),
    });
    sides.forEach(freeArray);
  }

  page(/** @type {PageRows} */ { page, views }) {
    this.pages.set(page, views);
  }

  /** A piece of the table has nothing of its own: its rows are with those of the other pieces. */
  finish() {
    const { chunks, pages } = this;
    const [boxes, parts] = [chunks.map((one) => one.box), chunks.map((one) => one.points)];
    const [box, points] = [concatenateArrays(boxes, Float64Array), concatenateArrays(parts, Uint8Array)];
    const counts = chunks.flatMap((one) => [...one.counts]);
    const start = Uint32Array.from([0, ...counts]);
    for (let k = 1; k < start.length; k += 1) start[k] += start[k - 1];
    const places = points instanceof Uint8Array ? placesOfCurves(points, counts) : start;
    const [reason, caption, note] = TEXTS.map((name) => chunks.flatMap((one) => one[name]));
    for (const piece of this.pieces)
      piece.data = { box, start, places, points, reason, caption, note, pages };
    if (chunks.length > 1) [...boxes, ...parts].forEach(freeArray);
    return this.family;
  }
}

/** The places of words in a list of known ones, to which new ones are added. @param {string[]} words */
export function renamedWords(words, /** @type {string[]} */ known) {
  return words.map((word) => (known.includes(word) ? known.indexOf(word) : known.push(word) - 1));
}

/** Adds the words of some curves, which have a numbering of their own. @param {number} at @param {Uint8Array} codes @param {string[]} values */
function addWords(/** @type {Words} */ column, at, codes, values) {
  const renamed = renamedWords(values, column.values);
  for (let k = 0; k < codes.length; k += 1) column.codes[at + k] = renamed[codes[k]] ?? NO_WORD;
}

/**
 * A family of a single cell, from statements as those of the kernel and what else there is to know of it.
 * @param {CellStatements} _ @param {Pick<Family, "id" | "title" | "manifest">} known @returns {Family}
 */
export function familyOfCell({ head, cells, curves }, { id, title, manifest }) {
  const reader = headReader({ ...head, id, title, manifest });
  reader.cells(cells);
  reader.curves(curves);
  return reader.finish();
}
