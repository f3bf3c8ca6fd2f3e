// The columns of a table that can be filtered, the most useful first.

import { NO_WORD } from "../data/family.js";
import { DERIVED_COLUMNS } from "./table.js";

const FIRST_WORDS = ["class", "symmetric", "is_full_turn"];
const FIRST_NUMBERS = [
  "mu_worst_deg",
  "straight_length",
  "straight_tolerance",
  "straight_share",
  "length",
  "time_ratio",
];
const LATER_WORDS = ["type", "shortest", "symmetry"];
// The measures of which more is better: transmission angles and forces, and how far an output, a straight portion or a dwell goes.
const MORE_IS_BETTER =
  /^(mu_(min|worst)|output_(swing|dwell)|dwell_input|straight\w*_input)_deg$|^straight\w*_(length|share)$|^mechanical|_stroke$/;

/** Whether rows sorted by a column begin with the greatest value, which is the best; otherwise with the least. */
export const beginsWithGreatest = (/** @type {string} */ name) => MORE_IS_BETTER.test(name);

/**
 * The columns of a table with at least two different values. Columns in `kept` (their names) are always included.
 * @param {CurveTable} table @param {Measure[]} measures @returns {Column[]}
 */
export function filterColumns(table, measures, kept = new Set()) {
  const byName = new Map(measures.map((measure) => [measure.name, measure]));
  const numbers = measures.filter(({ word }) => !word).map(({ name }) => name);
  const words = measures.filter(({ word }) => word).map(({ name }) => name);
  const parameters = [...new Set(table.families.flatMap(({ names }) => names))].map((name) => `p.${name}`);
  const column =
    (/** @type {ColumnGroup} */ group, /** @type {Column["kind"]} */ kind) =>
    (/** @type {string} */ name) => {
      const { unit = "", definition = "" } = DERIVED_COLUMNS[name] ?? byName.get(name) ?? {};
      return { name, group, kind, unit, definition };
    };
  const listed = [
    ...FIRST_NUMBERS.slice(0, 1).map(column("first", "numbers")),
    ...FIRST_WORDS.map(column("first", "words")),
    ...FIRST_NUMBERS.slice(1).map(column("first", "numbers")),
    ...[...LATER_WORDS, ...words.filter((name) => ![...FIRST_WORDS, ...LATER_WORDS].includes(name))].map(
      column("more", "words"),
    ),
    ...numbers.filter((name) => !FIRST_NUMBERS.includes(name)).map(column("more", "numbers")),
    ...parameters.map(column("parameters", "numbers")),
  ];
  const isThere = (/** @type {string} */ name) => !byName.has(name) || table.has(name);
  const hasDistinctValues = (/** @type {Column} */ { name, kind }) =>
    isThere(name) && (kind === "words" ? hasDistinctWords(table, name) : hasDistinctNumbers(table, name));
  return listed.filter((one) => kept.has(one.name) || hasDistinctValues(one));
}

function hasDistinctWords(/** @type {CurveTable} */ table, /** @type {string} */ name) {
  const { codes } = table.words(name);
  const first = codes[0];
  return codes.some((code) => code !== first) && codes.some((code) => code !== NO_WORD);
}

function hasDistinctNumbers(/** @type {CurveTable} */ table, /** @type {string} */ name) {
  const values = table.numbers(name);
  let first = NaN;
  for (let row = 0; row < values.length; row += 1) {
    if (Number.isNaN(values[row])) continue;
    if (Number.isNaN(first)) first = values[row];
    else if (values[row] !== first) return true;
  }
  // A column that is not offered needs no memory.
  table.release(name);
  return false;
}
