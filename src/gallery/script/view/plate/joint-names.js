// Joint names, placed away from the links.

import { pixel } from "../../draw/path-data.js";
import { s, setAttributes } from "../dom.js";

const NAME_DISTANCE = 15;

/** The names of a linkage's joints, in `element`. */
export class JointNames {
  element = s("g.joint-names");
  /** @type {JointName[]} */ names = [];

  show(/** @type {Study} */ study) {
    this.names = namesOfStudy(study);
    this.element.replaceChildren(...this.names.map(({ element }) => element));
  }

  pose(/** @type {Points} */ at) {
    for (const name of this.names) {
      const [x, y] = [at[2 * name.joint], at[2 * name.joint + 1]];
      if (!Number.isFinite(x + y)) continue;
      name.angle = widestGap(anglesOfLinks(name, at), name.angle);
      const [cos, sin] = [Math.cos(name.angle), Math.sin(name.angle)];
      setAttributes(name.element, {
        x: pixel(x + (NAME_DISTANCE + name.over) * cos),
        y: pixel(y + NAME_DISTANCE * sin + 4),
      });
    }
  }
}

/** The names of the fixed joints, the pins and the traced point, with the joints next to them. @param {Study} study */
export function namesOfStudy(study) {
  const { bars, plates, frame, pins, fixed } = study.mechanism;
  const links = [...bars, ...plates, frame];
  return [...new Set([...fixed, ...pins, study.joint])].map((joint) => {
    const name = nameOfJoint(study, joint);
    const element = s("text", { class: joint === study.joint ? "name traced" : "name" }, name);
    const neighbours = new Set(links.filter((link) => link.includes(joint)).flat());
    neighbours.delete(joint);
    // Names are centred; a long one is shifted so that it does not cover the joint.
    const over = Math.max(0, 3.6 * name.length - 4);
    const isFixed = fixed.includes(joint);
    return { element, joint, near: [...neighbours], over, isFixed, angle: -Math.PI / 2 };
  });
}

// The points of a grid share one name, followed by the number of the curve.
function nameOfJoint(/** @type {Study} */ { joints, traced }, /** @type {number} */ joint) {
  const name = joints[joint];
  const isGrid = joints.filter((other) => other === name).length > 1;
  return isGrid ? `${name} ${traced.indexOf(joint) + 1}` : name;
}

// The directions, in radians on the screen, of the links at a joint; the ground is below a fixed one.
function anglesOfLinks(/** @type {JointName} */ { joint, near, isFixed }, /** @type {Points} */ at) {
  const angles = isFixed ? [Math.PI / 2] : [];
  for (const other of near) {
    const [dx, dy] = [at[2 * other] - at[2 * joint], at[2 * other + 1] - at[2 * joint + 1]];
    if (dx * dx + dy * dy > 1) angles.push(Math.atan2(dy, dx));
  }
  return angles.sort((a, b) => a - b);
}

// The middle of the widest gap between directions; the current gap is kept while it is nearly as wide.
function widestGap(/** @type {number[]} */ angles, /** @type {number} */ before) {
  if (angles.length === 0) return -Math.PI / 2;
  const TURN = 2 * Math.PI;
  const nearly = 0.75;
  let [middle, widest, own, ownWidth] = [0, -1, 0, -1];
  angles.forEach((from, k) => {
    const to = k + 1 < angles.length ? angles[k + 1] : angles[0] + TURN;
    const width = to - from;
    const into = before - from - TURN * Math.floor((before - from) / TURN);
    if (into <= width && width > ownWidth) [own, ownWidth] = [from + width / 2, width];
    if (width > widest) [middle, widest] = [from + width / 2, width];
  });
  return ownWidth >= nearly * widest ? own : middle;
}
