// Sorts rows by a column.

import { NO_WORD } from "../data/family.js";

/** The sort orders of a table's rows, cached. */
export class Orders {
  constructor(table) {
    this.table = table;
    this.cache = new Map();
  }

  /**
   * All rows sorted by a column of numbers or words (`kind`), ascending, or descending if `down`. Rows
   * without a value come last in both cases; ties keep the table's order. Without a name, the table's order.
   */
  by(name, kind, down) {
    const key = `${down ? "-" : ""}${kind} ${name}`;
    if (!this.cache.has(key)) this.cache.set(key, this.compute(name, kind, down));
    return this.cache.get(key);
  }

  compute(name, kind, down) {
    const rows = Uint32Array.from({ length: this.table.count }, (_, row) => row);
    if (!name) return rows;
    const values = kind === "words" ? wordRanks(this.table.words(name)) : this.table.numbers(name);
    const sign = down ? -1 : 1;
    return rows.sort((a, b) => {
      const [u, v] = [values[a], values[b]];
      if (Number.isNaN(u) || Number.isNaN(v)) return Number.isNaN(u) - Number.isNaN(v) || a - b;
      // The difference of equal infinities is NaN.
      return (u === v ? 0 : sign * (u < v ? -1 : 1)) || a - b;
    });
  }
}

function wordRanks({ values, codes }) {
  const sorted = [...values].sort();
  const ranks = values.map((word) => sorted.indexOf(word));
  return Float64Array.from(codes, (code) => (code === NO_WORD ? NaN : ranks[code]));
}

/** The rows of an order that pass. */
export function passingRows(order, failing) {
  const rows = new Uint32Array(order.length);
  let count = 0;
  for (let k = 0; k < order.length; k += 1) if (failing[order[k]] === 0) rows[count++] = order[k];
  return rows.subarray(0, count);
}
