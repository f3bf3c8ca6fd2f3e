// Writes everything known about a curve as JSON; docs/export.md describes the format.

import { inputDirection } from "../kinematics/pass.js";
import { sideOf } from "../kinematics/assembly-mode.js";
import { pointColumns, pointRows } from "./csv.js";
import { prettyJson } from "./pretty-json.js";
import { measuresOfCurve } from "./curve.js";

/** The version of the format. */
const JSON_FORMAT_VERSION = 1;

/** An exported curve as JSON; `measures` are the names of all measures, in the order of the atlas. */
export function jsonOfCurve(exported, measures) {
  const { name, family, cell, trace, circuit, values, linkage, motion, joint, status, reason } = exported;
  const width = family.template.parameters.length;
  const named = (from, to) =>
    Object.fromEntries(family.names.slice(from, to).map((word, k) => [word, values[from + k]]));
  const { step, samples, spacing } = family.sampling;
  return prettyJson({
    format: JSON_FORMAT_VERSION,
    curve: name,
    family: family.id,
    linkage: family.template.id,
    cell,
    trace,
    circuit,
    joint: linkage.joints[joint].name,
    parameters: named(0, width),
    helpers: named(width, family.names.length),
    sampling:
      step !== undefined ? { step } : spacing && spacing !== "even" ? { samples, spacing } : { samples },
    status,
    reason,
    circuits: motion.circuits.map((circuitSamples) => circuitInJson(linkage, circuitSamples)),
    columns: pointColumns(exported),
    points: pointRows(exported),
    measures: Object.fromEntries(measuresOfCurve(exported, measures)),
  });
}

// The ends of each pass, the joints whose dyads are extended or folded there, and the sides of all two-valued
// joints.
function circuitInJson(linkage, circuitSamples) {
  const end = ({ at, flat }) => {
    const isFlat = ({ step }) =>
      step.index !== undefined && step.index !== null && ((flat >> step.index) & 1) === 1;
    return { input: at, flat: linkage.joints.filter(isFlat).map((joint) => joint.name) };
  };
  const passes = circuitSamples.passes.map((pass, k) => ({
    from: end(pass.begin),
    to: end(pass.end),
    branches: Array.from({ length: linkage.dyads }, (_, dyad) => sideOf(pass.signs, dyad)),
    turns: turnsAfterPass(circuitSamples, k),
  }));
  return { closed: circuitSamples.closed, passes };
}

// Whether the input reverses at the end of a pass.
function turnsAfterPass({ passes, closed }, k) {
  const isLast = k + 1 === passes.length;
  return (!isLast || closed) && inputDirection(passes[k]) !== inputDirection(passes[(k + 1) % passes.length]);
}
