// A curve that is taken away: found by its name, and solved anew as the atlas sampled it.

import { LinkageError } from "../kinematics/linkage-builder.js";
import { changedValues, templateWithChanges } from "../kinematics/parameter-changes.js";
import { motionOf } from "../kinematics/motion.js";
import { linkageOf } from "../kinematics/template.js";
import { measuresOf } from "../measure/measures.js";
import { measured } from "../data/family.js";
import { shortestDigits } from "./digits.js";

/**
 * What a name says, "evans:12.1.1?p=2.5&k=2": { family, key, cell, trace, circuit, changes: Map of names to
 * numbers }; null where it is none. The change "circuit" is another circuit of the linkage, counted from 1
 * among all that it has, which an atlas that takes one alone does not have.
 */
export function parsedName(name) {
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

/** The changes of a name apart: those of parameters, and another circuit's number, or null. */
function changesApart(family, all) {
  const beside = family.names.includes("circuit") ? null : (all?.get("circuit") ?? null);
  const changes = new Map([...(all ?? [])].filter(([word]) => beside === null || word !== "circuit"));
  return { changes, beside };
}

/**
 * The curve of a name of `family`, solved: { name, family, cell (its number), place (its cell's, from 0),
 * curve (its place, from 0), trace, circuit (its number), beside (the same, of a circuit that the name asks
 * for beside the atlas, else null), changes, values, template, linkage, motion, course (the sampled circuit),
 * joint, status, reason }. The motion of such a circuit is that of all circuits.
 *
 * @throws {Error} a sentence on why there is no such curve
 */
export function takenCurve(family, name) {
  const parsed = parsedName(name) ?? {};
  const { key, cell, trace } = parsed;
  const { changes, beside } = changesApart(family, parsed.changes);
  const circuit = beside ?? parsed.circuit;
  const curve = family.places.get(key);
  if (curve === undefined) throw new Error(`there is no curve “${name}” in this atlas`);
  const place = family.curves.cell[curve];
  const values = changedValues(family, place, changes);
  const changed = templateWithChanges(family.template, trace, values, changes);
  const template = beside === null ? changed.template : { ...changed.template, circuits: "all" };
  const { linkage, motion } = solvedMotion(template, values, family.sampling, name);
  const course = motion.circuits[circuit - 1];
  if (!course) throw new Error(`${name}: ${motion.shortfall ?? "this circuit is there no more"}`);
  const joint = linkage.traced[(changed.trace ?? linkage.traced.length) - 1];
  const reason = motion.shortfall ?? null;
  const status = reason === null ? "ok" : "partial";
  return {
    name: fullName(family.id, key, changes, beside),
    family,
    cell,
    place,
    curve,
    trace,
    circuit,
    beside,
    changes,
    values,
    template,
    linkage,
    motion,
    course,
    joint,
    status,
    reason,
  };
}

/**
 * What a manifest has to say of the curve of a name of `family`: { family, name, trace, beside, values,
 * changes }; nothing is solved.
 */
export function namedCase(family, name) {
  const { key, trace, changes: all } = parsedName(name) ?? {};
  const { changes, beside } = changesApart(family, all);
  const curve = family.places.get(key);
  if (curve === undefined) throw new Error(`there is no curve “${name}” in this atlas`);
  const values = changedValues(family, family.curves.cell[curve], changes);
  return { family, name: fullName(family.id, key, changes, beside), trace, beside, values, changes };
}

// A linkage that cannot be put together is told of by its curve's name.
function solvedMotion(template, values, sampling, name) {
  try {
    const linkage = linkageOf(template, values);
    return { linkage, motion: motionOf(linkage, sampling) };
  } catch (error) {
    if (error instanceof LinkageError) throw new Error(`${name}: ${error.message}`);
    throw error;
  }
}

function fullName(id, key, changes, beside) {
  const all = beside === null ? [...changes] : [...changes, ["circuit", beside]];
  const changed = all.map(([name, value]) => `${name}=${shortestDigits(value)}`);
  return changed.length > 0 ? `${id}:${key}?${changed.join("&")}` : `${id}:${key}`;
}

/**
 * The name of a taken curve's file, without its ending: "evans-12-1-1", "evans-12-1-1-p-2.5", and, on a
 * circuit beside the atlas, "evans-12-1-circuit-2".
 */
export function fileStem({ family, cell, trace, circuit, beside, changes }) {
  const changed = [...changes].map(([name, value]) => `-${name}-${shortestDigits(value)}`);
  const number = beside === null ? circuit : `circuit-${beside}`;
  return `${family.id}-${cell}-${trace}-${number}${changed.join("")}`;
}

/**
 * What is measured of a taken curve, [[name, number | string | null], …] under `names` and in their order: as
 * the atlas has it, or, of one with changed parameters or beside it, taken anew.
 */
export function takenMeasures(taken, names) {
  const { family, curve, changes, beside, linkage, motion, course, joint } = taken;
  if (changes.size === 0 && beside === null) return names.map((name) => [name, measured(family, curve, name) ?? null]);
  const found = measuresOf(linkage, motion, course, joint, { straight: family.straight });
  return names.map((name) => [name, found[name] ?? null]);
}

/**
 * The pose a linkage is shown in for CAD: { x, y } of a joint at the sample a third of the way through its
 * circuit, where no dyad of a linkage that goes there and back is near its limit.
 */
export function takenPose({ course: { x, y, count } }) {
  const sample = Math.floor(count / 3);
  return (joint) => ({ x: x[joint][sample], y: y[joint][sample] });
}
