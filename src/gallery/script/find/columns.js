// The columns of a table that can be filtered, the most useful first.

import { NO_WORD } from "../data/family.js";
import { DERIVED_COLUMNS } from "./table.js";

const FIRST_WORDS = ["class", "symmetric", "is_full_turn"];
const OF_STRAIGHT_PORTION = ["straight_length", "straight_tolerance", "straight_share"];
const FIRST_COLUMNS = ["mu_worst_deg", ...FIRST_WORDS, ...OF_STRAIGHT_PORTION, "length", "time_ratio"];
const WORD_COLUMNS = [...FIRST_WORDS, "type", "shortest", "symmetry"];

/** Whether rows sorted by a column begin with the greatest value, which is the best. @param {Measure[]} measures @param {string} name */
export const beginsWithGreatest = (measures, name) =>
  measures.some((measure) => measure.name === name && measure.is_more_better);

/**
 * The columns of a table with at least two different values. Columns in `kept` (their names) are always included.
 * @param {CurveTable} table @param {Measure[]} measures @returns {Column[]}
 */
export function filterColumns(table, measures, kept = new Set()) {
  const byName = new Map(measures.map((measure) => [measure.name, measure]));
  const [words, numbers] = [true, false].map((isWord) => measures.filter(({ word }) => word === isWord));
  const measured = [...words, ...numbers].map(({ name }) => name);
  const parameters = table.families.flatMap(({ names }) => names).map((name) => `p.${name}`);
  const names = new Set([...FIRST_COLUMNS, ...WORD_COLUMNS, ...measured, ...parameters]);
  const listed = Array.from(names, (name) => {
    const own = name.replace(/^p\./, "parameter ");
    const { title = own, unit = "", definition = "" } = DERIVED_COLUMNS[name] ?? byName.get(name) ?? {};
    /** @type {ColumnGroup} */
    const group = FIRST_COLUMNS.includes(name) ? "first" : name.startsWith("p.") ? "parameters" : "more";
    /** @type {Column["kind"]} */
    const kind = WORD_COLUMNS.includes(name) || byName.get(name)?.word ? "words" : "numbers";
    return { name, title, group, kind, unit, definition };
  });
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
  const first = values.find((value) => !Number.isNaN(value));
  if (values.some((value) => value !== first && !Number.isNaN(value))) return true;
  // A column that is not offered needs no memory.
  table.release(name);
  return false;
}
