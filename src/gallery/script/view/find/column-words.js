// Columns in words.

import { figure, isInDegrees, measureAloneInWords } from "../page-words.js";

const DERIVED_WORDS = {
  mu_worst_deg: "transmission angle at least",
  straight_tolerance: "straight within, by its length",
  straight_share: "straight portion, by the extent",
  symmetric: "symmetry",
  turn: "input",
  symmetry: "kind of symmetry",
  family: "family",
};

/** What a column is called. */
export function columnInWords(name) {
  if (name.startsWith("p.")) return `parameter ${name.slice(2)}`;
  return DERIVED_WORDS[name] ?? measureAloneInWords(name);
}

/** The number of a column as it is written beside a curve of a family. */
export function columnValueText(column, family, value) {
  if (Number.isNaN(value)) return "–";
  return isInDegrees(family, column) ? `${figure(value)}°` : figure(value);
}
