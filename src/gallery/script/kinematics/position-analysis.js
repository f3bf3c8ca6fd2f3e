// Computes the angles of a four-bar and of an inverted slider-crank, as defined by McCarthy and Soh
// (Geometric Design of Linkages), at a sample { linkage, rates, input, side }: the rates of all joints there,
// the input in degrees or as a length, and the side (1 or -1) of each two-valued joint, side(index). Angles
// are in degrees, rates per radian of input or unit of length; NaN for a linkage that is neither.

import { degreesOf } from "./angles.js";
import { fourBarOf } from "./four-bar.js";
import { handednessOf } from "./linkage.js";

/** The output angle psi: (2.52), of an inverted slider-crank (2.45); from -180 to 180. */
export function psiAt(sample) {
  const bar = fourBarJoints(sample);
  if (bar) return angleBetween(armOf(sample, bar.o, bar.c), armOf(sample, bar.c, bar.b));
  const slider = invertedSliderCrank(sample);
  if (!slider) return NaN;
  const { o, a, c } = slider;
  const angle = angleBetween(armOf(sample, o, c), armOf(sample, c, a)) - betaOf(slider);
  const turns = angle / 360;
  // Half turns are rounded away from none.
  return angle - 360 * Math.sign(turns) * Math.round(Math.abs(turns));
}

/** The coupler angle phi from the crank: (2.57). */
export function phiAt(sample) {
  const bar = fourBarJoints(sample);
  return bar ? angleBetween(armOf(sample, bar.o, bar.a), armOf(sample, bar.a, bar.b)) : NaN;
}

/** The transmission angle mu at the rocker's pin, from 0 to 180: section 2.3.3. */
export function muAt(sample) {
  const bar = fourBarJoints(sample);
  return bar ? Math.abs(angleBetween(armOf(sample, bar.b, bar.a), armOf(sample, bar.b, bar.c))) : NaN;
}

/** The angular velocity of the output to that of the input. */
export function psiRatioAt(sample) {
  const bar = fourBarJoints(sample);
  if (bar) return angularVelocityRatio(sample, bar.c, bar.b);
  const slider = invertedSliderCrank(sample);
  if (!slider) return NaN;
  const { a, c, offset, rate } = slider;
  const [x, y] = armOf(sample, c, a);
  // As psi is the angle of C-A less beta, whose rate is e s' / b^2.
  return boundedRatio(angularVelocityRatio(sample, c, a) - (offset * rate) / (x * x + y * y));
}

/** The angular velocity of the coupler to that of the input. */
export function phiRatioAt(sample) {
  const bar = fourBarJoints(sample);
  return bar ? angularVelocityRatio(sample, bar.a, bar.b) : NaN;
}

/** A^2 + B^2 - C^2, which is not negative where the four-bar can be assembled: (2.53), with (2.51). */
export function solvabilityAt(sample) {
  const bar = fourBarJoints(sample);
  if (!bar) return NaN;
  const { frame: g, crank: a, coupler: h, rocker: b } = bar.lengths;
  const theta = Math.atan2(...sineAndCosine(armOf(sample, bar.o, bar.c), armOf(sample, bar.o, bar.a)));
  const A = 2 * a * b * Math.cos(theta) - 2 * g * b;
  const B = 2 * a * b * Math.sin(theta);
  const C = g * g + b * b + a * a - h * h - 2 * a * g * Math.cos(theta);
  return A * A + B * B - C * C;
}

/** The slide s of an inverted slider-crank: (2.42). */
export function slideAt(sample) {
  return invertedSliderCrank(sample)?.slide ?? NaN;
}

/** The distance b = |CA| of an inverted slider-crank: (2.40). */
export function distanceAt(sample) {
  const slider = invertedSliderCrank(sample);
  if (!slider) return NaN;
  const [x, y] = armOf(sample, slider.c, slider.a);
  return Math.sqrt(x * x + y * y);
}

/** The angle beta from CB to CA of an inverted slider-crank: (2.40). */
export function betaAt(sample) {
  const slider = invertedSliderCrank(sample);
  return slider ? betaOf(slider) : NaN;
}

// b cos beta = e and b sin beta = s.
function betaOf({ slide, offset }) {
  return degreesOf(Math.atan2(slide, offset));
}

// The four-bar on its fixed frame; null if seen from another link, where other angles have these names.
function fourBarJoints({ linkage }) {
  const bar = linkage.seenFrom ? null : fourBarOf(linkage);
  return bar && { ...bar.joints, lengths: bar };
}

// McCarthy's inverted slider-crank, { o, a, c, offset, slide, rate (of the slide) }: a slot on the crank's
// pin, or the actuator that drives it.
function invertedSliderCrank(sample) {
  const { linkage, input } = sample;
  if (linkage.seenFrom) return null;
  const crank = linkage.joints.findIndex(({ step }) => step.kind === "crank");
  for (const [id, { step }] of linkage.joints.entries()) {
    if (step.kind === "slot" && crank >= 0 && step.base[1] === crank)
      return slotSlider(sample, linkage.joints[crank].step.pivot, step);
    if (step.kind === "piston")
      return { o: step.base[1], a: id, c: step.base[0], offset: step.offset, slide: input, rate: 1 };
  }
  return null;
}

// McCarthy draws the foot to the right of C -> A: there the slide is positive.
function slotSlider(sample, o, { base: [c, a], offset, index }) {
  const [x, y] = armOf(sample, c, a);
  const side = -sample.side(index) * (offset < 0 ? -1 : 1);
  const slide = side * Math.sqrt(Math.max(x * x + y * y - offset * offset, 0));
  const [vx, vy] = rateOfArm(sample, c, a);
  return { o, a, c, offset: Math.abs(offset), slide, rate: (x * vx + y * vy) / slide };
}

// From one joint to another as the linkage's own frame has it, but for a turn: one that is placed mirrored
// keeps its angles.
function armOf({ linkage, rates: { place } }, from, to) {
  return [place[2 * to] - place[2 * from], (place[2 * to + 1] - place[2 * from + 1]) * handednessOf(linkage)];
}

function rateOfArm({ linkage, rates: { velocity } }, from, to) {
  return [
    velocity[2 * to] - velocity[2 * from],
    (velocity[2 * to + 1] - velocity[2 * from + 1]) * handednessOf(linkage),
  ];
}

// How fast the line between two joints turns.
function angularVelocityRatio(sample, from, to) {
  const [x, y] = armOf(sample, from, to);
  const [vx, vy] = rateOfArm(sample, from, to);
  return boundedRatio((x * vy - y * vx) / (x * x + y * y));
}

function boundedRatio(ratio) {
  return Number.isFinite(ratio) ? ratio : Infinity;
}

function angleBetween(from, to) {
  return degreesOf(Math.atan2(...sineAndCosine(from, to)));
}

// Of the angle from one vector to another, times both lengths.
function sineAndCosine([ax, ay], [bx, by]) {
  return [ax * by - ay * bx, ax * bx + ay * by];
}
