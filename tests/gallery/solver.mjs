// Compares the page's solver with the program's: node tests/gallery/solver.mjs CASES.json
//
// CASES.json is an array of
//   { name,
//     template, values, sampling,
//         as in the data of index.html: a family's template, the values of its names in a cell,
//         { step } or { samples, spacing } in degrees or lengths
//     straight,
//         { tolerance | input | length }; absent or null for a tolerance of 0.001
//     columns,
//         "joints" (the default): x and y below have a row for each joint of the linkage, in their order;
//         "traced": one for each traced joint
//     motion: { shortfall, circuits: [{ closed, passes, input, branch, x, y }] },
//         the shortfall is the sentence, or null; an error of the template has its sentence for shortfall, and
//         no circuits. passes: [{ from, to, signs: [1 | -1, …] }], a sign for each two-valued joint; closed and
//         passes may be left out. input[sample]; branch[sample]: [1 | -1, …] for the two-valued joints;
//         x[row][sample], y[row][sample], null where undefined
//     measures: [{ trace, circuit, values: { name: number | string | "inf" | null } }],
//         of a traced joint and a circuit, both counted from 1; null where one does not apply; may be left out
//     rates: [{ trace, circuit, values: { column: [number | "inf" | "-inf" | null] } }] }
//         further columns of points.csv, by samples; may be left out
// Exits with 0 and a line of the greatest deviations, or with 1 and a line for each disagreement.

import { readFileSync } from "node:fs";

import { LinkageError } from "../../src/gallery/script/kinematics/linkage-builder.js";
import { motionOf } from "../../src/gallery/script/kinematics/motion.js";
import { linkageOf } from "../../src/gallery/script/kinematics/template.js";
import { sideOf } from "../../src/gallery/script/kinematics/assembly-mode.js";
import { compareMeasures, measureSummary } from "./compare-measures.mjs";
import { compareRates, rateSummary } from "./compare-rates.mjs";

// The tolerance of a position, by the size of the linkage.
const PLACE_TOLERANCE = 1e-12;
// The tolerance of an input: limits found by bisection are exact to their last bits.
const INPUT_TOLERANCE = 1e-11;

const greatest = { place: 0, placeAt: "", input: 0, inputAt: "", samples: 0, circuits: 0 };
let problems = 0;

function complain(name, sentence) {
  problems += 1;
  if (problems <= 60) console.log(`${name}: ${sentence}`);
}

function compareCase(given) {
  const { name, template, values, sampling, motion } = given;
  let linkage;
  try {
    linkage = linkageOf(template, values);
  } catch (error) {
    if (!(error instanceof LinkageError)) throw error;
    if (motion.circuits.length > 0) complain(name, `no linkage: ${error.message}`);
    else if (motion.shortfall !== error.message)
      complain(name, `"${error.message}", not "${motion.shortfall}"`);
    return;
  }
  const found = motionOf(linkage, sampling);
  if (found.circuits.length !== motion.circuits.length) {
    complain(name, `${found.circuits.length} circuits, not ${motion.circuits.length} (${found.shortfall})`);
    return;
  }
  if ((found.shortfall ?? null) !== (motion.shortfall ?? null)) {
    complain(name, `"${found.shortfall}", not "${motion.shortfall}"`);
  }
  motion.circuits.forEach((expected, k) =>
    compareCircuit(`${name}, circuit ${k + 1}`, given, linkage, found.circuits[k], expected),
  );
  if (given.measures) compareMeasures(given, linkage, found, complain);
  if (given.rates) compareRates(given, linkage, found, complain);
}

function compareCircuit(name, { columns }, linkage, circuit, expected) {
  greatest.circuits += 1;
  if (circuit.count !== expected.input.length) {
    complain(name, `${circuit.count} samples, not ${expected.input.length}`);
    return;
  }
  if (expected.closed !== undefined && expected.closed !== circuit.closed)
    complain(name, `closed is ${circuit.closed}`);
  if (expected.passes) comparePasses(name, linkage, circuit, expected.passes);
  expected.input.forEach((at, i) => {
    const off = Math.abs(circuit.input[i] - at) / Math.max(1, Math.abs(at));
    if (off > greatest.input) Object.assign(greatest, { input: off, inputAt: `${name}, sample ${i}` });
    if (!(off <= INPUT_TOLERANCE)) complain(name, `input ${circuit.input[i]} of sample ${i}, not ${at}`);
    expected.branch[i].forEach((side, dyad) => {
      if (dyad < linkage.dyads && circuit.branch(i, dyad) !== side)
        complain(name, `branch ${-side} of dyad ${dyad} at sample ${i}`);
    });
  });
  const rows = columns === "traced" ? linkage.traced : linkage.joints.map((_, joint) => joint);
  comparePlaces(name, rows, linkage, circuit, expected);
}

function comparePasses(name, { dyads }, { passes }, expected) {
  if (passes.length !== expected.length) {
    complain(name, `${passes.length} passes, not ${expected.length}`);
    return;
  }
  expected.forEach(({ from, to, signs }, k) => {
    const off =
      Math.max(Math.abs(passes[k].from - from), Math.abs(passes[k].to - to)) / Math.max(1, Math.abs(from));
    if (!(off <= INPUT_TOLERANCE)) complain(name, `pass ${k + 1} from ${passes[k].from} to ${passes[k].to}`);
    const isOther = signs.some((side, dyad) => dyad < dyads && side !== sideOf(passes[k].signs, dyad));
    if (isOther) complain(name, `other signs of pass ${k + 1}`);
  });
}

function comparePlaces(name, rows, linkage, circuit, expected) {
  const finite = (value) => value !== null && Number.isFinite(value);
  let size = 0;
  for (const row of [...expected.x, ...expected.y])
    for (const at of row) if (finite(at)) size = Math.max(size, Math.abs(at));
  rows.forEach((joint, row) => {
    for (let i = 0; i < circuit.count; i++) {
      greatest.samples += 1;
      for (const axis of ["x", "y"]) {
        const [here, there] = [circuit[axis][joint][i], expected[axis][row][i]];
        if (!finite(there) && !Number.isFinite(here)) continue;
        // A position that only one of the two has is infinitely far off.
        const off = finite(there) ? Math.abs(here - there) / size : Infinity;
        if (off > greatest.place) Object.assign(greatest, { place: off, placeAt: `${name}, sample ${i}` });
        if (off <= PLACE_TOLERANCE) continue;
        const coordinate = `${linkage.joints[joint].name}.${axis}`;
        complain(name, `${coordinate} = ${here} at sample ${i} (input ${circuit.input[i]}), not ${there}`);
      }
    }
  });
}

const [path] = process.argv.slice(2);
if (!path) {
  console.log("usage: node tests/gallery/solver.mjs CASES.json");
  process.exit(2);
}
const cases = JSON.parse(readFileSync(path, "utf8"));
for (const given of cases) compareCase(given);
const { place, placeAt, input, inputAt, samples, circuits } = greatest;
if (samples === 0) complain("all cases", "nothing was compared");
if (problems > 60) console.log(`and ${problems - 60} more`);
console.log(`${cases.length} cases, ${circuits} circuits, ${samples} places: ${problems} disagreements`);
console.log(`places to ${place.toExponential(1)} of the size (${placeAt})`);
console.log(`inputs to ${input.toExponential(1)} (${inputAt})`);
console.log(measureSummary());
console.log(rateSummary());
process.exit(problems > 0 ? 1 : 0);
