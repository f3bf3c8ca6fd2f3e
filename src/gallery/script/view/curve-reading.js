// The readings of a curve at a point: input, speed, transmission angle, from the kernel.

import { formatNumber } from "./labels.js";
import { timelineOf } from "./plate/timeline.js";

/**
 * A curve, solved by the kernel, on its own circuit or on that with an index among all; null if it cannot be. Its
 * path is accurate to a tolerance in units of the plane; the input of a reading is in degrees or a length.
 * @param {Kernel} kernel @param {KernelCurve} requested @param {number | null} circuit
 */
export function solveCurve(kernel, requested, circuit = null) {
  return orNull(() => {
    const study = kernel.study(requested, { shown: circuit, isRough: true });
    const { answer } = study;
    if (answer.study === undefined) return null;
    const { circuits, shown, is_length: isLength } = answer;
    const { passes, closed } = circuits[shown];
    return {
      path: (/** @type {number} */ tolerance) => orNull(() => study.path(tolerance).lead),
      closed,
      isLength,
      passes,
      timeline: timelineOf(circuits[shown]),
      nearTo: (/** @type {number} */ x, /** @type {number} */ y) => orNull(() => study.nearest(x, y)),
      atInput: (/** @type {number} */ pass, /** @type {number} */ input) =>
        orNull(() => study.reading(pass, input)),
      close: () => study.close(),
    };
  });
}

/** @template T @param {() => T} work */
function orNull(work) {
  try {
    return work();
  } catch {
    return null;
  }
}

/** The readings at a point of a curve: [[name, value with unit], …]. @param {Reading} _ @param {SolvedCurve} _1 */
export function readingRows({ input, speed, mu }, { isLength, passes }) {
  return [
    ["input", isLength ? formatNumber(input) : formatInputAngle(input, passes)],
    ["speed", `${formatNumber(speed, 4)} per ${isLength ? "unit" : "rad"}`],
    ...(mu === null || !Number.isFinite(mu) ? [] : [["transmission", `${mu.toFixed(1)}°`]]),
  ];
}

/** Degrees of input; for a full rotation, the end of the period equals its start. @param {Pass[]} passes */
function formatInputAngle(/** @type {number} */ input, passes) {
  const text = input.toFixed(1);
  const period = Math.abs(passes[0].to - passes[0].from);
  if (passes.length === 1 && period % 360 === 0 && text === period.toFixed(1)) return "0.0°";
  return `${text.replace("-", "−")}°`;
}
