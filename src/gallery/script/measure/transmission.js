// Computes the transmission angles, the output's swing and the time ratio of a four-bar over a circuit.

import { cosSinOfDegrees, degreesOf, remainderOf } from "../kinematics/angles.js";
import { isCouplerDriven } from "../kinematics/four-bar.js";
import { handednessOf, lengthTolerance } from "../kinematics/linkage.js";
import { passRange } from "../kinematics/pass.js";
import { extremesOver } from "./extreme.js";

/** The least and the greatest transmission angle over a circuit, in degrees, [least, greatest]. */
export function transmissionRange(linkage, circuit, fourBar) {
  const { frame, crank, coupler, rocker, joints } = fourBar;
  const { o, a, b, c } = joints;
  if (!linkage.seenFrom) {
    // By the distance of the crank's pin from the rocker's pivot, which is extreme where the crank is on the
    // frame line.
    const range = pinDistances(linkage, circuit, [o, a, c], [frame, crank]);
    return range.map((side) => oppositeAngle(side, coupler, rocker));
  }
  const angle = (from, to, x, y) => {
    const spacing = (at) => {
      const [p, q] = [at(from), at(to)];
      return Math.sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]));
    };
    return extremesOver(linkage, circuit, spacing).map((side) => oppositeAngle(side, x, y));
  };
  const atRocker = angle(a, c, coupler, rocker);
  if (!isCouplerDriven(linkage, fourBar)) return atRocker;
  const atCrank = angle(o, b, crank, coupler);
  return [Math.min(atRocker[0], atCrank[0]), Math.max(atRocker[1], atCrank[1])];
}

// The angle opposite a side of a triangle, in degrees; exactly 0 or 180 where it is flat.
function oppositeAngle(side, x, y) {
  // Half the angle has sine and cosine by the factors of Heron's formula. At a limit they are zero but for
  // the rounding of the places the side is taken from.
  const rounding = 4 * lengthTolerance(side + x + y);
  const clear = (gap) => (Math.abs(gap) <= rounding ? 0 : gap);
  const sine = clear(side - Math.abs(x - y)) * (side + Math.abs(x - y));
  const cosine = clear(x + y - side) * (x + y + side);
  return 2 * degreesOf(Math.atan2(Math.sqrt(Math.max(sine, 0)), Math.sqrt(Math.max(cosine, 0))));
}

// The least and the greatest distance of a crank's pin from another fixed pivot over a circuit.
function pinDistances(linkage, circuit, [o, a, c], [frame, crank]) {
  const { x, y } = circuit;
  // The direction of the frame line, by the input at which the crank points along it.
  const [lx, ly, ax, ay] = [x[c][0] - x[o][0], y[c][0] - y[o][0], x[a][0] - x[o][0], y[a][0] - y[o][0]];
  const turned = (ax * ly - ay * lx) * handednessOf(linkage);
  const towards = circuit.input[0] + degreesOf(Math.atan2(turned, ax * lx + ay * ly));
  const isReached = (deg) =>
    circuit.passes.some((pass) => {
      const [low, high] = passRange(pass);
      return remainderOf(deg - low + 1e-9, 360) <= high - low + 2e-9;
    });
  let [least, greatest] = [Infinity, -Infinity];
  for (let i = 0; i < circuit.count; i++) {
    const [dx, dy] = [x[a][i] - x[c][i], y[a][i] - y[c][i]];
    const d = Math.sqrt(dx * dx + dy * dy);
    if (d < least) least = d;
    if (d > greatest) greatest = d;
  }
  return [
    isReached(towards) ? Math.abs(frame - crank) : least,
    isReached(towards + 180) ? frame + crank : greatest,
  ];
}

/** The angle the output link swings through over a circuit, in degrees; 360 where it turns round. */
export function outputSwing(linkage, circuit, { joints: { b, c } }) {
  const { x, y, count, closed } = circuit;
  const arm = (i) => [x[b][i] - x[c][i], y[b][i] - y[c][i]];
  const angle = (from, to) =>
    degreesOf(Math.atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]));
  // How far it has turned at each sample, from the first; and over the whole, back to where it began.
  let [turned, low, high] = [0, 0, 0];
  for (let i = 1; i < count; i++) {
    turned += angle(arm(i - 1), arm(i));
    low = Math.min(low, turned);
    high = Math.max(high, turned);
  }
  if (closed && Math.abs(turned + angle(arm(count - 1), arm(0))) > 180) return 360;
  // Rocking, it never goes so far from the middle of its swing that its direction from there is in doubt.
  const [cos, sin] = cosSinOfDegrees((low + high) / 2);
  const [fx, fy] = arm(0);
  const middle = [cos * fx - sin * fy, cos * fy + sin * fx];
  const [least, greatest] = extremesOver(linkage, circuit, (at) => {
    const [p, q] = [at(b), at(c)];
    return angle(middle, [p[0] - q[0], p[1] - q[1]]);
  });
  return greatest - least;
}

/**
 * The ratio of the crank angle of the rocker's slower stroke to that of its faster one; null unless it is a
 * crank-rocker with a turning crank.
 */
export function timeRatio(linkage, circuit, { frame, crank, coupler, rocker, type }) {
  const turns = circuit.closed && circuit.passes.length === 1;
  if (linkage.seenFrom || type !== "crank-rocker" || !turns) return null;
  // The rocker turns where crank and coupler are in line; by the triangles of pivots and rocker pin there.
  const angle = (reach) => {
    const cosine = (frame * frame + reach * reach - rocker * rocker) / (2 * frame * reach);
    return Math.acos(Math.min(Math.max(cosine, -1), 1));
  };
  // Stretched the crank points at the pin, folded away from it.
  const between = 180 + degreesOf(angle(Math.abs(coupler - crank)) - angle(coupler + crank));
  const slower = Math.max(between, 360 - between);
  return slower / (360 - slower);
}
