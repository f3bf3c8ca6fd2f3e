// Computes the pose at an end of a pass, where dyads lie flat and bases may vanish.

import { placeJoints } from "./positions.js";
import { fixedFrameDerivatives } from "./derivatives.js";
import { inputDirection } from "./pass.js";
import { dyadSigns, sideOf } from "./assembly-mode.js";

// A base shorter than this part of its dyad's links has no direction left but its rounding.
const VANISHING_BASE = 1e-12;

/**
 * Places every joint at one sample where a pass begins or ends, in the frame of the fixed joints. `inputs`
 * are columns as long as those of the places; the end's own input is put there for the purpose.
 *
 * A flat dyad is laid out by its first link's own length. Where a base vanishes its joint is placed by
 * continuity: the base then points along its rate of change, or, where that is infinite at a limit, along the
 * rate of its parts with the root of the input. Where there is no such direction the joint stays undefined.
 */
export function placeAtEnd(linkage, pass, begins, inputs, columns, sample) {
  const end = begins ? pass.begin : pass.end;
  const inwards = begins ? inputDirection(pass) : -inputDirection(pass);
  const modes = dyadSigns(pass.signs, end.flat, linkage.dyads);
  const kept = inputs.at[sample];
  inputs.at[sample] = end.at;
  inputs.cos[sample] = end.cos;
  inputs.sin[sample] = end.sin;
  placeJoints(linkage, [0, linkage.joints.length], inputs, modes, columns, sample, sample + 1);
  if (end.flat !== 0) settleFlatJoints({ linkage, pass, end, inwards, inputs, columns, sample, modes });
  inputs.at[sample] = kept;
}

function settleFlatJoints(pose) {
  const { linkage, end, inputs, columns, sample, modes } = pose;
  linkage.joints.forEach(({ step }, id) => {
    const isFlat = step.index !== undefined && ((end.flat >> step.index) & 1) === 1;
    let place = null;
    if (isFlat && step.kind === "dyad") place = flatDyad(pose, step);
    // A slot without offset whose joint is on its pivot: the line keeps its direction.
    else if (isFlat && step.kind === "directed" && step.lineIs === "turned") place = vanishedLine(pose, step);
    if (place) {
      [columns.x[id][sample], columns.y[id][sample]] = place;
    } else {
      // Joints that depend on one placed here are placed again.
      placeJoints(linkage, [id, id + 1], inputs, modes, columns, sample, sample + 1);
    }
  });
}

function flatDyad(pose, { base: [p, q], lengths, index }) {
  const [from, to] = [pointOfPose(pose, p), pointOfPose(pose, q)];
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const d = Math.sqrt(dx * dx + dy * dy);
  if (d > VANISHING_BASE * lengths[0]) {
    const by = flatFoot(lengths, d) / d;
    return [from[0] + dx * by, from[1] + dy * by];
  }
  // On a base of no length the two links have one length and lie on one line, square to the base.
  const direction = baseDirection(pose, [p, q]);
  if (!direction) return [NaN, NaN];
  const height = sideOf(pose.pass.signs, index) * lengths[0];
  return [from[0] - direction[1] * height, from[1] + direction[0] * height];
}

function vanishedLine(pose, { from, line, index, along, across }) {
  const direction = baseDirection(pose, line);
  if (!direction) return [NaN, NaN];
  const sense = -sideOf(pose.pass.signs, index);
  const [ux, uy] = direction;
  const [x, y] = pointOfPose(pose, from);
  return [x + (ux * along - uy * across) * sense, y + (uy * along + ux * across) * sense];
}

function pointOfPose({ columns, sample }, joint) {
  return [columns.x[joint][sample], columns.y[joint][sample]];
}

// Where the joint of a flat dyad lies on its base, from the base's first joint.
function flatFoot([l0, l1], base) {
  return l0 < l1 && base < l1 ? -l0 : l0;
}

