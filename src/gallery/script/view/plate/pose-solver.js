// Solves the pose of a linkage repeatedly into the same arrays, to keep garbage collection small at sixty
// frames per second.

import { newPositions, placeJoints, convertToViewFrame, inputPosition } from "../../kinematics/positions.js";
import { placeAtEnd } from "../../kinematics/pass-ends.js";
import { dyadSigns } from "../../kinematics/assembly-mode.js";

/** Poses of a linkage. `pose` is [x0, y0, x1, y1, …] of all joints in the plane, after each `solve`. */
export class PoseSolver {
  constructor(linkage) {
    this.linkage = linkage;
    this.count = linkage.joints.length;
    this.pose = new Float64Array(2 * this.count);
    this.columns = newPositions(this.count, 1);
    this.inputs = { at: new Float64Array(1), cos: new Float64Array(1), sin: new Float64Array(1) };
    this.modes = new Map();
  }

  /** The pose at an input of a pass; at the ends exactly as in the circuit. */
  solve(pass, input) {
    const { linkage, columns, inputs } = this;
    const stop = inputPosition(linkage.input, input);
    inputs.at[0] = stop.at;
    inputs.cos[0] = stop.cos;
    inputs.sin[0] = stop.sin;
    placeJoints(linkage, [0, this.count], inputs, this.#dyadSigns(pass), columns, 0, 1);
    if (input === pass.from && pass.begin.flat !== 0) placeAtEnd(linkage, pass, true, inputs, columns, 0);
    else if (input === pass.to && pass.end.flat !== 0) placeAtEnd(linkage, pass, false, inputs, columns, 0);
    convertToViewFrame(linkage, columns);
    for (let joint = 0; joint < this.count; joint++) {
      this.pose[2 * joint] = columns.x[joint][0];
      this.pose[2 * joint + 1] = columns.y[joint][0];
    }
    return this.pose;
  }

  #dyadSigns({ signs }) {
    if (!this.modes.has(signs)) this.modes.set(signs, dyadSigns(signs, 0, this.linkage.dyads));
    return this.modes.get(signs);
  }
}
