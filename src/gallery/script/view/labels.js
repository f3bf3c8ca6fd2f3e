// Labels and formatted values, with their units.

import { measureValue } from "../data/family.js";
import { h } from "./dom.js";

/** The labels of measures other than their names in words. @type {Record<string, string>} */
const MEASURE_LABELS = {
  shortest: "shortest link",
  six_bar: "kind of six-bar",
  is_full_turn: "full turn of the input",
  mu: "transmission angle",
  bbox_x: "x",
  bbox_y: "y",
  mu_worst_deg: "worst transmission angle",
  output_swing_deg: "swing of the output",
  output_stroke: "stroke of the output",
  output_dwell_deg: "range of input of the output's dwell",
  output_dwell_start_deg: "its start input",
  toggles: "toggle positions",
  torque_peak: "greatest input torque",
  torque_peak_deg: "input at the greatest torque",
  torque_min: "least input torque, signed",
  torque_max: "greatest input torque, signed",
  length: "path length",
  symmetry_deg: "direction of the symmetry axis",
  straight_length: "length of the straight portion",
  straight_deviation: "its deviation from the line",
  straight_start_deg: "its start input",
  straight_input_deg: "its range of input",
  dwell_input_deg: "range of input of the circular portion",
  dwell_radius: "its radius",
  dwell_deviation: "its deviation from the circle",
  dwell_start_deg: "its start input",
  dwell_x: "its centre, x",
  dwell_y: "its centre, y",
};

/** The portions of a curve that measures are of, by the beginnings of their names. */
const PORTIONS = { output_dwell: "output's dwell", straight: "straight portion", dwell: "circular portion" };

/** The label of a measure outside the order of the columns. */
export function standaloneMeasureLabel(/** @type {string} */ name) {
  const portion = Object.entries(PORTIONS).find(([begins]) => name.startsWith(begins))?.[1];
  return measureLabel(name).replace(/^its ([^,]+?)(?: from the \w+)?(?=,|$)/, `$1 of the ${portion}`);
}

/** The label of a measure in the order of the columns, where "its" refers to the portion before. */
export function measureLabel(/** @type {string} */ name) {
  if (name in MEASURE_LABELS) return MEASURE_LABELS[name];
  const [, base, end] = /^(.*?)(_min|_max)?(?:_deg)?$/.exec(name) ?? [];
  const words = MEASURE_LABELS[base] ?? base.replaceAll("_", " ");
  return end ? `${end === "_min" ? "least" : "greatest"} ${words}` : words;
}

/** A number with significant digits, without trailing zeros and with a true minus sign. */
export function formatNumber(/** @type {number} */ number, digits = 4) {
  if (number === Infinity) return "unbounded";
  if (number === -Infinity) return "unbounded below";
  if (!Number.isFinite(number)) return "–";
  if (number !== 0 && (Math.abs(number) < 1e-4 || Math.abs(number) >= 1e7)) {
    const [part, power] = number.toExponential(Math.min(digits, 3) - 1).split("e");
    const raised = [...String(Number(power))].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
    return `${part} × 10${raised}`.replaceAll("-", "−");
  }
  return String(Number(number.toPrecision(digits))).replace("-", "−");
}

/**
 * The value of a measure with its unit; undefined if it does not apply.
 * @param {Family} family @param {number} curve @param {Pick<Measure, "name" | "unit">} _
 */
export function measureText(family, curve, { name, unit }) {
  const value = measureValue(family, curve, name);
  if (value === undefined || typeof value === "string") return value?.replace(/^theorem(\d)/, "theorem $1");
  return isInDegrees(family, { name, unit }) ? `${formatNumber(value)}°` : formatNumber(value);
}

/** Whether a measure of a family is in degrees: if the input is a length, inputs are not. @param {Family} _ @param {Pick<Measure, "name" | "unit">} _1 */
function isInDegrees({ is_length: isLength }, { name, unit }) {
  return unit === "deg" && !(isLength && /^(straight|dwell|output_dwell|input)_/.test(name));
}

/** A caption as on the page: names before an equals sign in italics, with no line break in "a = 2.59". */
export function formatCaption(/** @type {string} */ caption) {
  return caption
    .split(/([A-Za-z][\w]*(?= = ))/)
    .map((part, k) => (k % 2 ? h("i", part) : part.replaceAll(" = ", "\u00a0=\u00a0")));
}

/** Changed parameters, a Map of names to numbers, as a caption: "with p = 3.5, k = 2". */
export function formatChanges(/** @type {Map<string, number>} */ changes) {
  return `with ${[...changes].map(([name, value]) => `${name} = ${formatNumber(value, 10)}`).join(", ")}`;
}

/** @type {Record<string, string>} */
const COLUMN_LABELS = {
  straight_tolerance: "deviation of the straight portion, by its length",
  straight_share: "length of the straight portion, by the extent",
  symmetric: "symmetry",
  symmetry: "kind of symmetry",
};

/** The label of a column. */
export function columnLabel(/** @type {string} */ name) {
  if (name.startsWith("p.")) return `parameter ${name.slice(2)}`;
  return COLUMN_LABELS[name] ?? standaloneMeasureLabel(name);
}

/** The value of a row of a table in a column, formatted. @param {number} row */
export function rowText(/** @type {CurveTable} */ table, /** @type {Column} */ column, row) {
  if (column.kind === "words") {
    const { values, codes } = table.words(column.name);
    return values[codes[row]] ?? "–";
  }
  const value = table.numbers(column.name)[row];
  if (Number.isNaN(value)) return "–";
  return isInDegrees(table.curveOf(row).family, column) ? `${formatNumber(value)}°` : formatNumber(value);
}

/** A length or speed in four significant digits, with a true minus sign. */
export function formatLength(/** @type {number} */ value) {
  if (!Number.isFinite(value)) return "∞";
  if (value === 0) return "0";
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent < -5 || exponent > 6) return value.toExponential(3).replaceAll("-", "−");
  return formatDecimals(value, Math.max(0, 3 - exponent));
}

/** A number with a fixed number of decimals and a true minus sign. */
export function formatDecimals(/** @type {number} */ value, /** @type {number} */ decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? (0).toFixed(decimals) : text.replace("-", "−");
}

/** A count with its noun: "1 page", "7,800 curves". */
export function formatCount(/** @type {number} */ number, /** @type {string} */ one, many = `${one}s`) {
  return `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
}

/** A number of bytes in decimal units: "380 kB", "6.4 MB". */
export function formatBytes(/** @type {number} */ bytes) {
  if (bytes < 1e6) return `${Math.round(bytes / 1000)} kB`;
  return `${(bytes / 1e6).toFixed(1)} MB`;
}