// The direction that a vanished base has in the pass, just inside its end; null where it has none.
function baseDirection(pose, [p, q]) {
  const { linkage, end, pass, inwards } = pose;
  const jets = fixedFrameDerivatives(linkage, end, pass.signs, end.flat, 0, 3);
  const rate = ["x", "y"].map((axis) => boundedRate(jets[q][axis][1], jets[p][axis][1]) * inwards);
  let found = rate;
  if (!rate.every(Number.isFinite)) {
    const [of, from] = [rootRate(pose, q, jets), rootRate(pose, p, jets)];
    if (!of || !from) return null;
    found = [of[0] - from[0], of[1] - from[1]];
  }
  const size = Math.sqrt(found[0] * found[0] + found[1] * found[1]);
  return size > 0 && Number.isFinite(size) ? [found[0] / size, found[1] / size] : null;
}

// A rate is infinite where anything it depends on is.
function boundedRate(a, b) {
  return (Number.isNaN(a) ? Infinity : a) - (Number.isNaN(b) ? Infinity : b);
}

// How a joint leaves a limit: its place goes with the root of the input, and this is the factor; null where
// it is unknown.
function rootRate(pose, joint, jets) {
  const { step } = pose.linkage.joints[joint];
  const isFlat = step.index !== undefined && ((pose.end.flat >> step.index) & 1) === 1;
  const surges = (joints) => {
    const found = joints.map((other) => rootRate(pose, other, jets));
    return found.every(Boolean) ? found : null;
  };
  switch (step.kind) {
    case "fixed":
    case "crank":
    case "gear":
      return [0, 0];
    case "rigid": {
      const found = surges(step.base);
      if (!found) return null;
      const [[px, py], [qx, qy]] = found;
      const [dx, dy] = [qx - px, qy - py];
      return [px + dx * step.along - dy * step.across, py + dy * step.along + dx * step.across];
    }
    case "parallelogram": {
      const found = surges(step.corners);
      return found && [0, 1].map((k) => found[0][k] + found[2][k] - found[1][k]);
    }
    case "dyad":
      return isFlat ? rootRateOfFlatDyad(pose, step, jets) : rootRateOfDyad(pose, joint, surges(step.base));
    case "slot":
      return isFlat && step.offset !== 0 ? rootRateOfFlatSlot(pose, step, jets) : null;
    default:
      return null;
  }
}

function baseAndRate(pose, [p, q], jets) {
  const [from, to] = [pointOfPose(pose, p), pointOfPose(pose, q)];
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const [vx, vy] = ["x", "y"].map((axis) => boundedRate(jets[q][axis][1], jets[p][axis][1]));
  return { dx, dy, d: Math.sqrt(dx * dx + dy * dy), rate: dx * vx + dy * vy };
}

// The square of the height is l0^2 - foot^2, with foot = (d^2 + l0^2 - l1^2) / 2d: its rate is finite.
function rootRateOfFlatDyad(pose, { base, lengths: [l0, l1], index }, jets) {
  const { dx, dy, d, rate } = baseAndRate(pose, base, jets);
  const footRate = ((0.5 - ((l0 - l1) * (l0 + l1)) / (2 * d * d)) * rate) / d;
  const factor = Math.sqrt(Math.abs(2 * flatFoot([l0, l1], d) * footRate));
  const by = (sideOf(pose.pass.signs, index) * factor) / d;
  return Number.isFinite(factor) ? [-dy * by, dx * by] : null;
}

// The square of the slide is d^2 - e^2, and at the limit the foot goes as the slide does.
function rootRateOfFlatSlot(pose, { base, offset, index }, jets) {
  const { dx, dy, d, rate } = baseAndRate(pose, base, jets);
  const factor = Math.sqrt(Math.abs(2 * rate)) * sideOf(pose.pass.signs, index) * Math.sign(offset);
  return Number.isFinite(factor) ? [(-dy * factor) / d, (dx * factor) / d] : null;
}

// Both links keep their lengths: u . v = u . vp and w . v = w . vq.
function rootRateOfDyad(pose, joint, found) {
  if (!found) return null;
  const [at, p, q] = [joint, ...pose.linkage.joints[joint].step.base].map((other) =>
    pointOfPose(pose, other),
  );
  const [ux, uy, wx, wy] = [at[0] - p[0], at[1] - p[1], at[0] - q[0], at[1] - q[1]];
  const a = ux * found[0][0] + uy * found[0][1];
  const b = wx * found[1][0] + wy * found[1][1];
  const area = ux * wy - uy * wx;
  return [(a * wy - b * uy) / area, (b * ux - a * wx) / area];
}
