// Filters the rows of a table.

/**
 * Filters of a table by column name: { low, high } for numbers (both optional, inclusive), or a Set of words.
 * A row without a value does not pass.
 */
export class Filters {
  constructor(table) {
    this.table = table;
    this.failing = new Uint16Array(table.count);
    this.fails = new Map();
    this.passing = null;
  }

  /** Sets the filter of a column; null removes it. */
  set(name, filter) {
    const before = this.fails.get(name);
    const after = filter && this.failuresOf(name, filter);
    if (before) for (let row = 0; row < this.failing.length; row += 1) this.failing[row] -= before[row];
    if (after) for (let row = 0; row < this.failing.length; row += 1) this.failing[row] += after[row];
    if (after) this.fails.set(name, after);
    else this.fails.delete(name);
    this.passing = null;
  }

  failuresOf(name, filter) {
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
    if (this.passing) return this.passing;
    const rows = new Uint32Array(this.table.count);
    let count = 0;
    for (let row = 0; row < rows.length; row += 1) if (this.failing[row] === 0) rows[count++] = row;
    this.passing = rows.subarray(0, count);
    return this.passing;
  }

  /** The number of rows that pass without the filter of a column. */
  countWithout(name) {
    const own = this.fails.get(name);
    return this.failing.reduce((count, fails, row) => count + (fails === (own ? own[row] : 0) ? 1 : 0), 0);
  }

  /** For each word of a column, the number of rows that have it and pass all other filters. */
  wordCounts(name) {
    const { values, codes } = this.table.words(name);
    const own = this.fails.get(name);
    const counts = new Uint32Array(256);
    for (let row = 0; row < codes.length; row += 1) {
      if (this.failing[row] === (own ? own[row] : 0)) counts[codes[row]] += 1;
    }
    return counts.subarray(0, values.length);
  }
}
