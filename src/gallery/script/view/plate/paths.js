// The curves of a study as path data in the plane.

import { measureValue } from "../../data/family.js";
import { roundingGrid, polylineData } from "../../draw/path-data.js";
import { formatDecimals, formatLength } from "../labels.js";

// With more other points than this, fewer of their samples are drawn.
const MANY_POINTS = 12;
// The chord error of the curve of the atlas behind a changed one, relative to the size of the linkage.
const RECORDED_PATH = 2e-4;

/**
 * Path data of a study's curve, from its path and its straight portion. `on` has the names of the selected overlays.
 * @param {Study} study @param {CurvePath} path @param {StraightPortion | null} portion @param {{ on: Set<string>, isRough: boolean }} _
 */
export function pathsOfStudy(study, path, portion, { on, isRough }) {
  const { others } = study;
  const { closed } = study.circuits[study.shown];
  const grid = roundingGrid(study.size);
  const shown = on.has("others") ? others : [];
  const stride = others.length > MANY_POINTS ? (isRough ? 4 : 2) : 1;
  return {
    dashes: dashesData(path),
    lead: polylineData(path.lead),
    others: shown.map(({ points }) => polylineData(everyNth(points, stride, closed), { grid })).join(""),
    band: portion ? polylineData(portion.points) : "",
  };
}

/** Path data of a curve as the atlas has it. @param {Kernel} kernel @param {Family} family @param {number} curve */
export function recordedPath(kernel, family, curve) {
  const study = kernel.study(kernel.curve(family, curve), { isRough: true });
  const [x0, y0, x1, y1] = "box" in study.answer ? study.answer.box : [0, 0, 0, 0];
  const data = study.exists
    ? polylineData(study.path(RECORDED_PATH * Math.hypot(x1 - x0, y1 - y0)).lead)
    : "";
  study.close();
  return data;
}

function dashesData(/** @type {CurvePath} */ { dashes, starts }) {
  /** @param {number} first @param {number} k */
  const dash = (first, k) => polylineData(dashes, { first, last: starts[k + 1] ?? dashes.length / 2 });
  return Array.from(starts, dash).join("");
}

// Every n-th point, and again the first of a closed curve.
function everyNth(/** @type {Points} */ points, /** @type {number} */ stride, /** @type {boolean} */ closed) {
  const chosen = [];
  for (let k = 0; k < points.length; k += 2 * stride) chosen.push(points[k], points[k + 1]);
  if (closed) chosen.push(points[0], points[1]);
  return chosen;
}

/**
 * The description of a curve's straight portion: its length, its deviation from the line, and its range of
 * input, from computed measures { name: value }, or, if null, those of the atlas.
 * @param {Study} _ @param {Family} family @param {Measured | null} measures
 */
export function straightSummary({ is_length: isLength }, family, /** @type {number} */ curve, measures) {
  const [length, deviation, span] = ["straight_length", "straight_deviation", "straight_input_deg"].map(
    (name) => Number(measures ? measures[name] : measureValue(family, curve, name)),
  );
  // A family may be measured only in part.
  if (![length, deviation, span].every(Number.isFinite)) return "";
  const over = isLength ? formatLength(span) : `${formatDecimals(span, 1)}°`;
  const within = `within ${formatLength(deviation)} of its line`;
  return `Straight portion: ${formatLength(length)} long, ${within}, over ${over} of input`;
}

/** The straight portion of a study's curve (KernelStudy.measures); null if it is too short to be visible. @param {Study} _ @param {ComputedMeasures} _1 */
export function visibleStraightPortion({ curve_box: [x0, y0, x1, y1] }, { straight, values }) {
  const isVisible = Number(values.straight_length) >= 0.02 * Math.max(x1 - x0, y1 - y0);
  return straight && isVisible ? straight : null;
}
