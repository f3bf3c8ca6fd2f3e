// Looks up a curve by its name and solves it for export, sampled as in the atlas.

import { LinkageError } from "../kinematics/linkage-builder.js";
import { changedValues, templateWithChanges } from "../kinematics/parameter-changes.js";
import { motionOf } from "../kinematics/motion.js";
import { linkageOf } from "../kinematics/template.js";
import { measuresOf } from "../measure/measures.js";
import { findCurve, measureValue } from "../data/family.js";
import { shortestDigits } from "./digits.js";

/**
 * Parses the name of a curve, "evans:12.1.1?p=2.5&k=2": { family, key, cell, trace, circuit, changes: Map of
 * names to numbers }; null if it is not a name. The change "circuit" selects a circuit by its number among
 * all circuits of the linkage; an atlas of one circuit for each cell does not contain the others.
 */
export function parseCurveName(name) {
  const found = /^([^:?]+):((\d+)\.(\d+)\.(\d+))(?:\?(.*))?$/.exec(name);
  if (!found) return null;
  const [, family, key, cell, trace, circuit, query] = found;
  const pairs = (query ?? "")
    .split("&")
    .filter(Boolean)
    .map((pair) => {
      const [word, value] = pair.split("=", 2);
      return [decodeURIComponent(word), Number(value)];
    });
  return {
    family,
    key,
    cell: Number(cell),
    trace: Number(trace),
    circuit: Number(circuit),
    changes: new Map(pairs),
  };
}

/** Separates changed parameters from the number of an extra circuit, which is null if there is none. */
function splitChanges(family, all) {
  const extraCircuit = family.names.includes("circuit") ? null : (all?.get("circuit") ?? null);
  const changes = new Map([...(all ?? [])].filter(([word]) => extraCircuit === null || word !== "circuit"));
  return { changes, extraCircuit };
}

/**
 * Solves the curve with a name of `family`: { name, family, cell (number), place (the cell's index), curve
 * (index), trace, circuit (number), extraCircuit (the circuit's number if the atlas does not contain it, else
 * null), changes, values, template, linkage, motion, circuitSamples, joint, status, reason }.
 * For an extra circuit, the motion has all circuits.
 *
 * @throws {Error} a sentence that says why there is no such curve
 */
export function solveNamedCurve(family, name) {
  const parsed = parseCurveName(name) ?? {};
  const { key, cell, trace } = parsed;
  const { changes, extraCircuit } = splitChanges(family, parsed.changes);
  const circuit = extraCircuit ?? parsed.circuit;
  const curve = findCurve(family, key);
  if (curve === undefined) throw new Error(`there is no curve “${name}” in this atlas`);
  const place = family.curves.cell[curve];
  const values = changedValues(family, place, changes);
  const changed = templateWithChanges(family.template, trace, values, changes);
  const template = extraCircuit === null ? changed.template : { ...changed.template, circuits: "all" };
  const { linkage, motion } = solveMotion(template, values, family.sampling, name);
  const circuitSamples = motion.circuits[circuit - 1];
  if (!circuitSamples) throw new Error(`${name}: ${motion.shortfall ?? "this circuit no longer exists"}`);
  const joint = linkage.traced[(changed.trace ?? linkage.traced.length) - 1];
  const reason = motion.shortfall ?? null;
  const status = reason === null ? "ok" : "partial";
  return {
    name: formatCurveName(family.id, key, changes, extraCircuit),
    family,
    cell,
    place,
    curve,
    trace,
    circuit,
    extraCircuit,
    changes,
    values,
    template,
    linkage,
    motion,
    circuitSamples,
    joint,
    status,
    reason,
  };
}

/**
 * The manifest case of the curve with a name of `family`: { family, name, trace, extraCircuit, values,
 * changes }. Solves nothing.
 */
export function manifestCase(family, name) {
  const { key, trace, changes: all } = parseCurveName(name) ?? {};
  const { changes, extraCircuit } = splitChanges(family, all);
  const curve = findCurve(family, key);
  if (curve === undefined) throw new Error(`there is no curve “${name}” in this atlas`);
  const values = changedValues(family, family.curves.cell[curve], changes);
  const fullName = formatCurveName(family.id, key, changes, extraCircuit);
  return { family, name: fullName, trace, extraCircuit, values, changes };
}

// If the linkage cannot be assembled, the error names the curve.
function solveMotion(template, values, sampling, name) {
  try {
    const linkage = linkageOf(template, values);
    return { linkage, motion: motionOf(linkage, sampling) };
  } catch (error) {
    if (error instanceof LinkageError) throw new Error(`${name}: ${error.message}`);
    throw error;
  }
}

function formatCurveName(id, key, changes, extraCircuit) {
  const all = extraCircuit === null ? [...changes] : [...changes, ["circuit", extraCircuit]];
  const changed = all.map(([name, value]) => `${name}=${shortestDigits(value)}`);
  return changed.length > 0 ? `${id}:${key}?${changed.join("&")}` : `${id}:${key}`;
}

/**
 * The name of the curve's file without its extension: "evans-12-1-1", "evans-12-1-1-p-2.5", or, for a circuit
 * that the atlas does not contain, "evans-12-1-circuit-2".
 */
export function fileStem({ family, cell, trace, circuit, extraCircuit, changes }) {
  const changed = [...changes].map(([name, value]) => `-${name}-${shortestDigits(value)}`);
  const number = extraCircuit === null ? circuit : `circuit-${extraCircuit}`;
  return `${family.id}-${cell}-${trace}-${number}${changed.join("")}`;
}

/**
 * The measures `names` of an exported curve, [[name, number | string | null], …]: those of the atlas, or
 * computed if parameters are changed or the atlas does not contain the circuit.
 */
export function measuresOfCurve(exported, names) {
  const { family, curve, changes, extraCircuit, linkage, motion, circuitSamples, joint } = exported;
  if (changes.size === 0 && extraCircuit === null)
    return names.map((name) => [name, measureValue(family, curve, name) ?? null]);
  const found = measuresOf(linkage, motion, circuitSamples, joint, { straight: family.straight });
  return names.map((name) => [name, found[name] ?? null]);
}

/**
 * The pose of the linkage in CAD files: { x, y } of a joint at the sample a third of the way through the
 * circuit, where no dyad of an oscillating linkage is near its limit.
 */
export function exportPose({ circuitSamples: { x, y, count } }) {
  const sample = Math.floor(count / 3);
  return (joint) => ({ x: x[joint][sample], y: y[joint][sample] });
}
