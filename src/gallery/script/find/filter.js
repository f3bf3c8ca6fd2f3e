// Filters and sorts the rows of a table.

import { NO_WORD } from "../data/family.js";

/** Filters of a table by column name. A row without a value does not pass. */
export class Filters {
  constructor(/** @type {CurveTable} */ table) {
    this.table = table;
    this.failing = new Uint16Array(table.count);
    /** @type {Map<string, Uint8Array>} */ this.fails = new Map();
    /** @type {Uint32Array | null} */ this.passing = null;
  }

  /** Sets the filter of a column; null removes it. @param {Filter | null} filter */
  set(/** @type {string} */ name, filter) {
    const before = this.fails.get(name);
    const after = filter && this.failuresOf(name, filter);
    if (before) for (let row = 0; row < this.failing.length; row += 1) this.failing[row] -= before[row];
    if (after) for (let row = 0; row < this.failing.length; row += 1) this.failing[row] += after[row];
    if (after) this.fails.set(name, after);
    else this.fails.delete(name);
    this.passing = null;
  }

  failuresOf(/** @type {string} */ name, /** @type {Filter} */ filter) {
    const out = new Uint8Array(this.table.count);
    if (filter instanceof Set) {
      const { values, codes } = this.table.words(name);
      const passes = new Uint8Array(256);
      values.forEach((word, code) => {
        passes[code] = filter.has(word) ? 1 : 0;
      });
      for (let row = 0; row < out.length; row += 1) out[row] = 1 - passes[codes[row]];
      return out;
    }
    const [low, high] = [filter.low ?? -Infinity, filter.high ?? Infinity];
    const values = this.table.numbers(name);
    // A comparison with NaN is false.
    for (let row = 0; row < out.length; row += 1)
      out[row] = values[row] >= low && values[row] <= high ? 0 : 1;
    return out;
  }

  /** The rows that pass all filters, in the table's order. */
  rows() {
    return (this.passing ??= passingRows(allRows(this.table), this.failing));
  }

  /** The number of rows that pass without the filter of a column. */
  countWithout(/** @type {string} */ name) {
    const own = this.fails.get(name);
    return this.failing.reduce((count, fails, row) => count + (fails === (own ? own[row] : 0) ? 1 : 0), 0);
  }

  /** For each word of a column, the number of rows that have it and pass all other filters. */
  wordCounts(/** @type {string} */ name) {
    const { values, codes } = this.table.words(name);
    const own = this.fails.get(name);
    const counts = new Uint32Array(256);
    for (let row = 0; row < codes.length; row += 1) {
      if (this.failing[row] === (own ? own[row] : 0)) counts[codes[row]] += 1;
    }
    return counts.subarray(0, values.length);
  }
}

/** The sort orders of a table's rows, cached. */
export class Orders {
  constructor(/** @type {CurveTable} */ table) {
    this.table = table;
    /** @type {Map<string, Uint32Array>} */ this.cache = new Map();
  }

  /**
   * All rows sorted by a column of numbers or words (`kind`), ascending, or descending if `down`. Rows
   * without a value come last in both cases; ties keep the table's order. Without a name, the table's order.
   * @param {string | undefined} name @param {Column["kind"] | undefined} kind @param {boolean} down
   */
  by(name, kind, down) {
    const key = `${down ? "-" : ""}${kind} ${name}`;
    const known = this.cache.get(key) ?? this.compute(name, kind, down);
    this.cache.set(key, known);
    return known;
  }

  /** @param {string | undefined} name @param {Column["kind"] | undefined} kind @param {boolean} down */
  compute(name, kind, down) {
    const rows = allRows(this.table);
    if (!name) return rows;
    const values = kind === "words" ? wordRanks(this.table.words(name)) : this.table.numbers(name);
    const sign = down ? -1 : 1;
    return rows.sort((a, b) => {
      const [u, v] = [values[a], values[b]];
      if (Number.isNaN(u) || Number.isNaN(v))
        return Number(Number.isNaN(u)) - Number(Number.isNaN(v)) || a - b;
      // The difference of equal infinities is NaN.
      return (u === v ? 0 : sign * (u < v ? -1 : 1)) || a - b;
    });
  }
}

function wordRanks(/** @type {Words} */ { values, codes }) {
  const sorted = [...values].sort();
  const ranks = values.map((word) => sorted.indexOf(word));
  return Float64Array.from(codes, (code) => (code === NO_WORD ? NaN : ranks[code]));
}

/** The rows of an order that pass. @param {Uint32Array} order @param {Uint16Array} failing */
export function passingRows(order, failing) {
  return order.filter((row) => failing[row] === 0);
}

function allRows(/** @type {CurveTable} */ { count }) {
  return new Uint32Array(count).map((_, row) => row);
}
