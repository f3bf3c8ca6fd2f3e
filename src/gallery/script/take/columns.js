// The further columns of points.csv, as far as the page reckons them.

import { fourBarOf, transmissionAt } from "../kinematics/four-bar.js";
import { poleAt } from "../kinematics/instant.js";
import { ratesAt } from "../kinematics/poses.js";

/**
 * What each column is at a sample { place, vx, vy, ax, ay, pole(), mu() }, rates to a radian of input or a
 * unit of length.
 */
const COLUMN_VALUES = new Map([
  ["vx", ({ vx }) => vx],
  ["vy", ({ vy }) => vy],
  ["ax", ({ ax }) => ax],
  ["ay", ({ ay }) => ay],
  ["speed", ({ vx, vy }) => Math.sqrt(vx * vx + vy * vy)],
  ["curvature", ({ vx, vy, ax, ay }) => (vx * ay - vy * ax) / Math.sqrt(vx * vx + vy * vy) ** 3],
  ["pole_x", ({ pole }) => pole()?.pole[0]],
  ["pole_y", ({ pole }) => pole()?.pole[1]],
  ["moving_pole_x", ({ pole }) => pole()?.moving[0]],
  ["moving_pole_y", ({ pole }) => pole()?.moving[1]],
  ["inflection_x", ({ pole }) => pole()?.inflection[0]],
  ["inflection_y", ({ pole }) => pole()?.inflection[1]],
  ["mu_deg", ({ mu }) => mu()],
]);

/** The further columns of a family that the page reckons. */
export function reckonedColumns({ columns }) {
  return (columns ?? []).filter((name) => COLUMN_VALUES.has(name));
}

/** Those that only the program does. */
export function missingColumns({ columns }) {
  return (columns ?? []).filter((name) => !COLUMN_VALUES.has(name));
}

/** The reckoned columns of a taken curve at a sample; not a number where one does not apply. */
export function columnsAtSample({ family, linkage, course, joint }, sample) {
  const names = reckonedColumns(family);
  if (names.length === 0) return [];
  // A closed circuit begins where its last pass ends, perhaps a few turns on.
  const pass = course.passes[course.pass[sample]];
  const input = sample === 0 && course.closed && pass.end.flat !== 0 ? pass.to : course.input[sample];
  const { place, velocity, acceleration } = ratesAt(linkage, pass, input);
  const [vx, vy] = velocity.subarray(2 * joint);
  const [ax, ay] = acceleration.subarray(2 * joint);
  const pole = () => poleAt(linkage, pass, input, joint);
  const mu = () => {
    const fourBar = linkage.seenFrom ? null : fourBarOf(linkage);
    return fourBar ? transmissionAt(linkage, fourBar, place).mu : NaN;
  };
  return names.map((name) => COLUMN_VALUES.get(name)({ vx, vy, ax, ay, pole, mu }) ?? NaN);
}
