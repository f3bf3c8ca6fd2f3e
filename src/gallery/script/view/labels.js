// Labels and formatted values, with their units.

import { measureValue } from "../data/family.js";
import { h } from "./dom.js";

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
  if (!Number.isFinite(value)) return value === -Infinity ? "−∞" : "∞";
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
