// Labels of columns.

import { formatNumber, isInDegrees, standaloneMeasureLabel } from "../labels.js";

const COLUMN_LABELS = {
  mu_worst_deg: "worst transmission angle",
  straight_tolerance: "deviation of the straight portion, by its length",
  straight_share: "length of the straight portion, by the extent",
  symmetric: "symmetry",
  turn: "input",
  symmetry: "kind of symmetry",
  family: "family",
};

/** The label of a column. */
export function columnLabel(name) {
  if (name.startsWith("p.")) return `parameter ${name.slice(2)}`;
  return COLUMN_LABELS[name] ?? standaloneMeasureLabel(name);
}

/** A number of a column, formatted for a curve of a family. */
export function columnValueText(column, family, value) {
  if (Number.isNaN(value)) return "–";
  return isInDegrees(family, column) ? `${formatNumber(value)}°` : formatNumber(value);
}
