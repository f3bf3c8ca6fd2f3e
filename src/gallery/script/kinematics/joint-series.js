// Computes each joint as a series in the input, from the joints before it, in the frame of the fixed joints:
// the constraints that dyads.js solves, with their rates. Angles of input are in radians, lengths in their
// unit.

import { cosSinOfDegrees } from "./angles.js";
import { gearedAngle } from "./positions.js";
import {
  constantPlace,
  constantSeries,
  differenceOfSeries,
  movedPlace,
  planarCross,
  planarDifference,
  planarDot,
  planarUnit,
  productOfSeries,
  quotientOfSeries,
  rootOfSeries,
  scaledSeries,
  sumOfSeries,
  rotatingUnit,
  variableSeries,
} from "./series.js";

/**
 * The first `count` joints as planar series of `terms` terms.
 *
 * `stop` is the input { at, cos, sin }; `mode(index)` is what a dyad's height is multiplied by, and where
 * that is 0 the height is left out with its rates. `settle(joint, place, before)` may put another place for a
 * joint's.
 */
export function placeAsSeries(linkage, count, stop, mode, terms, settle = null) {
  const at = [];
  for (let id = 0; id < count; id++) {
    const place = jointSeries(linkage.joints[id].step, at, stop, mode, terms);
    at.push(settle ? settle(id, place, at) : place);
  }
  return at;
}

function jointSeries(step, at, stop, mode, terms) {
  const number = (value) => constantSeries(value, terms);
  const none = number(0);
  switch (step.kind) {
    case "fixed":
      return constantPlace(step.x, step.y, terms);
    case "crank": {
      const direction = rotatingUnit(stop.cos, stop.sin, 1, terms);
      return movedPlace(at[step.pivot], direction, number(step.length), none);
    }
    case "gear": {
      const [cos, sin] = cosSinOfDegrees(gearedAngle(stop.at, step.ratio, step.phase));
      const direction = rotatingUnit(cos, sin, step.ratio[0] / step.ratio[1], terms);
      return movedPlace(at[step.pivot], direction, number(step.length), none);
    }
    case "piston": {
      const s = variableSeries(stop.at, terms);
      const b = rootOfSeries(sumOfSeries(productOfSeries(s, s), number(step.offset * step.offset)));
      return dyadSeries(at[step.base[0]], at[step.base[1]], b, number(step.length), mode(step.index), terms);
    }
    case "dyad": {
      const [l0, l1] = step.lengths.map(number);
      return dyadSeries(at[step.base[0]], at[step.base[1]], l0, l1, mode(step.index), terms);
    }
    case "slide":
      return slideSeries(step, at, mode(step.index), terms);
    case "slot":
      return slotSeries(step, at, mode(step.index), terms);
    case "rigid": {
      const base = planarDifference(at[step.base[1]], at[step.base[0]]);
      return movedPlace(at[step.base[0]], base, number(step.along), number(step.across));
    }
    case "parallelogram": {
      const [p, q, r] = step.corners.map((joint) => at[joint]);
      return movedPlace(p, planarDifference(r, q), number(1), none);
    }
    case "yoke": {
      const [p, q] = step.line.map((joint) => at[joint]);
      const unit = planarUnit(planarDifference(q, p));
      const pin = planarDifference(at[step.from], p);
      const beside = differenceOfSeries(planarCross(unit, pin), number(step.offset));
      const along = differenceOfSeries(planarDot(unit, pin), scaledSeries(beside, step.lean));
      return movedPlace(p, unit, along, number(step.offset));
    }
    default:
      return alignedSeries(step, at, stop, mode, terms);
  }
}

function dyadSeries(p, q, l0, l1, mode, terms) {
  const base = planarDifference(q, p);
  const d2 = planarDot(base, base);
  const [sum, difference] = [sumOfSeries(l0, l1), differenceOfSeries(l0, l1)];
  const foot = scaledSeries(quotientOfSeries(productOfSeries(sum, difference), d2), 0.5);
  const along = sumOfSeries(constantSeries(0.5, terms), foot);
  if (mode === 0) return movedPlace(p, base, along, constantSeries(0, terms));
  const across = quotientOfSeries(
    scaledSeries(rootOfSeries(discriminantOfDyad(d2, sum, difference)), 0.5 * mode),
    d2,
  );
  return movedPlace(p, base, along, across);
}

/**
 * Sixteen times the square of the area of a dyad's triangle, of the square of its base and its lengths' sum
 * and difference.
 */
export function discriminantOfDyad(d2, sum, difference) {
  const d = rootOfSeries(d2);
  const outer = productOfSeries(differenceOfSeries(sum, d), sumOfSeries(sum, d));
  const inner = productOfSeries(differenceOfSeries(d, difference), sumOfSeries(d, difference));
  return productOfSeries(outer, inner);
}

/** The offset of a slide's line to the left of the joint its link turns on, with the line's direction. */
export function slideOffset({ from, line, offset }, at, terms) {
  const [p, q] = line.map((joint) => at[joint]);
  const unit = planarUnit(planarDifference(q, p));
  const pin = planarCross(unit, planarDifference(at[from], p));
  return { unit, h: differenceOfSeries(constantSeries(offset, terms), pin) };
}

function slideSeries(step, at, mode, terms) {
  const { unit, h } = slideOffset(step, at, terms);
  const length = constantSeries(step.length, terms);
  const square = productOfSeries(differenceOfSeries(length, h), sumOfSeries(length, h));
  const along = mode === 0 ? constantSeries(0, terms) : scaledSeries(rootOfSeries(square), mode);
  return movedPlace(at[step.from], unit, along, h);
}

function slotSeries({ base: [p, q], offset }, at, mode, terms) {
  if (offset === 0) return at[p];
  const base = planarDifference(at[q], at[p]);
  const d2 = planarDot(base, base);
  const e2 = constantSeries(offset * offset, terms);
  const along = quotientOfSeries(e2, d2);
  if (mode === 0) return movedPlace(at[p], base, along, constantSeries(0, terms));
  const root = scaledSeries(rootOfSeries(differenceOfSeries(d2, e2)), offset * mode);
  return movedPlace(at[p], base, along, quotientOfSeries(root, d2));
}

function alignedSeries(step, at, stop, mode, terms) {
  const { offset, lineIs } = step;
  const [p, q] = step.line.map((joint) => at[joint]);
  const base = planarDifference(q, p);
  const d2 = planarDot(base, base);
  const sense = lineIs === "turned" ? -mode(step.index) : 1;
  let s;
  if (lineIs === "driven") s = variableSeries(stop.at, terms);
  else if (offset === 0) s = rootOfSeries(d2);
  else s = rootOfSeries(differenceOfSeries(d2, constantSeries(offset * offset, terms)));
  const [along, across] = [step.along * sense, step.across * sense];
  const e = constantSeries(offset, terms);
  const forward = sumOfSeries(scaledSeries(s, along), scaledSeries(e, across));
  const left = differenceOfSeries(scaledSeries(s, across), scaledSeries(e, along));
  return movedPlace(at[step.from], base, quotientOfSeries(forward, d2), quotientOfSeries(left, d2));
}
