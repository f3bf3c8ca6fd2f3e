// Compares the page's further columns of points.csv with the program's.

import { columnsAtSample } from "../../src/gallery/script/export/columns.js";

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
  const wanted = given === "inf" ? Infinity : given === "-inf" ? -Infinity : given;
  compared += 1;
  if (wanted === null || !Number.isFinite(wanted)) {
    const here = Number.isNaN(found) ? null : found;
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
