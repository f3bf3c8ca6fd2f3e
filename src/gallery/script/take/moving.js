// A plate that moves by itself.

import { newSampler, sampleCircuit } from "../kinematics/sampling.js";
import { passLength } from "../kinematics/pass.js";
import { svgOfPoses } from "./svg.js";

/**
 * A taken curve as SVG with its linkage moving over the circuit, again and again, without any script: slower
 * towards its limits, as a crank is that is turned by hand; there and back where the circuit does not close.
 */
export function movingSvgOfCurve(taken) {
  // Between two poses places go straight: over 3 degrees no pin is off its circle by more than a thousandth
  // of its radius.
  const [STEP_DEG, SECONDS_TO_A_TURN] = [3, 4];
  const { linkage, course } = taken;
  const turned = course.passes.reduce((sum, pass) => sum + passLength(pass) / 360, 0);
  const turns = linkage.input.isLength ? 1 : Math.max(turned, 0.25);
  const samples = Math.ceil((turns * 360) / STEP_DEG);
  const frames = sampleCircuit(linkage, newSampler({ samples, spacing: "smooth" }), course);
  const pose = (k) => linkage.joints.map((_, joint) => ({ x: frames.x[joint][k], y: frames.y[joint][k] }));
  const isDefined = (places) => places.every(({ x, y }) => Number.isFinite(x) && Number.isFinite(y));
  const poses = Array.from({ length: frames.count }, (_, k) => pose(k)).filter(isDefined);
  const back = course.closed ? [poses[0]] : poses.slice(0, -1).reverse();
  return svgOfPoses(taken, [...poses, ...back], Math.round(turns * SECONDS_TO_A_TURN * 10) / 10);
}
