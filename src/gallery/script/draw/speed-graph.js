// Draws the graph of the speed of a traced point over its circuit.

import { clippedData } from "./clipping.js";

/**
 * The speeds on a path { points, inputs }, by chords: { inputs, speeds }, in units of length per `perInput`
 * of input (a radian in degrees, or 1), each at the middle of its chord.
 */
export function speedsOfPath({ points, inputs }, perInput) {
  const at = [];
  const speeds = [];
  for (let i = 0; i + 1 < inputs.length; i++) {
    const by = Math.abs(inputs[i + 1] - inputs[i]);
    const chord = Math.hypot(points[2 * i + 2] - points[2 * i], points[2 * i + 3] - points[2 * i + 1]);
    at.push((inputs[i] + inputs[i + 1]) / 2);
    speeds.push(by > 0 ? (chord / by) * perInput : NaN);
  }
  return { inputs: at, speeds };
}

/**
 * The greatest speed that a graph shows; speeds grow without bound towards limits, and are cut off there.
 */
export function maxShownSpeed(speeds) {
  const finite = speeds.filter(Number.isFinite).sort((a, b) => a - b);
  if (finite.length === 0) return 1;
  const most = finite[finite.length - 1];
  const usual = finite[Math.floor(0.8 * finite.length)];
  return most > 4 * usual && usual > 0 ? 2.5 * usual : most || 1;
}

/**
 * Path data of speeds over fractions of the circuit (0 to 1) in a frame { width, height }, with 0 at its
 * bottom and `top` at its top.
 */
export function speedData(parts, speeds, top, { width, height }) {
  const points = [];
  parts.forEach((part, k) => points.push(part * width, height * (1 - speeds[k] / top)));
  return clippedData(points, [0, -0.05 * height, width, height], 5);
}
