// Measures the shape of a path: its box, cusps, greatest curvature and speed ratio.

import { degreesOf } from "../kinematics/angles.js";
import { inputPosition } from "../kinematics/positions.js";
import { derivativesAtInput } from "../kinematics/derivatives.js";
import { passRange } from "../kinematics/pass.js";
import { posesAt } from "../kinematics/poses.js";
import { isCorner } from "../kinematics/sampling.js";
import { maxCurvatureNear, maxExtent } from "./interpolation.js";
import { curveArcs, neighbourSample, furthestSample, turnsBeyond } from "./sampled-curve.js";

const GOLDEN_PART = 0.6180339887498949;

/** The greatest extent of a curve in a direction along an axis. */
export function extentMeasure(tracedCurve, direction) {
  const { curve } = tracedCurve;
  const top = furthestSample(curve, direction);
  if (top < 0) return null;
  // About a limit samples lie far apart: there the linkage itself is solved.
  if (!isNearLimit(tracedCurve, top)) return maxExtent(curve, direction, top);
  const height = direction[0] * curve.x[top] + direction[1] * curve.y[top];
  return Math.max(height, extentByPoses(tracedCurve, direction, top));
}

// Whether a limit is no more than two samples away.
function isNearLimit({ curve, circuit }, i) {
  const limits = limitInputs(circuit);
  return [-2, -1, 0, 1, 2].some((off) => {
    const k = neighbourSample(curve, i, off);
    return k >= 0 && limits.includes(curve.inputs[k]);
  });
}

function limitInputs({ passes }) {
  return passes
    .flatMap(({ begin, end }) => [begin, end])
    .filter(({ flat }) => flat !== 0)
    .map(({ at }) => at);
}

// The greatest extent in a direction between a sample and its neighbours, by the poses there.
function extentByPoses({ curve, circuit, alone }, [dx, dy], top) {
  let most = -Infinity;
  for (const [from, to] of [
    [neighbourSample(curve, top, -1), top],
    [top, neighbourSample(curve, top, 1)],
  ]) {
    if (from < 0 || to < 0) continue;
    // The way to a sample has the sides that it has itself, be it the end of a pass.
    const [low, high] = [
      Math.min(curve.inputs[from], curve.inputs[to]),
      Math.max(curve.inputs[from], curve.inputs[to]),
    ];
    const signs = circuit.signs(curve.samples[to]);
    const pass = circuit.passes.find((other) => {
      const [first, last] = passRange(other);
      return other.signs === signs && first <= low && high <= last;
    });
    if (!pass) continue;
    const height = (input) => {
      const { x, y } = posesAt(alone.linkage, pass, [input]);
      return dx * x[alone.joint][0] + dy * y[alone.joint][0];
    };
    let [a, b] = [low, high];
    for (let round = 0; round < 30; round++) {
      const [c, d] = [b - GOLDEN_PART * (b - a), a + GOLDEN_PART * (b - a)];
      if (height(c) > height(d)) b = d;
      else a = c;
    }
    most = Math.max(most, height((a + b) / 2));
  }
  return most;
}

// Speed and curvature of the path at an input of the pass that a sample is on.
function speedAndCurvature({ circuit, alone: { linkage, joint } }, sample, input) {
  const at = inputPosition(linkage.input, input);
  const { x, y } = derivativesAtInput(linkage, at, circuit.signs(sample))[joint];
  const bounded = (rate) => (Number.isNaN(rate) ? Infinity : rate);
  const [vx, vy, ax, ay] = [x[1], y[1], 2 * x[2], 2 * y[2]].map(bounded);
  const speed = Math.sqrt(vx * vx + vy * vy);
  return [speed, Math.abs((vx * ay - vy * ax) / (speed * speed * speed))];
}

// The inputs next to a sample on its own pass.
function neighbourInputs({ circuit: { input } }, sample) {
  const [here, before, after] = [input[sample], input[sample - 1], input[sample + 1]];
  const other = after ?? before;
  const step = other === undefined ? 0 : Math.abs(other - here);
  const off = (beside) => (beside === undefined ? step : Math.abs(beside - here));
  return [here - off(before), here + off(after)];
}

