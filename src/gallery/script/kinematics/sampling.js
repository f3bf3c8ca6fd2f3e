// Samples circuits in the same way as the program.
//
// { step }: every whole multiple of a step, in degrees or units of length, and the ends of the passes. {
// samples }: that many in the whole circuit, evenly over each pass; with { spacing: "smooth" } dense towards
// the limits, with { spacing: "arc" } evenly along the path of the first traced joint.

import { remainderOf } from "./angles.js";
import { inputColumns, newPositions, placeJoints, convertToViewFrame, inputPosition } from "./positions.js";
import { placeAtEnd } from "./pass-ends.js";
import { inputDirection, passLength } from "./pass.js";
import { dyadSigns, sideOf } from "./assembly-mode.js";
import { cumulativeLength, easedInput } from "./spacing.js";

/** The most samples a circuit may have. */
const MAX_SAMPLES = 100000;

/** A sampler for { step } or { samples, spacing }, to be used for many circuits. */
export function newSampler(sampling) {
  const { step, samples } = sampling;
  const count = step === undefined ? Math.min(samples, MAX_SAMPLES) : 0;
  const angles = step === undefined ? evenInputs(count, 360) : multiplesOf(step, 0, 360);
  const turn = angles.map((at) => inputPosition({ isLength: false }, at));
  const spacing = step === undefined ? (sampling.spacing ?? "even") : "step";
  return { step, count, spacing, turn };
}

function evenInputs(count, period) {
  return Array.from({ length: count }, (_, i) => (period * i) / count);
}

/** Why a route cannot be sampled by so short a step, in a sentence; null if it can. */
export function excessReason({ spacing, step }, { passes }) {
  // A full turn may have them all, and rounding one more.
  const isLong = spacing === "step" && passes.some((pass) => passLength(pass) / step > MAX_SAMPLES + 1);
  return isLong ? `a step of ${step} makes more than ${MAX_SAMPLES} samples from one end to the other` : null;
}

/** Samples a route { passes, closed }: a circuit as described in motion.js. */
export function sampleCircuit(linkage, sampler, { passes, closed }) {
  const plan = planSamples(linkage, sampler, passes, closed);
  const { stops, pass, runs, ends } = plan;
  const inputs = inputColumns(stops);
  const joints = linkage.joints.length;
  const columns = newPositions(joints, stops.length);
  runs.forEach(([first, last], k) => {
    placeJoints(
      linkage,
      [0, joints],
      inputs,
      dyadSigns(passes[k].signs, 0, linkage.dyads),
      columns,
      first,
      last,
    );
  });
  for (const [sample, k, begins] of ends) {
    placeAtEnd(linkage, passes[k], begins, inputs, columns, sample);
    pass[sample] = k;
  }
  convertToViewFrame(linkage, columns);
  const { x, y, count } = columns;
  const signs = (sample) => passes[pass[sample]].signs;
  const branch = (sample, dyad = 0) => sideOf(signs(sample), dyad);
  return { passes, closed, count, input: inputs.at, pass: Uint32Array.from(pass), x, y, signs, branch };
}

// This many samples per turn, or per whole rocking circuit, interpolate a curve to a part in a million.
const FINE_SAMPLES = 360;
const fineSamplers = new Map();

/**
 * A circuit with samples dense enough to interpolate its curves, denser towards limits; itself if it has
 * them.
 */
export function refinedCircuit(linkage, circuit) {
  const turns = linkage.input.isLength ? 1 : linkage.input.period / 360;
  const samples = Math.min(FINE_SAMPLES * turns, MAX_SAMPLES);
  if (circuit.count >= samples) return circuit;
  if (!fineSamplers.has(samples)) fineSamplers.set(samples, newSampler({ samples, spacing: "smooth" }));
  return sampleCircuit(linkage, fineSamplers.get(samples), circuit);
}

/**
 * Whether paths may have a corner at a sample: a change point at which the input continues on the same
 * branch.
 */
export function isCorner({ passes, pass, input, closed }, sample) {
  const k = pass[sample];
  const [own, next] = [passes[k], passes[(k + 1) % passes.length]];
  const isEnd = input[sample] === own.to || (sample === 0 && closed);
  const turnsRound = (k + 1 < passes.length || closed) && inputDirection(own) !== inputDirection(next);
  return isEnd && own.end.flat !== 0 && !turnsRound && own.signs === next.signs;
}

