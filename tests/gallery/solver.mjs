// Compares the page's solver with the program's: node tests/gallery/solver.mjs CASES.json
//
// CASES.json is an array of
//   { name,
//     template, values, sampling,
//         as the data of index.html has them: a family's template, the values of its names in a cell,
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
// Exit 0 with a line of the greatest deviations, 1 with a line for each disagreement.

import { readFileSync } from "node:fs";

import { LinkageError } from "../../src/gallery/script/kinematics/linkage-builder.js";
import { motionOf } from "../../src/gallery/script/kinematics/motion.js";
import { linkageOf } from "../../src/gallery/script/kinematics/template.js";
import { sideOf } from "../../src/gallery/script/kinematics/assembly-mode.js";
import { compareMeasures, measuresTold } from "./measured.mjs";
import { compareRates, ratesTold } from "./rated.mjs";

// Of a place, by the size of the linkage.
const PLACE_TOLERANCE = 1e-12;
// Of an input: limits that are found by bisection are as good as their last bits.
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
  motion.circuits.forEach((wanted, k) =>
    compareCircuit(`${name}, circuit ${k + 1}`, given, linkage, found.circuits[k], wanted),
  );
  if (given.measures) compareMeasures(given, linkage, found, complain);
  if (given.rates) compareRates(given, linkage, found, complain);
}

function compareCircuit(name, { columns }, linkage, circuit, wanted) {
  greatest.circuits += 1;
  if (circuit.count !== wanted.input.length) {
    complain(name, `${circuit.count} samples, not ${wanted.input.length}`);
    return;
  }
  if (wanted.closed !== undefined && wanted.closed !== circuit.closed)
    complain(name, `closed is ${circuit.closed}`);
  if (wanted.passes) comparePasses(name, linkage, circuit, wanted.passes);
  wanted.input.forEach((at, i) => {
    const off = Math.abs(circuit.input[i] - at) / Math.max(1, Math.abs(at));
    if (off > greatest.input) Object.assign(greatest, { input: off, inputAt: `${name}, sample ${i}` });
    if (!(off <= INPUT_TOLERANCE)) complain(name, `input ${circuit.input[i]} of sample ${i}, not ${at}`);
    wanted.branch[i].forEach((side, dyad) => {
      if (dyad < linkage.dyads && circuit.branch(i, dyad) !== side)
        complain(name, `branch ${-side} of dyad ${dyad} at sample ${i}`);
    });
  });
  const rows = columns === "traced" ? linkage.traced : linkage.joints.map((_, joint) => joint);
  comparePlaces(name, rows, linkage, circuit, wanted);
}

function comparePasses(name, { dyads }, { passes }, wanted) {
  if (passes.length !== wanted.length) {
    complain(name, `${passes.length} passes, not ${wanted.length}`);
    return;
  }
  wanted.forEach(({ from, to, signs }, k) => {
    const off =
      Math.max(Math.abs(passes[k].from - from), Math.abs(passes[k].to - to)) / Math.max(1, Math.abs(from));
    if (!(off <= INPUT_TOLERANCE)) complain(name, `pass ${k + 1} from ${passes[k].from} to ${passes[k].to}`);
    const isOther = signs.some((side, dyad) => dyad < dyads && side !== sideOf(passes[k].signs, dyad));
    if (isOther) complain(name, `other signs of pass ${k + 1}`);
  });
}

function comparePlaces(name, rows, linkage, circuit, wanted) {
  const finite = (value) => value !== null && Number.isFinite(value);
  let size = 0;
  for (const row of [...wanted.x, ...wanted.y])
    for (const at of row) if (finite(at)) size = Math.max(size, Math.abs(at));
  rows.forEach((joint, row) => {
    for (let i = 0; i < circuit.count; i++) {
      greatest.samples += 1;
      for (const axis of ["x", "y"]) {
        const [here, there] = [circuit[axis][joint][i], wanted[axis][row][i]];
        if (!finite(there) && !Number.isFinite(here)) continue;
        // A place that only one of the two has is as far off as can be.
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
console.log(measuresTold());
console.log(ratesTold());
process.exit(problems > 0 ? 1 : 0);
