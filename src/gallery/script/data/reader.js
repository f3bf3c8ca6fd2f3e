// Assembles the data of a family from the statements of its scripts.

import { NO_WORD } from "./family.js";
import { concatenateArrays, unpackColumn, unpackInto } from "./packed.js";
import { Series } from "./series.js";

/**
 * The family with a head, before any of its pieces is loaded:
 *
 * what the head passes (id, title, source, legend, linkage, layout, panels (the number on a page, null if
 *   that does not say which cells a page has), sampling, paper { width, height, color "#rrggbb" }, dash_deg,
 *   straight, template, names, free, derived),
 * cells { count, number, values (count × names), status (0 ok, 1 partial, 2 none) },
 * curves { count, cell, trace, circuit, closed, measures { name: f64[] }, words { name: { values, codes } }
 *   },
 * table, outlines: the Series of its pieces, pageCount, ranges [[least, greatest]] of its names, and traces:
 *   the greatest number of a traced point.
 *
 * Cells and curves are indices from 0. The arrays of cells and curves are valid where a piece of the table is
 * loaded; captions, points and pages, which may be dropped again, are read with the functions of family.js.
 */
function newFamily({ pieces, measures, words, ...head }) {
  const table = new Series(head.id, "table", pieces.table);
  const outlines = new Series(head.id, "curves", pieces.curves);
  const ranges = head.names.map((_, slot) =>
    pieces.table
      .filter((entry) => entry.ranges[slot])
      .map((entry) => entry.ranges[slot])
      .reduce(([a, b], [c, d]) => [Math.min(a, c), Math.max(b, d)], [Infinity, -Infinity]),
  );
  return {
    ...head,
    cells: {
      count: table.cells,
      number: new Uint32Array(),
      values: new Float64Array(),
      status: new Uint8Array(),
    },
    curves: {
      count: table.curves,
      cell: new Uint32Array(),
      trace: new Uint16Array(),
      circuit: new Uint16Array(),
      closed: new Uint8Array(),
      measures: Object.fromEntries(measures.map((name) => [name, new Float64Array()])),
      words: Object.fromEntries(words.map((name) => [name, { values: [], codes: new Uint8Array() }])),
    },
    table,
    outlines,
    pageCount: outlines.pages,
    ranges,
    traces: Math.max(0, ...pieces.table.map((entry) => entry.traces)),
    measureNames: { numbers: measures, words },
  };
}

/** Makes room for the whole table, which takes memory only where it is filled. */
function allocateTable({ cells, curves, names }) {
  if (cells.number.length === cells.count) return;
  cells.number = new Uint32Array(cells.count);
  cells.values = new Float64Array(cells.count * names.length);
  cells.status = new Uint8Array(cells.count);
  curves.cell = new Uint32Array(curves.count);
  curves.trace = new Uint16Array(curves.count);
  curves.circuit = new Uint16Array(curves.count);
  curves.closed = new Uint8Array(curves.count);
  for (const name of Object.keys(curves.measures)) curves.measures[name] = new Float64Array(curves.count);
  for (const word of Object.values(curves.words)) word.codes = new Uint8Array(curves.count).fill(NO_WORD);
}

/** Collects the statements of a family's head; `finish()` returns the family. */
export class FamilyReader {
  constructor(head) {
    this.family = newFamily(head);
    const { table, outlines } = this.family;
    // A small family has everything in its head: its pieces have no files.
    this.readers = [...table.pieces, ...outlines.pieces]
      .filter(({ bytes }) => bytes === 0)
      .map((piece) => new PieceReader(this.family, piece));
  }

  cells(statement) {
    this.readers[0].cells(statement);
  }

  curves(statement) {
    this.readers[1].curves(statement);
  }

  page(statement) {
    this.readers[1].page(statement);
  }

  finish() {
    this.readers.forEach((reader) => reader.finish());
    return this.family;
  }
}

/** Collects the statements of a piece; `finish()` adds its data to the family. */
export class PieceReader {
  constructor(family, piece) {
    Object.assign(this, { family, piece });
    [this.cell, this.curve] = [piece.firstCell, piece.firstCurve];
    this.chunks = [];
    this.pages = new Map();
  }

