// The rows of points.csv.

import { columnsAtSample } from "./columns.js";
import { shortestDigits } from "./digits.js";

/** The names of the columns after cell, trace and circuit. */
export function pointColumns({ linkage, family }) {
  const further = Array.from({ length: Math.max(linkage.dyads - 1, 0) }, (_, k) => `branch_${k + 2}`);
  const input = linkage.input.isLength ? "input_length" : "input_deg";
  return ["branch", ...further, "sample", input, "x", "y", ...(family.columns ?? [])];
}

/** The values of those columns, a row for each sample. */
export function pointRows(exported) {
  const { family, linkage, circuitSamples, joint } = exported;
  const dyads = Math.max(linkage.dyads, 1);
  return Array.from({ length: circuitSamples.count }, (_, k) => [
    ...Array.from({ length: dyads }, (_unused, dyad) => circuitSamples.branch(k, dyad)),
    k,
    circuitSamples.input[k],
    circuitSamples.x[joint][k],
    circuitSamples.y[joint][k],
    ...columnsAtSample(family.columns ?? [], linkage, circuitSamples, joint, k),
  ]);
}

/** The curve's rows of points.csv, with the header. */
export function csvOfCurve(exported) {
  const { cell, trace, circuit } = exported;
  const line = (row) => [cell, trace, circuit, ...row].map(shortestDigits).join(",");
  const lines = pointRows(exported).map(line);
  return `${["cell,trace,circuit", ...pointColumns(exported)].join(",")}\n${lines.join("\n")}\n`;
}
