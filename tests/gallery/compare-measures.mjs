// Compares the page's measures with the program's.

import { measuresOf } from "../../src/gallery/script/measure/measures.js";

// The tolerance by the size of a value: positions agree to 1e-12, and measures lose some more digits.
const VALUE_TOLERANCE = 1e-7;
// The direction of an axis is exact to the root of its residual's rounding; which of several equal maxima of
// curvature is found depends on their last bits.
const LOOSER_TOLERANCE = { symmetry_deg: 1e-4, curvature_max: 1e-4 };
// Where a path reverses and retraces itself, the circle through the last sample and its neighbours, which are
// one point, depends on their last bits, in the program as in the page; and so do measures of curvature.
const OF_BENDS = /^(length|area|crunodes|inflections|cusps|curvature_max|symmetry|straight|dwell)/;
// The tolerances of angles and residuals, which have a natural size.
const SMALL = 1e-6;
// Portions are searched: of several that are nearly as good another may be found, within this tolerance.
const PORTION_LONGER = 1e-3;
const PORTION_SHORTER = 0.01;

const deviations = new Map();
let [curves, time] = [0, 0];

/** Compares the measures of one case; `complain(name, sentence)` is called for each disagreement. */
export function compareMeasures({ name, measures, straight = {} }, linkage, motion, complain) {
  const size = sizeOfMotion(motion);
  for (const { trace, circuit, values } of measures) {
    // The curve of a joint that is at rest for the observer consists of rounding errors.
    if (extentOf(values) < 1e-12 * size) continue;
    const begun = performance.now();
    const found = measuresOf(linkage, motion, motion.circuits[circuit - 1], linkage.traced[trace - 1], {
      straight: straight ?? {},
    });
    time += performance.now() - begun;
    curves += 1;
    const where = `${name}, trace ${trace}, circuit ${circuit}`;
    const isRetraced = isRetracedBy(
      motion.circuits[circuit - 1],
      linkage.traced[trace - 1],
      extentOf(values),
    );
    for (const [measure, expected] of Object.entries(values)) {
      if (isRetraced && OF_BENDS.test(measure)) continue;
      const sentence = disagreement(
        measure,
        found[measure],
        expected === "inf" ? Infinity : expected,
        values,
        where,
      );
      if (sentence) complain(where, sentence);
    }
  }
}

function disagreement(measure, found, expected, values, where) {
  if (measure.startsWith("straight_") || measure.startsWith("dwell_"))
    return portionDisagreement(measure, found, expected, where);
  if (expected === null || typeof expected === "string" || !Number.isFinite(expected)) {
    return (found ?? null) === expected ? null : `${measure} is ${found}, not ${expected}`;
  }
  if (typeof found !== "number") return `${measure} is ${found}, not ${expected}`;
  const period = measure === "symmetry_deg" ? 180 : Infinity;
  const apart = Math.abs(found - expected);
  const off =
    apart === 0 ? 0 : Math.min(apart, period - apart) / Math.max(Math.abs(expected), sizeOf(measure, values));
  note(measure, off, where);
  return off <= (LOOSER_TOLERANCE[measure] ?? VALUE_TOLERANCE)
    ? null
    : `${measure} is ${found}, not ${expected}`;
}

function isRetracedBy({ input, x, y, count, closed }, joint, extent) {
  const apart = (i, j) => Math.hypot(x[joint][i] - x[joint][j], y[joint][i] - y[joint][j]);
  for (let i = closed ? 0 : 1; i < (closed ? count : count - 1); i++) {
    const [before, after] = [(i + count - 1) % count, (i + 1) % count];
    const turns = (input[i] - input[before]) * (input[after] - input[i]) < 0;
    if (turns && apart(before, after) <= 1e-7 * extent && apart(i, after) > 1e-6 * extent) return true;
  }
  return false;
}

function sizeOfMotion({ circuits }) {
  let size = 0;
  for (const { x, y } of circuits) {
    for (const column of [...x, ...y]) for (const at of column) if (Math.abs(at) > size) size = Math.abs(at);
  }
  return size;
}

function extentOf(values) {
  return Math.max(values.bbox_x_max - values.bbox_x_min, values.bbox_y_max - values.bbox_y_min);
}

function portionDisagreement(measure, found, expected, where) {
  if (expected === null || found === undefined) {
    return (found ?? null) === expected ? null : `${measure} is ${found}, not ${expected}`;
  }
  // Of portions that are as good, another one may be found.
  if (measure !== "straight_length" && measure !== "dwell_input_deg") return null;
  const longer = found / expected - 1;
  note(measure, Math.abs(longer), where);
  return longer <= PORTION_LONGER && longer >= -PORTION_SHORTER
    ? null
    : `${measure} is ${found}, not ${expected}`;
}

// The size that a deviation is compared with if the value is near zero.
function sizeOf(measure, values) {
  if (measure === "area") return values.length * values.length;
  if (measure.endsWith("_deg")) return 1;
  if (measure.startsWith("bbox") || measure === "length") return Math.max(extentOf(values), SMALL);
  return measure === "symmetry_residual" ? 1 : SMALL;
}

function note(measure, off, where) {
  if (!(off <= (deviations.get(measure)?.off ?? 0))) deviations.set(measure, { off, where });
}

/** A line with the greatest deviations found and the time taken. */
export function measureSummary() {
  if (curves === 0) return "no measures";
  const each = [...deviations].map(
    ([measure, { off, where }]) => `${measure} ${off.toExponential(1)} (${where})`,
  );
  return `measures of ${curves} curves, ${(time / curves).toFixed(1)} ms each: ${each.join("; ")}`;
}