  /** Rows of the table, written to their places. */
  cells(rows) {
    const { cells, curves, names, measureNames } = this.family;
    allocateTable(this.family);
    const { count } = rows;
    if (typeof rows.number === "number")
      for (let k = 0; k < count; k += 1) cells.number[this.cell + k] = rows.number + k;
    else unpackInto(cells.number, this.cell, count, rows.number);
    const width = names.length;
    rows.values.forEach((column, slot) => {
      const values = unpackColumn(Float64Array, count, column);
      for (let k = 0; k < count; k += 1) cells.values[(this.cell + k) * width + slot] = values[k];
    });
    unpackInto(cells.status, this.cell, count, rows.status);
    const each = unpackColumn(Uint16Array, count, rows.curves);
    let end = this.curve;
    for (let k = 0; k < count; k += 1) {
      curves.cell.fill(this.cell + k, end, end + each[k]);
      end += each[k];
    }
    const all = end - this.curve;
    for (const name of ["trace", "circuit", "closed"]) unpackInto(curves[name], this.curve, all, rows[name]);
    measureNames.numbers.forEach((name, k) =>
      unpackInto(curves.measures[name], this.curve, all, rows.measures[k]),
    );
    measureNames.words.forEach((name, k) =>
      addWords(
        curves.words[name],
        this.curve,
        unpackColumn(Uint8Array, all, rows.words[k].codes),
        rows.words[k],
      ),
    );
    [this.cell, this.curve] = [this.cell + count, end];
  }

  /** Captions of cells, and points of curves. */
  curves({ reason, caption, note, cells, box, count, curves, points }) {
    const counts = unpackColumn(Uint16Array, curves, count);
    const sides = box.map((column) => unpackColumn(Float64Array, curves, column));
    const total = 2 * counts.reduce((sum, each) => sum + each, 0);
    const listed = (texts) => (texts.length ? texts : new Array(cells).fill(""));
    this.chunks.push({
      reason: listed(reason),
      caption: listed(caption),
      note: listed(note),
      counts,
      box: Float64Array.from({ length: 4 * curves }, (_, k) => sides[k & 3][k >> 2]),
      points: unpackColumn(Uint16Array, total, points),
    });
  }

  page({ page, views }) {
    this.pages.set(page, views);
  }

  finish() {
    if (this.piece.name === "table") {
      this.piece.data = {};
      return;
    }
    const all = (name, kind) =>
      concatenateArrays(
        this.chunks.map((chunk) => chunk[name]),
        kind,
      );
    const texts = (name) => this.chunks.flatMap((chunk) => chunk[name]);
    const data = packedPoints(
      all("box", Float64Array),
      all("counts", Uint16Array),
      all("points", Uint16Array),
    );
    Object.assign(data, { reason: texts("reason"), caption: texts("caption"), note: texts("note") });
    data.pages = this.pages;
    this.piece.data = data;
  }
}

/** The points of curves, as a loaded piece has them, from their boxes, numbers and points. */
export function packedPoints(box, counts, points) {
  const start = new Uint32Array(counts.length + 1);
  counts.forEach((count, k) => {
    start[k + 1] = start[k] + count;
  });
  return { box, start, points };
}

/** Adds the words of some curves, which have a numbering of their own. */
function addWords(column, at, codes, { values }) {
  const renamed = values.map((word) =>
    column.values.includes(word) ? column.values.indexOf(word) : column.values.push(word) - 1,
  );
  for (let k = 0; k < codes.length; k += 1) column.codes[at + k] = renamed[codes[k]] ?? NO_WORD;
}

/**
 * A family like another one with a single curve, whose table and outline are given: `cells` and `curves` as
 * in newFamily, `outline` { box, counts, points, caption, note, reason }.
 */
export function singleCurveFamily(
  family,
  { number, values, status, trace, circuit, closed, measures, words },
  outline,
) {
  const entry = { bytes: 0, cells: 1, curves: 1, numbers: [number, number] };
  const [table, outlines] = ["table", "curves"].map((name) => new Series(family.id, name, [entry]));
  table.pieces[0].data = {};
  const { caption, note, reason } = outline;
  outlines.pieces[0].data = {
    ...packedPoints(outline.box, outline.counts, outline.points),
    ...{ caption: [caption], note: [note], reason: [reason] },
    pages: new Map(),
  };
  return {
    ...family,
    cells: { count: 1, number: Uint32Array.of(number), values, status: Uint8Array.of(status) },
    curves: {
      count: 1,
      cell: Uint32Array.of(0),
      trace: Uint16Array.of(trace),
      circuit: Uint16Array.of(circuit),
      closed: Uint8Array.of(closed),
      measures,
      words,
    },
    table,
    outlines,
    pageCount: 0,
  };
}