/** The number of cusps, where the path stops and turns back: slower than a millionth of its fastest. */
export function countCusps(tracedCurve) {
  const { curve, circuit, linkage } = tracedCurve;
  const turns = curve.samples.map((_, i) => i).filter((i) => curve.sharp[i]);
  if (turns.length === 0) return 0;
  const longest = curveArcs(curve).reduce((most, { length }) => Math.max(most, length), 0);
  const found = [];
  for (const i of turns) {
    const sample = curve.samples[i];
    let [a, b] = neighbourInputs(tracedCurve, sample);
    const step = Math.abs(b - a);
    const speed = (input) => speedAndCurvature(tracedCurve, sample, input)[0];
    for (let round = 0; round < 60; round++) {
      const [c, d] = [a + (b - a) / 3, b - (b - a) / 3];
      if (speed(c) < speed(d)) b = d;
      else a = c;
    }
    // The speed of the longest step, to a radian or a unit of length, for comparison.
    const unit = linkage.input.isLength ? 1 : degreesOf(1);
    const fastest = (longest / (step / 2)) * unit;
    const isNew = found.every((other) => Math.abs(other - a) > step / 4);
    if (speed(a) <= 1e-6 * fastest && isNew) found.push(a);
  }
  return circuit.count > 0 ? found.length : 0;
}

// The sample with the greatest curvature, except corners: two samples on either side determine it.
function sharpestSample(curve, circuit) {
  const corners = curve.samples.map((sample) => isCorner(circuit, sample));
  const isByCorner = (i) => [-2, -1, 0, 1, 2].some((off) => corners[neighbourSample(curve, i, off)]);
  let sharpest = -1;
  curve.curvatures.forEach((bend, i) => {
    const isSharper = sharpest < 0 || Math.abs(bend) >= Math.abs(curve.curvatures[sharpest]);
    if (isSharper && !isByCorner(i)) sharpest = i;
  });
  return sharpest;
}

/** The greatest curvature of a path; infinite at a cusp, null if it has no points. */
export function maxCurvature(tracedCurve, cusps) {
  const { curve, circuit } = tracedCurve;
  if (curve.count === 0) return null;
  const limits = limitInputs(circuit);
  // Where it goes back the way it came.
  const turnsBack = (_, i) => limits.includes(curve.inputs[i]) && turnsBeyond(curve, i, -0.9);
  if (cusps > 0 || curve.samples.some(turnsBack)) return Infinity;
  const sharpest = sharpestSample(curve, circuit);
  if (sharpest < 0) return null;
  const sample = curve.samples[sharpest];
  let [a, b] = neighbourInputs(tracedCurve, sample);
  const here = circuit.input[sample];
  // At a limit the path is as smooth as elsewhere, but its rates do not give the curvature.
  if (limits.some((at) => Math.abs(at - here) <= Math.abs(b - a))) return maxCurvatureNear(curve, sharpest);
  const at = (input) => speedAndCurvature(tracedCurve, sample, input)[1];
  // To a thousandth of the way between samples: near its maximum the curvature changes little.
  for (let round = 0; round < 18; round++) {
    const [c, d] = [a + (b - a) / 3, b - (b - a) / 3];
    if (at(c) > at(d)) b = d;
    else a = c;
  }
  const [middle, own] = [at((a + b) / 2), at(here)];
  return own > middle || Number.isNaN(middle) ? own : middle;
}

/**
 * The ratio of the longest dash to the shortest: the first 3 of every 5 degrees of input, from input 0,
 * without those cut by the end of a pass. Null if the input is a length or there are no dashes.
 */
export function speedRatio({ linkage, circuit, alone }) {
  const [PERIOD, DRAWN, PLACES] = [5, 3, 5];
  if (linkage.input.isLength) return null;
  let [least, greatest] = [Infinity, 0];
  for (const pass of circuit.passes) {
    const [low, high] = passRange(pass);
    const [first, last] = [Math.ceil(low / PERIOD), Math.floor((high - DRAWN) / PERIOD)];
    const inputs = [];
    for (let k = first; k <= last; k++) {
      for (let i = 0; i < PLACES; i++) inputs.push(k * PERIOD + (DRAWN * i) / (PLACES - 1));
    }
    if (inputs.length === 0) continue;
    const columns = posesAt(alone.linkage, pass, inputs);
    const [x, y] = [columns.x[alone.joint], columns.y[alone.joint]];
    for (let begin = 0; begin < inputs.length; begin += PLACES) {
      const length = dashLength(x, y, begin, PLACES - 1);
      least = Math.min(least, length);
      greatest = Math.max(greatest, length);
    }
  }
  return greatest > 0 ? greatest / least : null;
}

// What chords miss of an arc is a quarter for chords half as long, but for the fourth power of their length:
// of three degrees, less than a millionth.
function dashLength(x, y, begin, chords) {
  const by = (step) => {
    let length = 0;
    for (let i = begin; i < begin + chords; i += step)
      length += Math.hypot(x[i + step] - x[i], y[i + step] - y[i]);
    return length;
  };
  return (4 * by(1) - by(2)) / 3;
}
