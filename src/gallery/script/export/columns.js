// The optional columns of points.csv.

import { poleFromRates } from "../kinematics/instantaneous-motion.js";
import {
  betaAt,
  distanceAt,
  muAt,
  phiAt,
  phiRatioAt,
  psiAt,
  psiRatioAt,
  slideAt,
  solvabilityAt,
} from "../kinematics/position-analysis.js";
import { ratesToJerkAt } from "../kinematics/poses.js";

/**
 * The value of each column at a sample { linkage, rates, input, side, velocity, acceleration, jerk (of the
 * traced joint), pole() }; rates are per radian of input or per unit of length.
 */
const COLUMN_VALUES = new Map([
  ["vx", ({ velocity: [vx] }) => vx],
  ["vy", ({ velocity: [, vy] }) => vy],
  ["ax", ({ acceleration: [ax] }) => ax],
  ["ay", ({ acceleration: [, ay] }) => ay],
  ["jx", ({ jerk: [jx] }) => jx],
  ["jy", ({ jerk: [, jy] }) => jy],
  ["speed", ({ velocity: [vx, vy] }) => Math.sqrt(vx * vx + vy * vy)],
  ["curvature", curvatureOfRates],
  ["curvature_rate", curvatureRateOfRates],
  ["pole_x", ({ pole }) => pole()?.pole[0]],
  ["pole_y", ({ pole }) => pole()?.pole[1]],
  ["moving_pole_x", ({ pole }) => pole()?.moving[0]],
  ["moving_pole_y", ({ pole }) => pole()?.moving[1]],
  ["inflection_x", ({ pole }) => pole()?.inflection[0]],
  ["inflection_y", ({ pole }) => pole()?.inflection[1]],
  ["psi_deg", psiAt],
  ["phi_deg", phiAt],
  ["mu_deg", muAt],
  ["psi_ratio", psiRatioAt],
  ["phi_ratio", phiRatioAt],
  ["solvability", solvabilityAt],
  ["s", slideAt],
  ["b", distanceAt],
  ["beta_deg", betaAt],
]);

/** The names of all optional columns, in the program's order. */
export function columnNames() {
  return [...COLUMN_VALUES.keys()];
}

/** The columns `names` of a joint at a sample of a circuit; NaN where one does not apply. */
export function columnsAtSample(names, linkage, circuitSamples, joint, sample) {
  if (names.length === 0) return [];
  // A closed circuit starts where its last pass ends, possibly several turns later.
  const pass = circuitSamples.passes[circuitSamples.pass[sample]];
  const isSeam = sample === 0 && circuitSamples.closed && pass.end.flat !== 0;
  const input = isSeam ? pass.to : circuitSamples.input[sample];
  const rates = ratesToJerkAt(linkage, pass, input);
  const ofJoint = (all) => all.subarray(2 * joint, 2 * joint + 2);
  const at = {
    linkage,
    rates,
    input: circuitSamples.input[sample],
    side: (index) => circuitSamples.branch(sample, index),
    velocity: ofJoint(rates.velocity),
    acceleration: ofJoint(rates.acceleration),
    jerk: ofJoint(rates.jerk),
    pole: () => poleFromRates(linkage, rates, joint),
  };
  return names.map((name) => COLUMN_VALUES.get(name)(at) ?? NaN);
}

// Positive where the path bends to the left.
function curvatureOfRates({ velocity: [vx, vy], acceleration: [ax, ay] }) {
  return (vx * ay - vy * ax) / Math.sqrt(vx * vx + vy * vy) ** 3;
}

// The derivative of the curvature with respect to arc length.
function curvatureRateOfRates({ velocity: [vx, vy], acceleration: [ax, ay], jerk: [jx, jy] }) {
  const v2 = vx * vx + vy * vy;
  const bend = vx * ay - vy * ax;
  return ((vx * jy - vy * jx) * v2 - 3 * bend * (vx * ax + vy * ay)) / (v2 * v2 * v2);
}
