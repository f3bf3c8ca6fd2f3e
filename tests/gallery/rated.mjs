// Compares the page's velocities, accelerations, poles and transmission angles with the program's.

import { fourBarOf, transmissionAt } from "../../src/gallery/script/kinematics/four-bar.js";
import { poleAt } from "../../src/gallery/script/kinematics/instant.js";
import { ratesAt } from "../../src/gallery/script/kinematics/poses.js";

// Of a rate or a pole, by its own size and the linkage's: near a limit, where rates grow without bounds, so
// does what rounding makes of them.
const RATE_TOLERANCE = 1e-9;

let greatest = { off: 0, where: "" };
let compared = 0;

/** Compares the rates of one case; `complain(name, sentence)` is told of each disagreement. */
export function compareRates({ name, rates }, linkage, motion, complain) {
  for (const { trace, circuit: number, values } of rates) {
    const circuit = motion.circuits[number - 1];
    const joint = linkage.traced[trace - 1];
    const where = `${name}, trace ${trace}, circuit ${number}`;
    for (let i = 0; i < circuit.count; i++) {
      const found = ratesAtSample(linkage, circuit, joint, i);
      const size = Math.max(Math.abs(circuit.x[joint][i]), Math.abs(circuit.y[joint][i]), 1e-3);
      for (const [column, all] of Object.entries(values)) {
        if (!(column in found)) continue;
        const sentence = rateDisagreement(column, found[column], all[i], size, `${where}, sample ${i}`);
        if (sentence) complain(`${where}, sample ${i} (input ${circuit.input[i]})`, sentence);
      }
    }
  }
}

function ratesAtSample(linkage, circuit, joint, i) {
  // A closed circuit begins where its last pass ends, perhaps a few turns on.
  const pass = circuit.passes[circuit.pass[i]];
  const input = i === 0 && circuit.closed && pass.end.flat !== 0 ? pass.to : circuit.input[i];
  const { place, velocity, acceleration } = ratesAt(linkage, pass, input);
  const instant = poleAt(linkage, pass, input, joint);
  const fourBar = linkage.seenFrom ? null : fourBarOf(linkage);
  const [vx, vy] = velocity.subarray(2 * joint);
  const [ax, ay] = acceleration.subarray(2 * joint);
  const speed = Math.hypot(vx, vy);
  return {
    vx,
    vy,
    ax,
    ay,
    speed,
    curvature: (vx * ay - vy * ax) / speed ** 3,
    pole_x: instant?.pole[0],
    pole_y: instant?.pole[1],
    moving_pole_x: instant?.moving[0],
    moving_pole_y: instant?.moving[1],
    inflection_x: instant?.inflection[0],
    inflection_y: instant?.inflection[1],
    mu_deg: fourBar ? transmissionAt(linkage, fourBar, place).mu : undefined,
  };
}

function rateDisagreement(column, found, given, size, where) {
  const wanted = given === "inf" ? Infinity : given === "-inf" ? -Infinity : given;
  compared += 1;
  if (wanted === null || !Number.isFinite(wanted)) {
    const here = found === undefined || Number.isNaN(found) ? null : found;
    return here === wanted ? null : `${column} is ${found}, not ${wanted}`;
  }
  const off = Math.abs(found - wanted) / Math.max(Math.abs(wanted), size);
  if (!(off <= greatest.off)) greatest = { off, where: `${column}, ${where}` };
  return off <= RATE_TOLERANCE ? null : `${column} is ${found}, not ${wanted}`;
}

/** The greatest deviation found, in a line. */
export function ratesTold() {
  return compared === 0
    ? "no rates"
    : `${compared} rates: ${greatest.off.toExponential(1)} (${greatest.where})`;
}
