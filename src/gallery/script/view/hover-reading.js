// What a curve does at a place on it: input, speed, transmission angle, as the page's own solver has them.

import { cellValues } from "../data/family.js";
import { findCircuits } from "../kinematics/circuit.js";
import { fourBarOf, transmissionAt } from "../kinematics/four-bar.js";
import { singlePointLinkage } from "../kinematics/linkage.js";
import { finePath } from "../kinematics/path.js";
import { poseAt, ratesAt } from "../kinematics/poses.js";
import { linkageOf } from "../kinematics/template.js";

// So many steps of Gauss and Newton bring a place on a chord onto the curve.
const FOOT_STEPS = 4;

/**
 * The curve of a family, solved: { path: { points, inputs, starts }, isLength, nearTo(x, y), atInput(pass,
 * input) }, the path fine to `tolerance` in the plane's unit. `nearTo` reads it at the foot of a place in the
 * plane: { pass, input, place: [x, y], speed, mu }, the input in degrees or a length, the speed |dP/dinput|
 * per radian or unit of length, mu in degrees or null. Null where the linkage has no such circuit.
 */
function solvedCurve(family, curve, tolerance) {
  const { cell, trace, circuit } = family.curves;
  const whole = linkageOf(family.template, cellValues(family, cell[curve]));
  const traced = whole.traced[trace[curve] - 1];
  if (traced === undefined) return null;
  const { linkage, joint } = singlePointLinkage(whole, traced);
  const route = findCircuits(linkage).routes[circuit[curve] - 1];
  if (!route) return null;
  const path = finePath(linkage, route, joint, tolerance);
  const fourBar = fourBarOf(linkage);
  const atInput = (pass, input) => readingAt({ linkage, joint, fourBar }, route.passes[pass], pass, input);
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

/** `solvedCurve`, or null where the page cannot solve the linkage: then there is the data alone. */
export function solvedOrNull(family, curve, tolerance) {
  try {
    return solvedCurve(family, curve, tolerance);
  } catch {
    return null;
  }
}

function readingAt({ linkage, joint, fourBar }, motion, pass, input) {
  // At some limits there are no rates, but there is a pose.
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

/** The pass and the input of the nearest place on a path, along its chords. */
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

/** The input at which a joint is nearest to a place, sought from one close by. */
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
    // A step beyond a few degrees leaves the part of the curve that is meant.
    const bounded = Math.min(Math.max(ahead * degrees, -2), 2);
    input = Math.min(Math.max(input + bounded, low), high);
  }
  return input;
}
