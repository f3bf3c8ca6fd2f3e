// Decides whether a curve is symmetrical, and finds its axis.
//
// Two theorems of chapter 7 of Natesan's thesis give four-bars with symmetrical coupler curves. Theorem 1:
// crank and rocker are equal, and the coupler point is as far from the one pin as from the other; the axis is
// the perpendicular bisector of the frame. Theorem 2: coupler, rocker and the way from the rocker's pin to
// the coupler point are equal; the axis goes through the rocker's pivot (7.8). The same holds with crank and
// rocker exchanged. For any other curve the axis is fitted.

import { cognatesOf } from "../kinematics/cognates.js";
import { isOnCoupler } from "../kinematics/four-bar.js";
import { linkLength } from "../kinematics/linkage.js";
import { couplerEquation, equationAt } from "./equation.js";
import { hullDiameter, convexHull } from "./hull.js";
import { axisByMoments, refineAxis, axisThrough, mirroredPoint, roughResidual } from "./symmetry-axis.js";
import { maxSagitta } from "./sampled-curve.js";

/** The greatest residual of a symmetrical curve, by its extent. */
export const SYMMETRY_TOLERANCE = 1e-4;

/**
 * The symmetry of a curve: { axis, residual, theorem }, its best axis (symmetry-axis.js), null for a circle;
 * the greatest distance of its mirror image from it, by its greatest extent; and the theorem that applies, or
 * null. Null for a point.
 */
export function findSymmetry(tracedCurve) {
  // A theorem's curve that is no nearer to its image than this, by its extent, is the image of another
  // circuit's.
  const APART = 0.1;
  const { curve, fourBar } = tracedCurve;
  const extent = curve.count < 3 ? 0 : hullDiameter(convexHull(curve.x, curve.y, 0, curve.count));
  if (!(extent > 0)) return null;
  const known = axisByTheorem(tracedCurve);
  // Of a linkage with two circuits each may be the mirror image of the other: not so where it is roughly its
  // own.
  if (known && (fourBar.class === "triple-rocker" || roughResidual(curve, known.axis) <= APART * extent)) {
    const most = residualBySextic(tracedCurve, known.axis) ?? refineAxis(curve, known.axis, true).most;
    return { axis: known.axis, residual: most / extent, theorem: known.theorem };
  }
  const axis = axisByMoments(curve);
  if (!axis) return { axis: null, residual: 0, theorem: null };
  const rough = roughResidual(curve, axis);
  // Nearer than that, the curve between its samples is looked at.
  if (rough > 4 * maxSagitta(curve)) return { axis, residual: rough / extent, theorem: null };
  const fine = refineAxis(curve, axis, false);
  return { axis: fine.axis, residual: fine.most / extent, theorem: null };
}

// The greatest distance of the mirrored samples from the curve of a coupler point, by its own equation.
function residualBySextic({ linkage, joint, curve }, axis) {
  const itself = cognatesOf(linkage, joint)?.cognates[0];
  const equation = itself && couplerEquation(itself.lengths, itself.point);
  if (!equation) return null;
  const [origin, end] = itself.pivots;
  const size = Math.hypot(end[0] - origin[0], end[1] - origin[1]);
  const [fx, fy] = [(end[0] - origin[0]) / size, (end[1] - origin[1]) / size];
  let most = 0;
  for (let i = 0; i < curve.count; i++) {
    const [px, py] = mirroredPoint(axis, curve.x[i], curve.y[i]);
    const [bx, by] = [px - origin[0], py - origin[1]];
    // To the first order. At a double point both vanish, and what is left of the one is rounding.
    const at = equationAt(equation, fx * bx + fy * by, fx * by - fy * bx);
    const off = Math.abs(at.value) / at.gradient;
    if (Math.abs(at.value) > 1e-13 * at.size && Number.isFinite(off)) most = Math.max(most, off);
  }
  return most;
}

// The axis that a theorem gives the curves of a coupler point, and which theorem it is.
function axisByTheorem({ linkage, circuit, joint, fourBar }) {
  // Lengths that agree to within the rounding of the expressions they come from are meant to be equal.
  const EQUAL = 1e-12;
  if (!fourBar || !isOnCoupler(linkage, fourBar, joint)) return null;
  const { frame, crank, coupler, rocker, joints } = fourBar;
  const { o, a, b, c } = joints;
  const toPoint = (pin) => (pin === joint ? 0 : linkLength(linkage, pin, joint));
  const [fromCrank, fromRocker] = [toPoint(a), toPoint(b)];
  const isEqual = (p, q) => Math.abs(p - q) <= EQUAL * (frame + crank + coupler + rocker);
  const place = (id, k) => [circuit.x[id][k], circuit.y[id][k]];
  const [origin, end] = [place(o, 0), place(c, 0)];
  // The pivot the axis goes through, the other one, and the pin on the link of the other.
  const ways = [
    { pivot: end, other: origin, pin: a, arm: rocker, toPoint: fromRocker },
    { pivot: origin, other: end, pin: b, arm: crank, toPoint: fromCrank },
  ];
  const second = ways.find((way) => isEqual(coupler, way.arm) && isEqual(coupler, way.toPoint));
  if (isEqual(crank, rocker) && isEqual(fromCrank, fromRocker)) {
    const [dx, dy] = [end[0] - origin[0], end[1] - origin[1]];
    const axis = axisThrough([origin[0] + dx / 2, origin[1] + dy / 2], [-dy, dx]);
    return axis && { axis, theorem: second ? "theorems 1 and 2" : "theorem 1" };
  }
  if (!second) return null;
  const { pivot, other, pin } = second;
  // The angle from the pin to the point about the pivot is the same in every pose: taken where both are far
  // from it.
  const seen = (k) => [place(pin, k), place(joint, k)].map(([x, y]) => [x - pivot[0], y - pivot[1]]);
  let [best, reach] = [0, -Infinity];
  for (let k = 0; k < circuit.count; k++) {
    const least = Math.min(...seen(k).map(([x, y]) => Math.sqrt(x * x + y * y)));
    if (least >= reach) [best, reach] = [k, least];
  }
  const [from, to] = seen(best);
  const [cos, sin] = [from[0] * to[0] + from[1] * to[1], from[0] * to[1] - from[1] * to[0]];
  const [fx, fy] = [other[0] - pivot[0], other[1] - pivot[1]];
  const axis = axisThrough(pivot, [cos * fx - sin * fy, cos * fy + sin * fx]);
  return axis && { axis, theorem: "theorem 2" };
}