// Where the samples of a route are: pass after pass, each up to and with its end; before them the start,
// which of a closed circuit is the end of its last pass. `ends` are [sample, pass, whether it is where the
// pass begins].
function planSamples(linkage, sampler, passes, closed) {
  const { input } = linkage;
  if (closed && passes.length === 1 && passes[0].begin.flat === 0 && sampler.spacing !== "arc") {
    // A full turn on one branch: the table as it is, and again for every further turn.
    const stops = fullPeriod(sampler, input);
    return { stops, pass: new Array(stops.length).fill(0), runs: [[0, stops.length]], ends: [] };
  }
  const last = passes.length - 1;
  const plan = {
    stops: [passes[0].begin],
    pass: [0],
    runs: [],
    ends: [closed ? [0, last, false] : [0, 0, true]],
  };
  const mileages = cumulativeLengths(linkage, sampler, passes);
  const intervals = intervalCounts(sampler, passes, closed, mileages);
  passes.forEach((pass, k) => {
    const begin = plan.stops.length;
    plan.stops.push(...innerSamples(sampler, pass, intervals[k], input, mileages[k]));
    if (k < last || !closed) {
      plan.ends.push([plan.stops.length, k, false]);
      plan.stops.push(pass.end);
    }
    plan.runs.push([begin, plan.stops.length]);
    while (plan.pass.length < plan.stops.length) plan.pass.push(k);
  });
  return plan;
}

// The samples strictly inside a pass.
function innerSamples(sampler, pass, intervals, input, mileage) {
  const { from, to } = pass;
  if (sampler.spacing === "step") {
    const { step } = sampler;
    const apart = (at) => Math.abs(at - from) > 1e-9 * step && Math.abs(at - to) > 1e-9 * step;
    const inside = multiplesOf(step, Math.min(from, to), Math.max(from, to)).filter(apart);
    const stops = inside.map((at) => inputAtMultiple(sampler, input, at));
    return from > to ? stops.reverse() : stops;
  }
  const shares = Array.from({ length: Math.max(intervals - 1, 0) }, (_, i) => (i + 1) / intervals);
  const at = (share) => {
    if (sampler.spacing !== "even") return easedInput(pass, mileage ? mileage.part(share) : share);
    // From both ends, so that equal passes forth and back have equal samples.
    return from < to ? from + (to - from) * share : to + (from - to) * (1 - share);
  };
  return shares.map((share) => inputPosition(input, at(share)));
}

// The input at a multiple of the step, from the table where the step divides the turn.
function inputAtMultiple({ turn, step }, input, at) {
  if (turn.length * step !== 360 || input.isLength) return inputPosition(input, at);
  const { cos, sin } = turn[remainderOf(Math.round(at / step), turn.length)];
  return { at, cos, sin };
}

// The samples of a whole period from input 0.
function fullPeriod(sampler, input) {
  if (input.period === 360) return sampler.turn;
  if (sampler.spacing === "step") {
    return multiplesOf(sampler.step, 0, input.period).map((at) => inputAtMultiple(sampler, input, at));
  }
  return evenInputs(sampler.count, input.period).map((at) => inputPosition(input, at));
}

// The paths of the first traced joint, pass by pass, where samples are to be even along them.
function cumulativeLengths(linkage, sampler, passes) {
  if (sampler.spacing !== "arc" || linkage.traced.length === 0) return [];
  const mileages = passes.map((pass) => cumulativeLength(linkage, pass, linkage.traced[0]));
  // The path of a joint that does not move has no length: the input is used then.
  return mileages.every(({ whole }) => whole > 0) ? mileages : [];
}

// How many intervals each pass gets: in proportion to its length, at least one, by largest remainder.
function intervalCounts({ spacing, count }, passes, closed, mileages) {
  if (spacing === "step") return passes.map(() => 0);
  const wanted = closed ? count : Math.max(count - 1, 0);
  const lengths = passes.map((pass, k) => mileages[k]?.whole ?? passLength(pass));
  const total = lengths.reduce((sum, length) => sum + length, 0);
  const exact = lengths.map((length) => (wanted * length) / total);
  // A share a rounding error below a whole number is that number.
  const shares = exact.map((share) => Math.max(Math.floor(share + 1e-9), 1));
  const order = shares.map((_, k) => k).sort((a, b) => exact[b] - shares[b] - (exact[a] - shares[a]));
  const sum = () => shares.reduce((all, share) => all + share, 0);
  for (let k = 0; sum() < wanted; k++) shares[order[k % order.length]] += 1;
  return shares;
}

/**
 * The whole multiples of a step from `from` up to, not with, `to`, as the decimals say: the third of 0.1 is
 * 0.3.
 */
export function multiplesOf(step, from, to) {
  // Where the step is a decimal of up to nine places, the multiple is one division and so correctly rounded.
  const scale = Array.from({ length: 10 }, (_, d) => 10 ** d).find((s) => Math.round(step * s) / s === step);
  const multiple = scale ? (k) => (k * Math.round(step * scale)) / scale : (k) => k * step;
  const out = [];
  for (let k = Math.ceil(from / step); out.length < MAX_SAMPLES; k++) {
    const at = multiple(k);
    if (at >= to) break;
    if (at >= from) out.push(at);
  }
  return out;
}
