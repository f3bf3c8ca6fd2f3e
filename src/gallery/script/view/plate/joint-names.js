// The names of joints beside them, on the side away from their links.

import { pixel } from "../../draw/path-data.js";
import { s } from "../dom.js";

const NAME_DISTANCE = 15;

/** The names of a linkage's joints; `element` holds them. */
export class JointNames {
  constructor() {
    this.element = s("g", { class: "joint-names" });
    this.names = [];
  }

  show({ linkage, mechanism, joint: traced }) {
    const { bars, plates, frame, pins, fixed } = mechanism;
    const links = [...bars, ...plates, frame];
    const named = [...new Set([...fixed, ...pins, traced])];
    this.names = named.map((joint) => {
      const element = s("text", { class: joint === traced ? "name traced" : "name" }, linkage.joints[joint].name);
      const near = [...new Set(links.filter((link) => link.includes(joint)).flat())].filter((other) => other !== joint);
      // A point of a grid hangs on the joints it is placed from.
      return { element, joint, near: near.length ? near : (linkage.joints[joint].step.base ?? []) };
    });
    this.element.replaceChildren(...this.names.map(({ element }) => element));
  }

  pose(at) {
    for (const { element, joint, near } of this.names) {
      const [x, y] = [at[2 * joint], at[2 * joint + 1]];
      let [ux, uy] = [0, 0];
      for (const other of near) {
        const [dx, dy] = [x - at[2 * other], y - at[2 * other + 1]];
        const size = Math.hypot(dx, dy);
        if (size > 0) [ux, uy] = [ux + dx / size, uy + dy / size];
      }
      const size = Math.hypot(ux, uy);
      // Links that pull both ways leave a name where it is legible: above.
      const [nx, ny] = size > 0.05 ? [ux / size, uy / size] : [0, -1];
      if (!Number.isFinite(x + y)) continue;
      element.setAttribute("x", pixel(x + NAME_DISTANCE * nx));
      element.setAttribute("y", pixel(y + NAME_DISTANCE * ny + 4));
    }
  }
}
