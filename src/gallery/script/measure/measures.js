// Computes the measures of a curve, with the names and definitions of the columns of cells.csv.

import { fourBarOf } from "../kinematics/four-bar.js";
import { singlePointLinkage } from "../kinematics/linkage.js";
import { inputDirection } from "../kinematics/pass.js";
import { refinedCircuit } from "../kinematics/sampling.js";
import { wholeCurve } from "./curve-segment.js";
import { findCrunodes } from "./crossings.js";
import { circularPortion } from "./dwell.js";
import { axisDirectionDeg } from "./symmetry-axis.js";
import { countCusps, extentMeasure, maxCurvature, speedRatio } from "./shape.js";
import { straightPortion } from "./straight.js";
import { SYMMETRY_TOLERANCE, findSymmetry } from "./symmetry.js";
import { enclosedArea, inflectionCount, curveLength, sampledCurveOf } from "./sampled-curve.js";
import { outputSwing, timeRatio, transmissionRange } from "./transmission.js";

/**
 * The measures of a joint's curve on a circuit, { name: number | string }; those that do not apply are
 * absent.
 *
 * @param options { straight: { tolerance | input | length }, portions }: the criterion of the straight portion
 *   (a tolerance of 0.001 by default); with `portions` false the straight and the circular portion are left out,
 *   which take most of the time
 */
export function measuresOf(linkage, motion, circuit, joint, options = {}) {
  const tracedCurve = tracedCurveOf(linkage, motion, circuit, joint);
  const { curve } = tracedCurve;
  const portions = options.portions === false ? {} : portionMeasures(tracedCurve, options.straight ?? {});
  const found = {
    ...fourBarMeasures(tracedCurve),
    ...inputMeasures(circuit),
    length: curveLength(curve),
    area: enclosedArea(curve),
    ...boxMeasures(tracedCurve),
    ...shapeMeasures(tracedCurve),
    ...symmetryMeasures(tracedCurve),
    speed_ratio: speedRatio(tracedCurve),
    ...portions,
  };
  const applies = ([, value]) => value !== null && !Number.isNaN(value);
  return Object.fromEntries(Object.entries(found).filter(applies));
}

/**
 * The curve to be measured: a joint on a circuit of a linkage's motion, sampled densely enough to
 * interpolate, with its sampled curve, computed once for all measures. Measures do not depend on how few
 * samples were given.
 */
function tracedCurveOf(linkage, motion, sampled, joint) {
  const circuit = refinedCircuit(linkage, sampled);
  const curve = sampledCurveOf(circuit, joint, linkage.input);
  return {
    linkage,
    motion,
    circuit,
    joint,
    curve,
    fourBar: fourBarOf(linkage),
    alone: singlePointLinkage(linkage, joint),
  };
}

function fourBarMeasures({ linkage, circuit, fourBar }) {
  if (!fourBar) return {};
  const [least, greatest] = transmissionRange(linkage, circuit, fourBar);
  return {
    class: fourBar.class,
    type: fourBar.type,
    shortest: fourBar.shortest,
    output_swing_deg: outputSwing(linkage, circuit, fourBar),
    mu_min_deg: least,
    mu_max_deg: greatest,
    time_ratio: timeRatio(linkage, circuit, fourBar),
  };
}

// The least and the greatest input; none on a full turn.
function inputMeasures({ passes, closed }) {
  const turnsRound = passes.some((pass) => inputDirection(pass) !== inputDirection(passes[0]));
  if (closed && !turnsRound) return {};
  const ends = passes.flatMap((pass) => [pass.from, pass.to]);
  return { input_min_deg: Math.min(...ends), input_max_deg: Math.max(...ends) };
}

function boxMeasures(tracedCurve) {
  const reach = (x, y) => extentMeasure(tracedCurve, [x, y]);
  // The least is the furthest the other way.
  const least = (extent) => (extent === null ? null : -extent);
  return {
    bbox_x_min: least(reach(-1, 0)),
    bbox_x_max: reach(1, 0),
    bbox_y_min: least(reach(0, -1)),
    bbox_y_max: reach(0, 1),
  };
}

function shapeMeasures(tracedCurve) {
  const cusps = countCusps(tracedCurve);
  return {
    cusps,
    crunodes: findCrunodes(tracedCurve.curve).length,
    inflections: inflectionCount(tracedCurve.curve),
    curvature_max: maxCurvature(tracedCurve, cusps),
  };
}

function symmetryMeasures(tracedCurve) {
  const symmetry = findSymmetry(tracedCurve);
  if (!symmetry) return {};
  const { axis, residual, theorem } = symmetry;
  return {
    symmetry: theorem ?? (residual <= SYMMETRY_TOLERANCE ? "other" : null),
    symmetry_deg: axis ? axisDirectionDeg(axis) : null,
    symmetry_residual: residual,
  };
}

// The straight and the circular portion; curves without a position at most of their samples have none.
function portionMeasures({ curve }, criterion) {
  if (curve.count < 5) return {};
  const segment = wholeCurve(curve);
  const straight = straightPortion(segment, criterion);
  const dwell = circularPortion(segment);
  const found = {};
  if (straight) {
    found.straight_length = straight.length;
    found.straight_deviation = straight.deviation;
    found.straight_start_deg = straight.start;
    found.straight_input_deg = straight.input;
  }
  if (dwell) {
    found.dwell_input_deg = dwell.input;
    found.dwell_radius = dwell.radius;
    found.dwell_deviation = dwell.deviation;
    found.dwell_start_deg = dwell.start;
    found.dwell_x = dwell.x;
    found.dwell_y = dwell.y;
  }
  return found;
}
