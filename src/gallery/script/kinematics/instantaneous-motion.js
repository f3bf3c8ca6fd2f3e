// The instantaneous motion of a link: its pole, inflection circle and centrodes. It does not depend on the
// speed of the input: derivatives are by the link's own angle. With w the vector from the pole to a
// point of the link, its velocity is i w and its acceleration q - w, where q goes from the pole to the
// inflection pole (Bottema and Roth, Theoretical Kinematics, chapter VIII).

import { fourBarOf, isOnCoupler } from "./four-bar.js";
import { groundOf, singlePointLinkage, placeOnLink } from "./linkage.js";
import { ratesAt } from "./poses.js";

// A link that turns by less than this part of what it moves along does not turn.
const POLE_AT_INFINITY = 1e-13;

/**
 * The instantaneous motion of the link of a joint at an input of a pass: { pole: [x, y], moving: [along,
 * left], inflection: [x, y], frame: [a, b] }, the instant centre in the plane and in the link's own frame
 * (from joint a, x towards joint b), and the inflection pole: the inflection circle has it and the pole at
 * the ends of a diameter, and the paths of the link's points on it are straight there to the second order.
 * Null where the link does not turn, and, but for the coupler of a four-bar, at a limit.
 */
export function poleAt(linkage, pass, input, joint) {
  return poleFromRates(linkage, ratesAt(linkage, pass, input), joint);
}

/** The same from the rates of all joints at that input. */
export function poleFromRates(linkage, rates, joint) {
  const link = linkFrameOf(linkage, joint);
  if (!link) return null;
  const { fourBar, frame } = link;
  return fourBar ? motionOfCoupler(fourBar, pointsOfPose(rates.place)) : motionOfLink(rates, frame);
}

/**
 * The fixed centrode over a circuit, of the link that a joint is on: Float64Array [x, y, …] by samples, NaN
 * where none.
 */
export function fixedCentrode(linkage, circuit, joint) {
  return centrodesOf(linkage, circuit, joint).fixed;
}

/**
 * The moving centrode over a circuit, of the link that a joint is on, in the link's own frame: { points,
 * frame: [a, b] }, the points from joint a, x towards joint b. It rolls on the fixed one.
 */
export function movingCentrode(linkage, circuit, joint) {
  const { moving, frame } = centrodesOf(linkage, circuit, joint);
  return { points: moving, frame };
}

function centrodesOf(linkage, circuit, joint) {
  const [fixed, moving] = [0, 1].map(() => new Float64Array(2 * circuit.count).fill(NaN));
  const link = linkFrameOf(linkage, joint);
  if (!link) return { fixed, moving, frame: null };
  const { fourBar, frame } = link;
  const base = Math.max(...frame) < joint ? singlePointLinkage(linkage, joint).linkage : linkage;
  for (let i = 0; i < circuit.count; i++) {
    const at = (id) => [circuit.x[id][i], circuit.y[id][i]];
    const instant = fourBar
      ? motionOfCoupler(fourBar, at)
      : motionOfLink(ratesAt(base, circuit.passes[circuit.pass[i]], circuit.input[i]), frame);
    if (!instant) continue;
    fixed.set(instant.pole, 2 * i);
    moving.set(instant.moving, 2 * i);
  }
  return { fixed, moving, frame };
}

// The link that a joint is on and moves with, by two joints of it; with the four-bar whose coupler it is.
function linkFrameOf(linkage, joint) {
  const fourBar = fourBarOf(linkage);
  if (fourBar && isOnCoupler(linkage, fourBar, joint))
    return { fourBar, frame: [fourBar.joints.a, fourBar.joints.b] };
  const ground = groundOf(linkage);
  const link = linkage.links.find((other) => other !== ground && placeOnLink(other, joint));
  const first = link?.[0];
  const second = link?.find(({ x, y }) => x !== first.x || y !== first.y);
  return second ? { fourBar: null, frame: [first.joint, second.joint] } : null;
}

