// The study of a linkage: the assembled linkage, all its circuits, and the one shown.

import { changedValues, templateWithChanges } from "../../kinematics/parameter-changes.js";
import { findCircuits } from "../../kinematics/circuit.js";
import { LinkageError } from "../../kinematics/linkage-builder.js";
import { fourBarOf, isOnCoupler } from "../../kinematics/four-bar.js";
import { linkageOf } from "../../kinematics/template.js";
import { finePath } from "../../kinematics/path.js";
import { sampleCircuit, newSampler } from "../../kinematics/sampling.js";
import { sideOf } from "../../kinematics/assembly-mode.js";
import { mechanismOf, sweptBox } from "../../draw/mechanism.js";
import { emptyBox, widenedBox } from "../../draw/plane-view.js";
import { timelineOf } from "./timeline.js";

// The number of samples of a circuit for other points and for rough updates.
const STUDY_SAMPLES = 240;

/**
 * The study of a curve of a family with changes (kinematics/parameter-changes.js): { values, reason } if it
 * cannot be assembled, with `reason` a sentence; otherwise { values, linkage, routes, home, shown, shortfall,
 * circuit, joint, others, timeline, mechanism, box, size, fourBar, isCouplerPoint, template }.
 *
 * `routes` are all circuits { passes, closed }; `home` is the index of the one that the address names,
 * `shown` of the one that is shown, which is `requested` if it exists; -1 if there is none. `circuit` is the
 * shown circuit, sampled; `joint` is the traced joint, `others` are further traced joints. `box` is the area
 * swept by the linkage. A rough study without a requested circuit has no other circuits.
 */
export function studyOf(family, curve, changes, requested = null, isRough = false) {
  const { cell, trace, circuit } = family.curves;
  const values = changedValues(family, cell[curve], changes);
  const changed = templateWithChanges(family.template, trace[curve], values, changes);
  let linkage = null;
  try {
    linkage = linkageOf(changed.template, values);
  } catch (error) {
    if (!(error instanceof LinkageError)) throw error;
    return { values, reason: error.message };
  }
  const recorded = findCircuits(linkage);
  const all =
    isRough && requested === null
      ? recorded
      : findCircuits({ ...linkage, travel: { ...linkage.travel, circuits: "all" } });
  const { routes } = all;
  if (routes.length === 0) return { values, reason: all.shortfall ?? "no input allows assembly" };
  const home = indexOfRoute(routes, recorded.routes[circuit[curve] - 1]);
  const shown = routes[requested] ? requested : home;
  if (shown < 0) {
    const reason =
      recorded.shortfall ??
      "the circuit of this curve no longer exists: it has merged with another, or split";
    return { values, linkage, routes, home, shown, reason };
  }
  const study = {
    values,
    linkage,
    routes,
    home,
    shown,
    shortfall: recorded.shortfall,
    template: changed.template,
  };
  return { ...study, ...studyShownCircuit(study, changed.trace ?? linkage.traced.length) };
}

function studyShownCircuit({ linkage, routes, shown }, trace) {
  const circuit = sampleCircuit(
    linkage,
    newSampler({ samples: STUDY_SAMPLES, spacing: "smooth" }),
    routes[shown],
  );
  const joint = linkage.traced[trace - 1];
  const mechanism = mechanismOf(linkage, circuit, joint);
  const others = linkage.traced.filter((other) => other !== joint);
  const box = boxWithOthers(sweptBox(mechanism, circuit, [joint]), circuit, others);
  const curveBox = widenedBox(emptyBox(), circuit.x[joint], circuit.y[joint], circuit.count);
  const size = Math.hypot(box[2] - box[0], box[3] - box[1]);
  if (!(size > 0) || !Number.isFinite(size))
    return { reason: "its lengths differ too much to be drawn" };
  const fourBar = fourBarOf(linkage);
  const isCouplerPoint = fourBar !== null && isOnCoupler(linkage, fourBar, joint);
  return {
    circuit,
    joint,
    others,
    timeline: timelineOf(routes[shown]),
    mechanism,
    box,
    curveBox,
    size,
    fourBar,
    isCouplerPoint,
  };
}

// The frame includes the curves of other points unless the linkage would become small in it.
function boxWithOthers(box, circuit, others) {
  const wide = [...box];
  for (const other of others) widenedBox(wide, circuit.x[other], circuit.y[other], circuit.count);
  const extent = ([x0, y0, x1, y1]) => Math.max(x1 - x0, y1 - y0);
  return extent(wide) <= 1.6 * extent(box) ? wide : box;
}

/** The path of a study's traced joint, accurate to a fraction of its size. */
export function pathOfStudy({ linkage, circuit, joint, size }, part) {
  return finePath(linkage, circuit, joint, part * size);
}

function indexOfRoute(routes, route) {
  if (!route) return -1;
  const [first] = route.passes;
  const isOn = ({ passes }) =>
    passes.some(
      (pass) =>
        pass.signs === first.signs &&
        Math.abs(Math.min(pass.from, pass.to) - Math.min(first.from, first.to)) < 1e-9,
    );
  return routes.findIndex(isOn);
}

/** The title of a circuit: "a full turn, branch 1", "−75.5° to 75.5°, branch 1 and −1". */
export function circuitTitle(linkage, { passes, closed }) {
  const formatInput = (at) => (linkage.input.isLength ? lengthLabel(at) : `${formatDecimals(at, 1)}°`);
  const ends = passes.flatMap(({ from, to }) => [from, to]);
  const [low, high] = [Math.min(...ends), Math.max(...ends)];
  const branches = [...new Set(passes.map(({ signs }) => branchLabel(linkage, signs)))].filter(Boolean);
  const turns =
    passes.every((pass) => Math.sign(pass.to - pass.from) === Math.sign(passes[0].to - passes[0].from)) &&
    closed;
  const travel = turns ? turnsLabel(high - low) : `${formatInput(low)} to ${formatInput(high)}`;
  return branches.length ? `${travel}, branch ${branches.slice(0, 2).join(" and ")}` : travel;
}

function lengthLabel(length) {
  return formatDecimals(Number(length.toPrecision(4)), 4).replace(/\.?0+$/, "");
}

function turnsLabel(degrees) {
  const turns = Math.round(degrees / 360);
  return turns === 1 ? "a full turn" : `${turns} turns`;
}

// The sides of all two-valued joints: 1 left, −1 right.
function branchLabel({ dyads }, signs) {
  return Array.from({ length: dyads }, (_, k) => (sideOf(signs, k) > 0 ? "1" : "−1")).join("/");
}

/** A number with a fixed number of decimals and a true minus sign. */
export function formatDecimals(value, decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? (0).toFixed(decimals) : text.replace("-", "−");
}
