// The readings of a curve at a point: input, speed, transmission angle, from the page's solver.

import { cellValues } from "../data/family.js";
import { findCircuits } from "../kinematics/circuit.js";
import { fourBarOf, transmissionAt } from "../kinematics/four-bar.js";
import { singlePointLinkage } from "../kinematics/linkage.js";
import { finePath } from "../kinematics/path.js";
import { poseAt, ratesAt } from "../kinematics/poses.js";
import { linkageOf } from "../kinematics/template.js";

// The number of Gauss-Newton steps that project a point of a chord onto the curve.
const FOOT_STEPS = 4;

/**
 * Solves a curve of a family: { path: { points, inputs, starts }, isLength, nearTo(x, y), atInput(pass,
 * input) }. The path is accurate to `tolerance` in units of the plane. `nearTo` returns the reading at the
 * nearest point of the curve: { pass, input, place: [x, y], speed, mu }, with the input in degrees or as a
 * length, the speed |dP/dinput| per radian or unit of length, and mu in degrees or null. Null if the linkage
 * has no such circuit.
 */
function solveCurve(family, curve, tolerance) {
  const { cell, trace, circuit } = family.curves;
  const whole = linkageOf(family.template, cellValues(family, cell[curve]));
  const traced = whole.traced[trace[curve] - 1];
  if (traced === undefined) return null;
  const { linkage, joint } = singlePointLinkage(whole, traced);
  const route = findCircuits(linkage).routes[circuit[curve] - 1];
  if (!route) return null;
  const path = finePath(linkage, route, joint, tolerance);
  const fourBar = fourBarOf(linkage);
  const solved = { linkage, joint, fourBar };
  const atInput = (pass, input) => readingAtInput(solved, route.passes[pass], pass, input);
  return {
    path,
    closed: route.closed,
    isLength: linkage.input.isLength,
    passes: route.passes,
    atInput,
    nearTo: (x, y) => {
      const { pass, input } = footOnPath(path, x, y);
      return atInput(pass, footOfPlace({ linkage, joint }, route.passes[pass], input, x, y));
    },
  };
}

/** `solveCurve`, or null if the page cannot solve the linkage; the stored points remain. */
export function solveCurveOrNull(family, curve, tolerance) {
  try {
    return solveCurve(family, curve, tolerance);
  } catch {
    return null;
  }
}

function readingAtInput({ linkage, joint, fourBar }, motion, pass, input) {
  // At some limits the rates are undefined, but the pose exists.
  const pose = poseAt(linkage, motion, input);
  const { velocity } = ratesAt(linkage, motion, input);
  return {
    pass,
    input,
    place: [pose[2 * joint], pose[2 * joint + 1]],
    speed: Math.hypot(velocity[2 * joint], velocity[2 * joint + 1]),
    mu: fourBar ? transmissionAt(linkage, fourBar, pose).mu : null,
  };
}

/** The pass and the input of the nearest point on a path, along its chords. */
function footOnPath({ points, inputs, starts }, x, y) {
  let [least, at, part] = [Infinity, 1, 0];
  for (let k = 1; k < inputs.length; k += 1) {
    const [x0, y0] = [points[2 * k - 2], points[2 * k - 1]];
    const [dx, dy] = [points[2 * k] - x0, points[2 * k + 1] - y0];
    const length = dx * dx + dy * dy;
    const along = length > 0 ? Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / length, 0), 1) : 0;
    const square = (x - x0 - along * dx) ** 2 + (y - y0 - along * dy) ** 2;
    if (square < least) [least, at, part] = [square, k, along];
  }
  const pass = starts.findLastIndex((start) => start < at);
  return { pass: Math.max(pass, 0), input: inputs[at - 1] + part * (inputs[at] - inputs[at - 1]) };
}

/** The input at which a joint is nearest to a point, starting from a nearby input. */
function footOfPlace({ linkage, joint }, pass, from, x, y) {
  const degrees = linkage.input.isLength ? 1 : 180 / Math.PI;
  const [low, high] = [Math.min(pass.from, pass.to), Math.max(pass.from, pass.to)];
  let input = from;
  for (let step = 0; step < FOOT_STEPS; step += 1) {
    const { place, velocity } = ratesAt(linkage, pass, input);
    const [vx, vy] = [velocity[2 * joint], velocity[2 * joint + 1]];
    const square = vx * vx + vy * vy;
    if (!Number.isFinite(square) || square === 0) break;
    const ahead = ((x - place[2 * joint]) * vx + (y - place[2 * joint + 1]) * vy) / square;
    // A larger step would leave this part of the curve.
    const bounded = Math.min(Math.max(ahead * degrees, -2), 2);
    input = Math.min(Math.max(input + bounded, low), high);
  }
  return input;
}
