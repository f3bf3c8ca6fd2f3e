// All curves of some families as one table: a row for each curve, a column for each measure and parameter.

import { NO_WORD, curveKey } from "../data/family.js";
import { renamedWords } from "../data/reader.js";

/** Columns computed from measures, for frequent queries that no single measure answers. @type {Record<string, DerivedColumn>} */
export const DERIVED_COLUMNS = {
  straight_tolerance: {
    title: "deviation of the straight portion over its length",
    unit: "",
    definition: "deviation of the straightest portion from its line, divided by its length",
    inputs: ["straight_deviation", "straight_length"],
    compute: (at) => at("straight_deviation") / at("straight_length"),
  },
};

const SYMMETRY_WORDS = ["not symmetric", "symmetric"];

/**
 * The rows of families, of each its first `counts[k]` curves, by default all: `family[row]` and `curve[row]`
 * are indices. Columns are computed on first use.
 */
export class CurveTable {
  constructor(/** @type {Family[]} */ families, counts = families.map(({ curves }) => curves.count)) {
    this.families = families;
    this.counts = counts;
    this.count = counts.reduce((sum, count) => sum + count, 0);
    this.family = new Uint16Array(this.count);
    this.curve = new Uint32Array(this.count);
    /** @type {Map<string, Float64Array>} */ this.columns = new Map();
    /** @type {Map<string, Words>} */ this.wordColumns = new Map();
    let row = 0;
    counts.forEach((count, k) => {
      for (let curve = 0; curve < count; curve += 1, row += 1) {
        this.family[row] = k;
        this.curve[row] = curve;
      }
    });
  }

  /** The curve of a row, with its name. */
  curveOf(/** @type {number} */ row) {
    const family = this.families[this.family[row]];
    const curve = this.curve[row];
    return { family, curve, name: `${family.id}:${curveKey(family, curve)}` };
  }

  /** Whether any of the families has a measure. */
  has(/** @type {string} */ name) {
    return this.families.some(({ curves }) => name in curves.measures || name in curves.words);
  }

  /** Releases the memory of a column of numbers, which is computed again when it is used. */
  release(/** @type {string} */ name) {
    this.columns.delete(name);
  }

  /** A column of numbers, f64[count], NaN where missing; a parameter's name is prefixed with "p.". */
  numbers(/** @type {string} */ name) {
    const known = this.columns.get(name) ?? this.computeNumbers(name);
    this.columns.set(name, known);
    return known;
  }

  computeNumbers(/** @type {string} */ name) {
    // A single family already has its measures in such columns.
    const [family, ...others] = this.families;
    if (others.length === 0 && family?.curves.measures[name])
      return family.curves.measures[name].subarray(0, this.count);
    const out = new Float64Array(this.count).fill(NaN);
    if (DERIVED_COLUMNS[name]) {
      const { inputs, compute } = DERIVED_COLUMNS[name];
      if (!inputs.every((input) => this.has(input))) return out;
      let row = 0;
      const at = (/** @type {string} */ other) => this.numbers(other)[row];
      for (; row < this.count; row += 1) out[row] = compute(at);
      return out;
    }
    let row = 0;
    this.families.forEach((each, k) => {
      const value = columnOf(each, name);
      for (let curve = 0; curve < this.counts[k]; curve += 1, row += 1) if (value) out[row] = value(curve);
    });
    return out;
  }

  /** A column of words: { values, codes u8[count] }, NO_WORD where missing. */
  words(/** @type {string} */ name) {
    const known = this.wordColumns.get(name) ?? this.computeWords(name);
    this.wordColumns.set(name, known);
    return known;
  }

  computeWords(/** @type {string} */ name) {
    const codes = new Uint8Array(this.count).fill(NO_WORD);
    if (name === "symmetric") {
      const { codes: own } = this.words("symmetry");
      const measures = this.families.map(({ curves }) => "symmetry" in curves.words);
      for (let row = 0; row < this.count; row += 1)
        if (measures[this.family[row]]) codes[row] = own[row] === NO_WORD ? 0 : 1;
      return { values: SYMMETRY_WORDS, codes };
    }
    /** @type {string[]} */ const values = [];
    let row = 0;
    this.families.forEach(({ curves }, k) => {
      const own = curves.words[name];
      const renamed = renamedWords(own?.values ?? [], values);
      for (let curve = 0; curve < this.counts[k]; curve += 1, row += 1) {
        if (own && own.codes[curve] !== NO_WORD) codes[row] = renamed[own.codes[curve]];
      }
    });
    return { values, codes };
  }
}

/** The values of a column of a family, by curve; null if it has none. @returns {((curve: number) => number) | null} */
function columnOf(/** @type {Family} */ { names, cells, curves }, /** @type {string} */ name) {
  const values = curves.measures[name];
  const at = name.startsWith("p.") ? names.indexOf(name.slice(2)) : -1;
  if (at >= 0) return (curve) => cells.values[curves.cell[curve] * names.length + at];
  return values ? (curve) => values[curve] : null;
}
