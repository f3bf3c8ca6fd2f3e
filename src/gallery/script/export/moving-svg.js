// Writes an animated plate.

import { newSampler, sampleCircuit } from "../kinematics/sampling.js";
import { passLength } from "../kinematics/pass.js";
import { svgOfPoses } from "./svg.js";

/**
 * An exported curve as SVG with its linkage moving over the circuit in a loop, without a script: slower
 * towards limits, and back and forth if the circuit is not closed.
 */
export function movingSvgOfCurve(exported) {
  // Positions are interpolated linearly between poses: over 3 degrees no pin leaves its circle by more than a
  // thousandth of the radius.
  const [STEP_DEG, SECONDS_TO_A_TURN] = [3, 4];
  const { linkage, circuitSamples } = exported;
  const turned = circuitSamples.passes.reduce((sum, pass) => sum + passLength(pass) / 360, 0);
  const turns = linkage.input.isLength ? 1 : Math.max(turned, 0.25);
  const samples = Math.ceil((turns * 360) / STEP_DEG);
  const frames = sampleCircuit(linkage, newSampler({ samples, spacing: "smooth" }), circuitSamples);
  const pose = (k) => linkage.joints.map((_, joint) => ({ x: frames.x[joint][k], y: frames.y[joint][k] }));
  const isDefined = (places) => places.every(({ x, y }) => Number.isFinite(x) && Number.isFinite(y));
  const poses = Array.from({ length: frames.count }, (_, k) => pose(k)).filter(isDefined);
  const back = circuitSamples.closed ? [poses[0]] : poses.slice(0, -1).reverse();
  return svgOfPoses(exported, [...poses, ...back], Math.round(turns * SECONDS_TO_A_TURN * 10) / 10);
}