function pointsOfPose(pose) {
  return (joint) => [pose[2 * joint], pose[2 * joint + 1]];
}

// Of a link through two joints, from their rates. A rigid arm e has e' = i w e and e'' = (i w' - w^2) e.
function motionOfLink({ place, velocity, acceleration }, [a, b]) {
  const arm = [place[2 * b] - place[2 * a], place[2 * b + 1] - place[2 * a + 1]];
  const size2 = arm[0] * arm[0] + arm[1] * arm[1];
  const turning = (rates) => {
    const [rx, ry] = [rates[2 * b] - rates[2 * a], rates[2 * b + 1] - rates[2 * a + 1]];
    return (arm[0] * ry - arm[1] * rx) / size2;
  };
  const [w, w1] = [turning(velocity), turning(acceleration)];
  const va = [velocity[2 * a], velocity[2 * a + 1]];
  // A link that only moves along has its pole at infinity, and not where rounding has it.
  if (!(Math.abs(w) * Math.sqrt(size2) > POLE_AT_INFINITY * Math.hypot(va[0], va[1]))) return null;
  // The joint's derivatives by the link's angle, from those by the input.
  const first = va.map((v) => v / w);
  const second = [0, 1].map((k) => (acceleration[2 * a + k] - first[k] * w1) / (w * w));
  return motionOfPlane([place[2 * a], place[2 * a + 1]], arm, first, second, [a, b]);
}

// Of the coupler of a four-bar on its frame, from where its pins are. At a limit, too: as its own angle goes,
// the coupler has no limits. There it turns about the crank's pin, while that is at rest.
function motionOfCoupler({ joints: { o, a, b, c } }, at) {
  const [po, pa, pb, pc] = [o, a, b, c].map(at);
  const [crank, coupler, rocker] = [minusVector(pa, po), minusVector(pb, pa), minusVector(pb, pc)];
  // crank' + coupler' = rocker', each a rate of turning times the arm's left normal, differentiated once
  // more.
  const area = crossVectors(crank, rocker);
  if (!(Math.abs(area) > POLE_AT_INFINITY * Math.hypot(...crank) * Math.hypot(...rocker))) return null;
  const left = ([x, y]) => [-y, x];
  const solve = (known) => [
    -crossVectors(known, left(rocker)) / area,
    -crossVectors(known, left(crank)) / area,
  ];
  const [wc1, wr1] = solve(left(coupler));
  const known = [0, 1].map((k) => -crank[k] * wc1 * wc1 - coupler[k] + rocker[k] * wr1 * wr1);
  const [wc2] = solve(known);
  const first = left(crank).map((x) => x * wc1);
  const second = [0, 1].map((k) => left(crank)[k] * wc2 - crank[k] * wc1 * wc1);
  return motionOfPlane(pa, coupler, first, second, [a, b]);
}

// Of a plane with a joint and an arm from it, and the joint's derivatives by the plane's angle.
function motionOfPlane(place, arm, first, second, frame) {
  const toPole = [-first[1], first[0]];
  const size = Math.hypot(...arm);
  const axis = arm.map((x) => x / size);
  // The acceleration of the point at the pole is a'' less what turning about the pole adds.
  const pole = [place[0] + toPole[0], place[1] + toPole[1]];
  const inflection = [0, 1].map((k) => pole[k] + second[k] - toPole[k]);
  const moving = [axis[0] * toPole[0] + axis[1] * toPole[1], crossVectors(axis, toPole)];
  const isKnown = [...pole, ...inflection, ...moving].every(Number.isFinite);
  return isKnown ? { pole, moving, inflection, frame } : null;
}

function minusVector(a, b) {
  return [a[0] - b[0], a[1] - b[1]];
}

function crossVectors(a, b) {
  return a[0] * b[1] - a[1] * b[0];
}
