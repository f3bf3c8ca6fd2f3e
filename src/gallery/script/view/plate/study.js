// A linkage as a plate studies it: assembled, all its circuits, the one that is shown.

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
import { courseOf } from "./course.js";

// So many samples over a circuit show what its other points and its sliders do.
const STUDY_SAMPLES = 240;

/**
 * The study of a curve of a family with changes (kinematics/changes.js): { values, reason } where it cannot
 * be assembled, `reason` a sentence; else { values, linkage, routes, home, shown, shortfall, circuit, joint,
 * others, course, mechanism, box, size, fourBar, isCouplerPoint, template }.
 *
 * `routes` are all circuits { passes, closed }; `home` is the place among them of the one the address names,
 * `shown` that of the one that is shown, which is `asked` where there is one; -1 where there is none.
 * `circuit` is `shown`, sampled; `joint` the traced one, `others` the further traced ones. `box` is what the
 * linkage sweeps. A rough study of a circuit that was not asked for knows no other circuits.
 */
export function studyOf(family, curve, changes, asked = null, isRough = false) {
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
    isRough && asked === null
      ? recorded
      : findCircuits({ ...linkage, travel: { ...linkage.travel, circuits: "all" } });
  const { routes } = all;
  if (routes.length === 0) return { values, reason: all.shortfall ?? "no input allows it to be assembled" };
  const home = sameRoute(routes, recorded.routes[circuit[curve] - 1]);
  const shown = routes[asked] ? asked : home;
  if (shown < 0) {
    const reason =
      recorded.shortfall ??
      "the circuit of this curve is there no more: it has come together with another, or apart";
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
  return { ...study, ...shownCircuit(study, changed.trace ?? linkage.traced.length) };
}

function shownCircuit({ linkage, routes, shown }, trace) {
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
    return { reason: "its lengths are too unlike one another to be drawn" };
  const fourBar = fourBarOf(linkage);
  const isCouplerPoint = fourBar !== null && isOnCoupler(linkage, fourBar, joint);
  return {
    circuit,
    joint,
    others,
    course: courseOf(routes[shown]),
    mechanism,
    box,
    curveBox,
    size,
    fourBar,
    isCouplerPoint,
  };
}

// Other points' curves are in the frame as long as the linkage does not become small in it.
function boxWithOthers(box, circuit, others) {
  const wide = [...box];
  for (const other of others) widenedBox(wide, circuit.x[other], circuit.y[other], circuit.count);
  const extent = ([x0, y0, x1, y1]) => Math.max(x1 - x0, y1 - y0);
  return extent(wide) <= 1.6 * extent(box) ? wide : box;
}

/** The path of a study's traced joint, to a part of its size. */
export function pathOfStudy({ linkage, circuit, joint, size }, part) {
  return finePath(linkage, circuit, joint, part * size);
}

function sameRoute(routes, route) {
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

/** What a circuit is called: "branch 1, a full turn", "−75.5° to 75.5°, branches 1 and −1". */
export function routeTitle(linkage, { passes, closed }) {
  const told = (at) => (linkage.input.isLength ? lengthWords(at) : `${minusSigned(at, 1)}°`);
  const ends = passes.flatMap(({ from, to }) => [from, to]);
  const [low, high] = [Math.min(...ends), Math.max(...ends)];
  const branches = [...new Set(passes.map(({ signs }) => branchWords(linkage, signs)))].filter(Boolean);
  const turns =
    passes.every((pass) => Math.sign(pass.to - pass.from) === Math.sign(passes[0].to - passes[0].from)) &&
    closed;
  const travel = turns ? turnWords(high - low) : `${told(low)} to ${told(high)}`;
  return branches.length ? `${travel}, branch ${branches.slice(0, 2).join(" and ")}` : travel;
}

function lengthWords(length) {
  return minusSigned(Number(length.toPrecision(4)), 4).replace(/\.?0+$/, "");
}

function turnWords(degrees) {
  const turns = Math.round(degrees / 360);
  return turns === 1 ? "a full turn" : `${turns} turns`;
}

// The sides of all two-valued joints: 1 left, −1 right.
function branchWords({ dyads }, signs) {
  return Array.from({ length: dyads }, (_, k) => (sideOf(signs, k) > 0 ? "1" : "−1")).join("/");
}

/** A number with so many decimals and a true minus. */
export function minusSigned(value, decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? (0).toFixed(decimals) : text.replace("-", "−");
}
