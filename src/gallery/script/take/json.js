// Everything that is known of a curve, for programs: docs/export.md describes it.

import { inputDirection } from "../kinematics/pass.js";
import { sideOf } from "../kinematics/assembly-mode.js";
import { pointColumns, pointRows } from "./csv.js";
import { laidOutJson } from "./layout.js";
import { takenMeasures } from "./taken.js";

/** The version of the format. */
const TAKEN_JSON_FORMAT = 1;

/** A taken curve as JSON; `measures` are the names of all measures, in the order of the atlas. */
export function jsonOfCurve(taken, measures) {
  const { name, family, cell, trace, circuit, values, linkage, motion, joint, status, reason } = taken;
  const width = family.template.parameters.length;
  const named = (from, to) =>
    Object.fromEntries(family.names.slice(from, to).map((word, k) => [word, values[from + k]]));
  const { step, samples, spacing } = family.sampling;
  return laidOutJson({
    format: TAKEN_JSON_FORMAT,
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
    circuits: motion.circuits.map((course) => circuitInJson(linkage, course)),
    columns: pointColumns(taken),
    points: pointRows(taken),
    measures: Object.fromEntries(takenMeasures(taken, measures)),
  });
}

// Of every pass its ends, with the joints whose dyads lie flat there, and the sides of all two-valued joints.
function circuitInJson(linkage, course) {
  const end = ({ at, flat }) => {
    const isFlat = ({ step }) =>
      step.index !== undefined && step.index !== null && ((flat >> step.index) & 1) === 1;
    return { input: at, flat: linkage.joints.filter(isFlat).map((joint) => joint.name) };
  };
  const passes = course.passes.map((pass, k) => ({
    from: end(pass.begin),
    to: end(pass.end),
    branches: Array.from({ length: linkage.dyads }, (_, dyad) => sideOf(pass.signs, dyad)),
    turns: turnsAfterPass(course, k),
  }));
  return { closed: course.closed, passes };
}

// Whether the input turns round at the end of a pass.
function turnsAfterPass({ passes, closed }, k) {
  const isLast = k + 1 === passes.length;
  return (!isLast || closed) && inputDirection(passes[k]) !== inputDirection(passes[(k + 1) % passes.length]);
}
