// Computes velocities, accelerations and jerks of all joints by Taylor series through the chain of joints.

import { discriminantOfDyad, placeAsSeries, slideOffset } from "./joint-series.js";
import { inputPosition } from "./positions.js";
import { groundOf } from "./linkage.js";
import { inputDirection } from "./pass.js";
import {
  constantSeries,
  differenceOfSeries,
  movedPlace,
  planarCross,
  planarDifference,
  planarDot,
  planarUnit,
  productOfSeries,
  quotientOfSeries,
  scaledSeries,
  sumOfSeries,
  sqrtAtTouch,
} from "./series.js";
import { sideOf } from "./assembly-mode.js";

// Of each dyad that touches its flat pose at an end of a pass one term is lost.
const TERMS_AT_AN_END = 8;
// A place and its first three rates.
const TERMS_TO_JERK = 4;

/**
 * Places and rates of all joints at an input of a pass: planar series of at least `terms` terms up to 4, { x,
 * y }, as seen from the linkage's own view. Rates are to a radian of input, or to a unit of length: the
 * velocity is the second term, half the acceleration the third, a sixth of the jerk the fourth. At a limit
 * they are infinite, at a change point their one-sided limits in the pass.
 */
export function derivativesOnPass(linkage, pass, at, terms = 3) {
  const ends = [
    [pass.end, -inputDirection(pass)],
    [pass.begin, inputDirection(pass)],
  ];
  for (const [end, inwards] of ends) {
    if (end.at === at && end.flat !== 0) {
      const jets = fixedFrameDerivatives(linkage, end, pass.signs, end.flat, inwards, TERMS_AT_AN_END);
      return toViewFrame(linkage, jets);
    }
  }
  return toViewFrame(
    linkage,
    fixedFrameDerivatives(linkage, inputPosition(linkage.input, at), pass.signs, 0, 0, terms),
  );
}

/** The same at an input { at, cos, sin } in an assembly mode, where no dyad lies flat. */
export function derivativesAtInput(linkage, stop, signs) {
  return toViewFrame(
    linkage,
    placeAsSeries(linkage, linkage.joints.length, stop, (k) => sideOf(signs, k), 3),
  );
}

/**
 * Places and rates in the frame of the fixed joints, by series of so many terms. `inwards` is 1 where the
 * motion is at greater inputs than this, -1 where it is at smaller ones, and 0 where that is not known.
 */
export function fixedFrameDerivatives(linkage, stop, signs, flat, inwards, terms) {
  const mode = (dyad) => ((flat >> dyad) & 1 ? 0 : sideOf(signs, dyad));
  const settle = (joint, place, at) => {
    const { step } = linkage.joints[joint];
    if (step.index === undefined || step.kind === "directed" || !((flat >> step.index) & 1)) return place;
    const rise = dyadHeight(step, at, terms);
    if (!rise) return place;
    const way = sideOf(signs, step.index) * inwards;
    const height = way === 0 ? null : sqrtAtTouch(rise.square, rise.size);
    if (!height) return withUnboundedRates(place, rise.direction);
    return movedPlace(place, rise.direction, scaledSeries(height, way), constantSeries(0, terms));
  };
  const all = placeAsSeries(linkage, linkage.joints.length, stop, mode, terms, settle);
  return all.map(({ x, y }) => ({ x: x.slice(0, TERMS_TO_JERK), y: y.slice(0, TERMS_TO_JERK) }));
}

// The offset of a dyad's joint from its flat position: its direction, along a slider's line or square to a
// base of any length; the square of its length, in lengths of that direction; and the size of the terms that
// the square is computed from.
function dyadHeight(step, at, terms) {
  const squareTo = ([p, q]) => {
    const base = planarDifference(at[q], at[p]);
    return { base, direction: { x: scaledSeries(base.y, -1), y: base.x } };
  };
  const number = (value) => constantSeries(value, terms);
  switch (step.kind) {
    case "slot": {
      if (step.offset === 0) return null;
      const { base, direction } = squareTo(step.base);
      const d2 = planarDot(base, base);
      const e2 = step.offset * step.offset;
      const square = quotientOfSeries(differenceOfSeries(d2, number(e2)), productOfSeries(d2, d2));
      const sense = Math.sign(step.offset);
      const turned = { x: scaledSeries(direction.x, sense), y: scaledSeries(direction.y, sense) };
      return { direction: turned, square: scaledSeries(square, e2), size: 1 };
    }
    case "slide": {
      const { unit, h } = slideOffset(step, at, terms);
      const length = number(step.length);
      const square = productOfSeries(differenceOfSeries(length, h), sumOfSeries(length, h));
      return { direction: unit, square, size: step.length * step.length };
    }
    case "dyad": {
      const { base, direction } = squareTo(step.base);
      const [l0, l1] = step.lengths;
      const d2 = planarDot(base, base);
      const discriminant = discriminantOfDyad(d2, number(l0 + l1), number(l0 - l1));
      return {
        direction,
        square: quotientOfSeries(scaledSeries(discriminant, 0.25), productOfSeries(d2, d2)),
        size: 1,
      };
    }
    default:
      return { direction: squareTo(step.base).direction, square: new Array(terms).fill(NaN), size: 1 };
  }
}

// The same place with rates that have no bound, but across the direction they have none in: there the
// velocity has one, and all rates where the direction stays.
function withUnboundedRates(at, direction) {
  const rates = (place, along, across) => {
    let bounded = place.length;
    if (along[0] !== 0 || across[0] === 0) bounded = 1;
    else if (along.some((c) => c !== 0)) bounded = 2;
    return place.map((c, n) => (n < bounded ? c : Infinity));
  };
  return { x: rates(at.x, direction.x, direction.y), y: rates(at.y, direction.y, direction.x) };
}

// Places and rates in the plane they are reported in.
function toViewFrame(linkage, at) {
  let out = at;
  if (linkage.seenFrom) {
    const [from, to] = linkage.seenFrom.map((joint) => at[joint]);
    const unit = planarUnit(planarDifference(to, from));
    const seen = (place) => {
      const v = planarDifference(place, from);
      return { x: planarDot(unit, v), y: planarCross(unit, v) };
    };
    out = at.map(seen);
    // What is on the link seen from is at rest, but for rounding.
    for (const { joint } of groundOf(linkage)) {
      const still = (series) => constantSeries(series[0], series.length);
      out[joint] = { x: still(out[joint].x), y: still(out[joint].y) };
    }
  }
  const { mirror, cos, sin } = linkage.placement;
  if (!mirror && cos === 1) return out;
  const hand = mirror ? -1 : 1;
  const turned = (a, p, b, q) => a.map((c, n) => p * c + q * hand * b[n]);
  return out.map(({ x, y }) => ({ x: turned(x, cos, y, -sin), y: turned(x, sin, y, cos) }));
}
