// The velocity of a study's traced point.

import { singlePointLinkage } from "../../kinematics/linkage.js";
import { ratesAt } from "../../kinematics/poses.js";

/** Computes the velocity of one point, independent of other points. */
export class PointVelocity {
  constructor({ linkage, joint }) {
    this.alone = singlePointLinkage(linkage, joint);
  }

  /** [vx, vy] at an input of a pass, per radian of input or unit of length; infinite at limits. */
  at(pass, input) {
    const { linkage, joint } = this.alone;
    const { velocity } = ratesAt(linkage, pass, input);
    return [velocity[2 * joint], velocity[2 * joint + 1]];
  }
}

/**
 * The arrow of a velocity in pixels, y down: a fifth of the frame at the speed `top`, at most one and a half
 * times that, reversed where the input decreases. Null if infinite.
 */
export function velocityArrow([vx, vy], { top, size, heading }) {
  const speed = Math.hypot(vx, vy);
  if (!Number.isFinite(speed)) return null;
  const longest = Math.min(size.width, size.height) / 5;
  const by = (heading * longest * Math.min(1, (1.5 * top) / speed)) / top;
  return [by * vx, -by * vy];
}
