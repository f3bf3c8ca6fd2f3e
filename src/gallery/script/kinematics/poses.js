// Computes the poses and rates of all joints at inputs of a pass, in the linkage's view frame.

import { inputColumns, newPositions, placeJoints, convertToViewFrame, inputPosition } from "./positions.js";
import { placeAtEnd } from "./pass-ends.js";
import { derivativesOnPass } from "./derivatives.js";
import { dyadSigns } from "./assembly-mode.js";

/** All joints at many inputs of a pass, in columns; at its ends exactly as the circuit has them. */
export function posesAt(linkage, pass, ats) {
  const stops = Array.from(ats, (at) => inputPosition(linkage.input, at));
  const inputs = inputColumns(stops);
  const joints = linkage.joints.length;
  const columns = newPositions(joints, stops.length);
  placeJoints(
    linkage,
    [0, joints],
    inputs,
    dyadSigns(pass.signs, 0, linkage.dyads),
    columns,
    0,
    stops.length,
  );
  stops.forEach(({ at }, i) => {
    if (at === pass.from && pass.begin.flat !== 0) placeAtEnd(linkage, pass, true, inputs, columns, i);
    if (at === pass.to && pass.end.flat !== 0) placeAtEnd(linkage, pass, false, inputs, columns, i);
  });
  convertToViewFrame(linkage, columns);
  return columns;
}

/**
 * All joints at one input of a pass, in degrees or as a length: Float64Array [x0, y0, x1, y1, …]; NaN where
 * undefined.
 */
export function poseAt(linkage, pass, input) {
  const { x, y } = posesAt(linkage, pass, [input]);
  return Float64Array.from({ length: 2 * x.length }, (_, k) => (k % 2 === 0 ? x : y)[k >> 1][0]);
}

/**
 * Places, velocities and accelerations of all joints at an input of a pass, each like a pose: { place,
 * velocity, acceleration }, per radian of input or unit of length, by exact series. Infinite where a limit
 * makes them so.
 */
export function ratesAt(linkage, pass, input) {
  const jets = derivativesOnPass(linkage, pass, input);
  return { place: rateOfJets(jets, 0), velocity: rateOfJets(jets, 1), acceleration: rateOfJets(jets, 2) };
}

/** The same with the third derivatives of the places, { place, velocity, acceleration, jerk }. */
export function ratesToJerkAt(linkage, pass, input) {
  const jets = derivativesOnPass(linkage, pass, input, 4);
  const [place, velocity, acceleration, jerk] = [0, 1, 2, 3].map((order) => rateOfJets(jets, order));
  return { place, velocity, acceleration, jerk };
}

// The derivative of that order, of a series: its coefficient times 1, 1, 2, 6.
function rateOfJets(jets, order) {
  const factor = [1, 1, 2, 6][order];
  const of = (k) => jets[k >> 1][k % 2 === 0 ? "x" : "y"][order] * factor;
  const bounded = (value) => (Number.isNaN(value) && order > 0 ? Infinity : value);
  return Float64Array.from({ length: 2 * jets.length }, (_, k) => bounded(of(k)));
}
