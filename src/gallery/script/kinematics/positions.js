// Positions of all joints at many inputs: a column for each joint, { x: [Float64Array per joint], y: […],
// count }.

import { cosSinOfDegrees } from "./angles.js";
import {
  placeParallelogram,
  placeCrank,
  placeAligned,
  placeDyad,
  placePiston,
  placeRigid,
  placeSlide,
  placeSlot,
  placeYoke,
} from "./dyads.js";
import { groundOf, placeOnLink } from "./linkage.js";

/** Empty columns for a number of joints at a number of inputs. */
export function newPositions(joints, count) {
  const column = () => new Float64Array(count);
  return { x: Array.from({ length: joints }, column), y: Array.from({ length: joints }, column), count };
}

/**
 * Input positions { at, cos, sin } as columns { at, cos, sin }; `at` is in degrees, or a length, and then cos
 * is 0.
 */
export function inputColumns(stops) {
  const [at, cos, sin] = [0, 1, 2].map(() => new Float64Array(stops.length));
  stops.forEach((stop, i) => {
    [at[i], cos[i], sin[i]] = [stop.at, stop.cos, stop.sin];
  });
  return { at, cos, sin };
}

/** The input position at a value, { at, cos, sin }. */
export function inputPosition(input, at) {
  if (input.isLength) return { at, cos: 0, sin: 0 };
  const [cos, sin] = cosSinOfDegrees(at);
  return { at, cos, sin };
}

/** The angle in degrees of a crank geared to the input. */
export function gearedAngle(at, [turns, of], phase) {
  // Whole periods are subtracted first: the ratio of what is left is the more exact.
  return ((at % (360 * of)) * turns) / of + phase;
}

/**
 * Places joints `from` up to, not with, `to` from those before them at the inputs `first` up to, not with,
 * `last`, in the frame of the fixed joints. `modes` is what each dyad's height is multiplied by.
 */
export function placeJoints(linkage, [from, to], inputs, modes, columns, first, last) {
  for (let id = from; id < to; id++)
    placeJoint(linkage.joints[id].step, id, inputs, modes, columns, first, last);
}

function placeJoint(step, id, inputs, modes, columns, first, last) {
  const { x, y } = { x: columns.x[id], y: columns.y[id] };
  const of = (joint) => ({ x: columns.x[joint], y: columns.y[joint] });
  const run = [x, y, first, last];
  switch (step.kind) {
    case "fixed":
      x.fill(step.x, first, last);
      y.fill(step.y, first, last);
      break;
    case "crank":
      placeCrank(of(step.pivot), step.length, inputs.cos, inputs.sin, x, y, first, last);
      break;
    case "gear": {
      const { cos, sin } = gearedColumns(step, inputs.at, first, last);
      placeCrank(of(step.pivot), step.length, cos, sin, x, y, first, last);
      break;
    }
    case "piston":
      placePiston(
        of(step.base[0]),
        of(step.base[1]),
        inputs.at,
        step.length,
        step.offset,
        modes[step.index],
        ...run,
      );
      break;
    case "dyad":
      placeDyad(of(step.base[0]), of(step.base[1]), step.lengths, modes[step.index], x, y, first, last);
      break;
    case "slide": {
      const [p, q] = step.line.map(of);
      placeSlide(of(step.from), step.length, p, q, step.offset, modes[step.index], ...run);
      break;
    }
    case "slot":
      if (step.offset === 0) placeRigid(of(step.base[0]), of(step.base[0]), 0, 0, x, y, first, last);
      else placeSlot(of(step.base[0]), of(step.base[1]), step.offset, modes[step.index], ...run);
      break;
    case "yoke":
      placeYoke(of(step.from), of(step.line[0]), of(step.line[1]), step.offset, step.lean, ...run);
      break;
    case "directed": {
      const [p, q] = step.line.map(of);
      const sense = step.lineIs === "turned" ? -modes[step.index] : 1;
      const known = step.lineIs === "driven" ? inputs.at : null;
      placeAligned(of(step.from), p, q, step.offset, known, step.along * sense, step.across * sense, ...run);
      break;
    }
    case "parallelogram":
      placeParallelogram(...step.corners.map(of), x, y, first, last);
      break;
    case "rigid":
      placeRigid(of(step.base[0]), of(step.base[1]), step.along, step.across, x, y, first, last);
      break;
  }
}

function gearedColumns({ ratio, phase }, at, first, last) {
  const [cos, sin] = [new Float64Array(at.length), new Float64Array(at.length)];
  for (let i = first; i < last; i++) [cos[i], sin[i]] = cosSinOfDegrees(gearedAngle(at[i], ratio, phase));
  return { cos, sin };
}

/**
 * Converts positions, in place, to the frame they are reported in: that of the link seen from, then the
 * linkage's orientation.
 */
export function convertToViewFrame(linkage, columns) {
  if (linkage.seenFrom) seeFromLink(linkage, columns);
  const { mirror, cos, sin } = linkage.placement;
  if (!mirror && cos === 1) return;
  const hand = mirror ? -1 : 1;
  for (let joint = 0; joint < columns.x.length; joint++) {
    const [x, y] = [columns.x[joint], columns.y[joint]];
    for (let i = 0; i < columns.count; i++) {
      const [u, v] = [x[i], hand * y[i]];
      x[i] = cos * u - sin * v;
      y[i] = sin * u + cos * v;
    }
  }
}

function seeFromLink(linkage, columns) {
  const [origin, end] = linkage.seenFrom;
  // The link is rigid: its length is known, and dividing by it keeps every other length too.
  const [from, to] = linkage.seenFrom.map((joint) => placeOnLink(groundOf(linkage), joint));
  const length = Math.sqrt((to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y));
  const { x, y, count } = columns;
  for (let i = 0; i < count; i++) {
    const [ox, oy] = [x[origin][i], y[origin][i]];
    const ux = (x[end][i] - ox) / length;
    const uy = (y[end][i] - oy) / length;
    for (let joint = 0; joint < x.length; joint++) {
      const [vx, vy] = [x[joint][i] - ox, y[joint][i] - oy];
      x[joint][i] = ux * vx + uy * vy;
      y[joint][i] = ux * vy - uy * vx;
    }
  }
}
