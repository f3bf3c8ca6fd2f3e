// Columns in words.

import { formatNumber, isInDegrees, standaloneMeasureLabel } from "../labels.js";

const COLUMN_LABELS = {
  mu_worst_deg: "transmission angle at least",
  straight_tolerance: "straight within, by its length",
  straight_share: "straight portion, by the extent",
  symmetric: "symmetry",
  turn: "input",
  symmetry: "kind of symmetry",
  family: "family",
};

/** What a column is called. */
export function columnLabel(name) {
  if (name.startsWith("p.")) return `parameter ${name.slice(2)}`;
  return COLUMN_LABELS[name] ?? standaloneMeasureLabel(name);
}

/** The number of a column as it is written beside a curve of a family. */
export function columnValueText(column, family, value) {
  if (Number.isNaN(value)) return "–";
  return isInDegrees(family, column) ? `${formatNumber(value)}°` : formatNumber(value);
}
