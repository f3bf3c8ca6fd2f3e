// The data of a family, assembled from the statements of its script.

import { concatenateArrays, unpackArray } from "./packed.js";

/** The code of a missing word. */
export const NO_WORD = 255;

/**
 * Collects the statements of a family's script. `finish()` returns the family:
 *
 * what `begin` passes (id, title, source, legend, linkage, layout, sampling, paper { width, height, color
 *   "#rrggbb", missing in older data }, dash_deg, straight, template, names, free, derived), and
 * cells { count, number, values (count × names), status (0 ok, 1 partial, 2 none), reason, caption, note },
 * curves { count, cell, trace, circuit, page (from 1; 0: on none), closed, measures, words,
 *   box (x0 y0 x1 y1), start, points },
 * pages [{ views: [{ cell, scale, origin, curves: [curve] }] }]; cells and curves are indices from 0.
 */
export class FamilyReader {
  constructor(head) {
    this.head = head;
    this.chunks = [];
    this.pages = [];
  }

  cells(chunk) {
    this.chunks.push(chunk);
  }

  page({ page, views }) {
    this.pages[page - 1] = views;
  }

  finish() {
    const cells = joinCells(this.chunks);
    const curves = joinCurves(this.chunks, cells.count);
    const family = { ...this.head, cells, curves, pages: [] };
    family.places = indexCurves(family);
    family.pages = Array.from(this.pages, (views) => resolvePage(family, views ?? []));
    family.pages.forEach(({ views }, k) =>
      views.forEach((view) =>
        view.curves.forEach((curve) => {
          curves.page[curve] = k + 1;
        }),
      ),
    );
    return family;
  }
}

function joinCells(chunks) {
  const all = (name) =>
    chunks.length ? concatenateArrays(chunks.map((chunk) => unpackArray(chunk[name]))) : new Uint8Array();
  const words = (name) => chunks.flatMap((chunk) => chunk[name]);
  const number = all("number");
  const [values, status] = [all("values"), all("status")];
  return {
    count: number.length,
    number,
    values,
    status,
    reason: words("reason"),
    caption: words("caption"),
    note: words("note"),
  };
}

function joinCurves(chunks) {
  const parts = chunks.map((chunk) => chunk.curves);
  const all = (name, kind) =>
    parts.length ? concatenateArrays(parts.map((part) => unpackArray(part[name]))) : new kind();
  const cell = all("cell", Uint32Array);
  const counts = all("count", Uint16Array);
  let [at, before] = [0, 0];
  for (const chunk of chunks) {
    // Cell indices are relative to the chunk.
    const curves = unpackArray(chunk.curves.cell).length;
    for (let k = 0; k < curves; k += 1) cell[at + k] += before;
    at += curves;
    before += unpackArray(chunk.number).length;
  }
  const start = new Uint32Array(cell.length + 1);
  counts.forEach((count, k) => {
    start[k + 1] = start[k] + count;
  });
  return {
    count: cell.length,
    cell,
    trace: all("trace", Uint16Array),
    circuit: all("circuit", Uint16Array),
    page: new Uint32Array(cell.length),
    closed: all("closed", Uint8Array),
    measures: joinMeasures(parts),
    words: joinWords(parts),
    box: all("box", Float64Array),
    start,
    points: all("points", Uint16Array),
  };
}

function joinMeasures(parts) {
  const names = Object.keys(parts[0]?.measures ?? {});
  return Object.fromEntries(
    names.map((name) => [name, concatenateArrays(parts.map((part) => unpackArray(part.measures[name])))]),
  );
}

/** Joins the words of chunks under one numbering. */
function joinWords(parts) {
  const names = Object.keys(parts[0]?.words ?? {});
  return Object.fromEntries(
    names.map((name) => {
      const values = [];
      const codes = parts.map((part) => {
        const { values: own, codes: packed } = part.words[name];
        const renamed = own.map((word) =>
          values.includes(word) ? values.indexOf(word) : values.push(word) - 1,
        );
        return unpackArray(packed).map((code) => renamed[code] ?? NO_WORD);
      });
      return [name, { values, codes: concatenateArrays(codes) }];
    }),
  );
}

/** The index of each curve, by its key. */
function indexCurves(family) {
  const places = new Map();
  for (let k = 0; k < family.curves.count; k += 1) places.set(curveKey(family, k), k);
  return places;
}

function resolvePage(family, views) {
  const cellOf = new Map(Array.from(family.cells.number, (number, k) => [number, k]));
  const seen = ({ cell, scale, origin, curves }) => ({
    cell: cellOf.get(cell),
    scale,
    origin,
    curves: curves.map(([trace, circuit]) => family.places.get(`${cell}.${trace}.${circuit}`)),
  });
  return { views: views.map(seen) };
}

/** The key of a curve in addresses: the numbers of its cell, its trace and its circuit. */
export function curveKey(family, curve) {
  const { cell, trace, circuit } = family.curves;
  return `${family.cells.number[cell[curve]]}.${trace[curve]}.${circuit[curve]}`;
}

/** The index of the curve with a key, or undefined. */
export function findCurve(family, key) {
  return family.places.get(key);
}

/** The points of a curve, [x0, y0, x1, y1, …], accurate to 1/65535 of its extent. */
export function curvePoints(family, curve) {
  const { box, start, points } = family.curves;
  const [x0, y0, x1, y1] = box.subarray(4 * curve, 4 * curve + 4);
  const out = new Float64Array(2 * (start[curve + 1] - start[curve]));
  for (let k = 0; k < out.length; k += 2) {
    const at = 2 * start[curve] + k;
    out[k] = x0 + ((x1 - x0) * points[at]) / 65535;
    out[k + 1] = y0 + ((y1 - y0) * points[at + 1]) / 65535;
  }
  return out;
}

/** The values of a cell's names, in the order of `family.names`. */
export function cellValues(family, cell) {
  const width = family.names.length;
  return family.cells.values.slice(cell * width, (cell + 1) * width);
}

/** The value of a measure of a curve: a number, a word, or undefined if it does not apply. */
export function measureValue(family, curve, name) {
  const numbers = family.curves.measures[name];
  if (numbers) return Number.isNaN(numbers[curve]) ? undefined : numbers[curve];
  const words = family.curves.words[name];
  return words?.values[words.codes[curve]];
}
