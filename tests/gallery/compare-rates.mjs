// Compares the page's further columns of points.csv with the program's.

import { columnsAtSample } from "../../src/gallery/script/export/columns.js";

// The tolerance of a rate or a pole, by its own size and the linkage's: near a limit rates and their rounding
// errors grow without bounds.
const RATE_TOLERANCE = 1e-9;

let greatest = { off: 0, where: "" };
let compared = 0;

/** Compares the rates of one case; `complain(name, sentence)` is called for each disagreement. */
export function compareRates({ name, rates }, linkage, motion, complain) {
  for (const { trace, circuit: number, values } of rates) {
    const circuit = motion.circuits[number - 1];
    const joint = linkage.traced[trace - 1];
    const where = `${name}, trace ${trace}, circuit ${number}`;
    for (let i = 0; i < circuit.count; i++) {
      const found = columnsAtSample(Object.keys(values), linkage, circuit, joint, i);
      const size = Math.max(Math.abs(circuit.x[joint][i]), Math.abs(circuit.y[joint][i]), 1e-3);
      Object.entries(values).forEach(([column, all], k) => {
        const sentence = rateDisagreement(column, found[k], all[i], size, `${where}, sample ${i}`);
        if (sentence) complain(`${where}, sample ${i} (input ${circuit.input[i]})`, sentence);
      });
    }
  }
}

function rateDisagreement(column, found, given, size, where) {
  const expected = given === "inf" ? Infinity : given === "-inf" ? -Infinity : given;
  compared += 1;
  if (expected === null || !Number.isFinite(expected)) {
    const here = Number.isNaN(found) ? null : found;
    return here === expected ? null : `${column} is ${found}, not ${expected}`;
  }
  const off = Math.abs(found - expected) / Math.max(Math.abs(expected), size);
  if (!(off <= greatest.off)) greatest = { off, where: `${column}, ${where}` };
  return off <= RATE_TOLERANCE ? null : `${column} is ${found}, not ${expected}`;
}

/** A line with the greatest deviation found. */
export function rateSummary() {
  return compared === 0
    ? "no rates"
    : `${compared} rates: ${greatest.off.toExponential(1)} (${greatest.where})`;
}
