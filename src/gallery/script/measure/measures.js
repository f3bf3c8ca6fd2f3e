// Numbers read off a motion, under the names and definitions of the columns of cells.csv.

import { fourBarOf } from "../kinematics/four-bar.js";
import { singlePointLinkage } from "../kinematics/linkage.js";
import { inputDirection } from "../kinematics/pass.js";
import { refinedCircuit } from "../kinematics/sampling.js";
import { courseOfTrail } from "./course.js";
import { crossingsOfTrail } from "./crossings.js";
import { circularPortion } from "./dwell.js";
import { axisDegrees } from "./mirror.js";
import { cuspsOf, extentTowards, sharpestBend, speedRatioOf } from "./shape.js";
import { straightPortion } from "./straight.js";
import { SYMMETRY_NEAR, symmetryOf } from "./symmetry.js";
import { areaOfTrail, inflectionsOfTrail, lengthOfTrail, trailOf } from "./trail.js";
import { outputSwing, timeRatio, transmissionRange } from "./transmission.js";

/**
 * The measures of a joint's curve on a circuit, { name: number | string }; those that do not apply are
 * absent.
 *
 * @param asked { straight: { tolerance | input | length }, portions }: what is asked of the straight portion
 *   (a tolerance of 0.001 where nothing is); without `portions` (false) the straight and the circular portion
 *   are left out, which take the most of the time
 */
export function measuresOf(linkage, motion, circuit, joint, asked = {}) {
  const subject = subjectOf(linkage, motion, circuit, joint);
  const { trail } = subject;
  const portions = asked.portions === false ? {} : portionMeasures(subject, asked.straight ?? {});
  const found = {
    ...fourBarMeasures(subject),
    ...inputMeasures(circuit),
    length: lengthOfTrail(trail),
    area: areaOfTrail(trail),
    ...boxMeasures(subject),
    ...shapeMeasures(subject),
    ...symmetryMeasures(subject),
    speed_ratio: speedRatioOf(subject),
    ...portions,
  };
  const applies = ([, value]) => value !== null && !Number.isNaN(value);
  return Object.fromEntries(Object.entries(found).filter(applies));
}

/**
 * What measures are taken of: a joint on a circuit of a linkage's motion, by as many samples as tell of its
 * curves, with its trail, made once for all of them. A measure is one of the curve, however few its samples
 * are.
 */
function subjectOf(linkage, motion, sampled, joint) {
  const circuit = refinedCircuit(linkage, sampled);
  const trail = trailOf(circuit, joint, linkage.input);
  return {
    linkage,
    motion,
    circuit,
    joint,
    trail,
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

function boxMeasures(subject) {
  const reach = (x, y) => extentTowards(subject, [x, y]);
  // The least is the furthest the other way.
  const least = (extent) => (extent === null ? null : -extent);
  return {
    bbox_x_min: least(reach(-1, 0)),
    bbox_x_max: reach(1, 0),
    bbox_y_min: least(reach(0, -1)),
    bbox_y_max: reach(0, 1),
  };
}

function shapeMeasures(subject) {
  const cusps = cuspsOf(subject);
  return {
    cusps,
    crunodes: crossingsOfTrail(subject.trail).length,
    inflections: inflectionsOfTrail(subject.trail),
    curvature_max: sharpestBend(subject, cusps),
  };
}

function symmetryMeasures(subject) {
  const symmetry = symmetryOf(subject);
  if (!symmetry) return {};
  const { axis, residual, theorem } = symmetry;
  return {
    symmetry: theorem ?? (residual <= SYMMETRY_NEAR ? "other" : null),
    symmetry_deg: axis ? axisDegrees(axis) : null,
    symmetry_residual: residual,
  };
}

// Portions are looked for along a course; curves that have no place at most of their samples have none.
function portionMeasures({ trail }, asked) {
  if (trail.count < 5) return {};
  const course = courseOfTrail(trail);
  const straight = straightPortion(course, asked);
  const dwell = circularPortion(course);
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
