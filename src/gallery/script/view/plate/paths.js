// The curves of a study as path data in the plane.

import { measureValue } from "../../data/family.js";
import { circuitPortion } from "../../draw/circuit-portion.js";
import { dashData, dashPattern } from "../../draw/dashes.js";
import { roundingGrid, polylineData } from "../../draw/path-data.js";
import { roundBelow } from "../../draw/plane-view.js";
import { formatLength } from "./speed-view.js";
import { formatDecimals } from "./study.js";

// With more other points than this, fewer of their samples are drawn.
const MANY_POINTS = 12;

/**
 * The input covered by a dash and its gap: the family's, or, for a length, a round fraction of the longest
 * pass.
 */
function dashPeriod(family, { linkage, circuit }) {
  if (!linkage.input.isLength) return family.dash_deg;
  return roundBelow(Math.max(...circuit.passes.map(({ from, to }) => Math.abs(to - from))) / 20);
}

/**
 * Path data { dashes, lead, others, band } of a study's curve, from its path and its straight portion. `on`
 * has the names of the selected overlays.
 */
export function pathsOfStudy(family, study, path, portion, { on, isRough }) {
  const { circuit, others } = study;
  const grid = roundingGrid(study.size);
  const shown = on.has("others") ? others : [];
  const stride = others.length > MANY_POINTS ? (isRough ? 4 : 2) : 1;
  return {
    dashes: dashData(path, dashPattern(dashPeriod(family, study))),
    lead: polylineData(path.points),
    others: shown.map((joint) => sampledPathData(circuit, joint, stride, grid)).join(""),
    band: portion ? polylineData(portion.points) : "",
  };
}

function sampledPathData({ x, y, count, closed }, joint, stride, grid) {
  const points = [];
  for (let i = 0; i < count; i += stride) points.push(x[joint][i], y[joint][i]);
  if (closed) points.push(x[joint][0], y[joint][0]);
  return polylineData(points, { grid });
}

/**
 * The description of a curve's straight portion: its length, its deviation from the line, and its range of
 * input.
 */
export function straightSummary({ linkage }, family, curve, measures) {
  const [length, deviation, span] = ["straight_length", "straight_deviation", "straight_input_deg"].map(
    (name) => (measures ? measures[name] : measureValue(family, curve, name)),
  );
  // A family may be measured only in part.
  if (![length, deviation, span].every(Number.isFinite)) return "";
  const over = linkage.input.isLength ? formatLength(span) : `${formatDecimals(span, 1)}°`;
  const within = `within ${formatLength(deviation)} of its line`;
  return `Straight portion: ${formatLength(length)} long, ${within}, over ${over} of input`;
}

/**
 * The straight portion of a study's curve (draw/circuit-portion.js), from the computed measures { name: value
 * }, or, if null, those of the atlas. Null if there is none, or if it is too short to be visible.
 */
export function visibleStraightPortion(study, family, curve, measures) {
  const { linkage, circuit, joint, curveBox } = study;
  const of = (name) => (measures ? measures[name] : measureValue(family, curve, name));
  const [start, span, length] = ["straight_start_deg", "straight_input_deg", "straight_length"].map(of);
  const extent = Math.max(curveBox[2] - curveBox[0], curveBox[3] - curveBox[1]);
  if (![start, span, length].every(Number.isFinite) || length < 0.02 * extent) return null;
  return circuitPortion(linkage, circuit, joint, { start, span, length });
}
