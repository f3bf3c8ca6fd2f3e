// Labels and formatted values of measures, with their units.

import { measureValue } from "../data/family.js";
import { h } from "./dom.js";

const MEASURE_LABELS = {
  class: "class",
  type: "type",
  shortest: "shortest link",
  input_min_deg: "least input",
  input_max_deg: "greatest input",
  output_swing_deg: "output swing",
  mu_min_deg: "least transmission angle",
  mu_max_deg: "greatest transmission angle",
  time_ratio: "time ratio",
  length: "path length",
  area: "area",
  bbox_x_min: "least x",
  bbox_x_max: "greatest x",
  bbox_y_min: "least y",
  bbox_y_max: "greatest y",
  cusps: "cusps",
  crunodes: "crunodes",
  inflections: "inflections",
  symmetry: "symmetry",
  symmetry_deg: "direction of the symmetry axis",
  symmetry_residual: "symmetry residual",
  curvature_max: "greatest curvature",
  speed_ratio: "speed ratio",
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

const STANDALONE_LABELS = {
  straight_deviation: "deviation of the straight portion",
  straight_start_deg: "start input of the straight portion",
  straight_input_deg: "range of input of the straight portion",
  dwell_radius: "radius of the circular portion",
  dwell_deviation: "deviation of the circular portion",
  dwell_start_deg: "start input of the circular portion",
  dwell_x: "centre of the circular portion, x",
  dwell_y: "centre of the circular portion, y",
};

/** The label of a measure outside the order of the columns. */
export function standaloneMeasureLabel(name) {
  return STANDALONE_LABELS[name] ?? measureLabel(name);
}

/** The label of a measure in the order of the columns, where "its" refers to the portion before. */
export function measureLabel(name) {
  return MEASURE_LABELS[name] ?? name.replace(/_deg$/, "").replaceAll("_", " ");
}

/** A number with significant digits, without trailing zeros and with a true minus sign. */
export function formatNumber(number, digits = 4) {
  if (number === Infinity) return "unbounded";
  if (!Number.isFinite(number)) return "–";
  if (number !== 0 && (Math.abs(number) < 1e-4 || Math.abs(number) >= 1e7)) {
    const [part, power] = number.toExponential(Math.min(digits, 3) - 1).split("e");
    const raised = [...String(Number(power))].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
    return `${part} × 10${raised}`.replaceAll("-", "−");
  }
  return String(Number(number.toPrecision(digits))).replace("-", "−");
}

/** The value of a measure with its unit; undefined if it does not apply. */
export function measureText(family, curve, { name, unit }) {
  const value = measureValue(family, curve, name);
  if (value === undefined || typeof value === "string") return value?.replace(/^theorem(\d)/, "theorem $1");
  return isInDegrees(family, { name, unit }) ? `${formatNumber(value)}°` : formatNumber(value);
}

/** Whether a measure of a family is in degrees: if the input is a length, inputs are not. */
export function isInDegrees({ template }, { name, unit }) {
  const isLength = template.joints.some((joint) => joint.piston !== undefined);
  return unit === "deg" && !(isLength && /^(straight|dwell|input)_/.test(name));
}

/** A caption as on the page: names before an equals sign in italics, with no line break in "a = 2.59". */
export function formatCaption(caption) {
  return caption
    .split(/([A-Za-z][\w]*(?= = ))/)
    .map((part, k) => (k % 2 ? h("i", {}, part) : part.replaceAll(" = ", "\u00a0=\u00a0")));
}

/** Changed parameters, a Map of names to numbers, as a caption: "with p = 3.5, k = 2". */
export function formatChanges(changes) {
  return `with ${[...changes].map(([name, value]) => `${name} = ${formatNumber(value, 10)}`).join(", ")}`;
}
