// All curves of some families as one table: a row for each curve, a column for each measure and parameter.

import { NO_WORD, curveKey } from "../data/family.js";
import { renamedWords } from "../data/reader.js";

/** Columns computed from measures, for frequent queries that no single measure answers. */
export const DERIVED_COLUMNS = {
  straight_tolerance: {
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
    this.cache = new Map();
    let row = 0;
    counts.forEach((count, k) => {
      for (let curve = 0; curve < count; curve += 1, row += 1) {
        this.family[row] = k;
        this.curve[row] = curve;
      }
    });
  }

  /** The curve of a row, with its name. */
  curveOf(row) {
    const family = this.families[this.family[row]];
    const curve = this.curve[row];
    return { family, curve, name: `${family.id}:${curveKey(family, curve)}` };
  }

  /** Whether any of the families has a measure. */
  has(name) {
    return this.families.some(({ curves }) => name in curves.measures || name in curves.words);
  }

  /** Releases the memory of a column of numbers, which is computed again when it is used. */
  release(name) {
    this.cache.delete(name);
  }

  /** A column of numbers, f64[count], NaN where missing; a parameter's name is prefixed with "p.". */
  numbers(name) {
    if (!this.cache.has(name)) this.cache.set(name, this.computeNumbers(name));
    return this.cache.get(name);
  }

  computeNumbers(name) {
    // A single family already has its measures in such columns.
    const [family, ...others] = this.families;
    if (others.length === 0 && family?.curves.measures[name])
      return family.curves.measures[name].subarray(0, this.count);
    const out = new Float64Array(this.count).fill(NaN);
    if (DERIVED_COLUMNS[name]) {
      const { inputs, compute } = DERIVED_COLUMNS[name];
      if (!inputs.every((input) => this.has(input))) return out;
      let row = 0;
      const at = (other) => this.numbers(other)[row];
      for (; row < this.count; row += 1) out[row] = compute(at);
      return out;
    }
    const own = name.startsWith("p.") ? parameterColumn(name.slice(2)) : measureColumn(name);
    let row = 0;
    this.families.forEach((each, k) => {
      const value = own(each);
      for (let curve = 0; curve < this.counts[k]; curve += 1, row += 1) if (value) out[row] = value(curve);
    });
    return out;
  }

  /** A column of words: { values, codes u8[count] }, NO_WORD where missing. */
  words(name) {
    const key = `words ${name}`;
    if (!this.cache.has(key)) this.cache.set(key, this.computeWords(name));
    return this.cache.get(key);
  }

  computeWords(name) {
    const codes = new Uint8Array(this.count).fill(NO_WORD);
    if (name === "symmetric") {
      const { codes: own } = this.words("symmetry");
      const measures = this.families.map(({ curves }) => "symmetry" in curves.words);
      for (let row = 0; row < this.count; row += 1)
        if (measures[this.family[row]]) codes[row] = own[row] === NO_WORD ? 0 : 1;
      return { values: SYMMETRY_WORDS, codes };
    }
    const values = [];
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

function measureColumn(name) {
  return ({ curves }) => {
    const values = curves.measures[name];
    return values && ((curve) => values[curve]);
  };
}

function parameterColumn(name) {
  return ({ names, cells, curves }) => {
    const at = names.indexOf(name);
    return at >= 0 && ((curve) => cells.values[curves.cell[curve] * names.length + at]);
  };
}
