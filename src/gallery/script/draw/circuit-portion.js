// Computes the portion of a curve between two inputs, to mark its straight portion.

import { singlePointLinkage } from "../kinematics/linkage.js";
import { posesAt } from "../kinematics/poses.js";

/**
 * The portion of a joint's path over a circuit { passes, closed } that starts at the input `start` and covers
 * `span` of input, continuing over limits and over the start of a closed circuit: { points: [x, y, …], from:
 * { pass, input }, to: { pass, input } }. If several passes contain the start, the portion whose ends are
 * nearest to `length` apart is returned; null if no pass contains it.
 */
export function circuitPortion(linkage, circuit, joint, { start, span, length }) {
  const alone = singlePointLinkage(linkage, joint);
  const { period } = linkage.input;
  let best = null;
  let off = Infinity;
  circuit.passes.forEach((pass, k) => {
    for (const at of linkage.input.isLength ? [start] : [start, start - period, start + period]) {
      const slack = 1e-9 * Math.abs(pass.to - pass.from);
      if (at < Math.min(pass.from, pass.to) - slack || at > Math.max(pass.from, pass.to) + slack) continue;
      const portion = portionFrom(alone, circuit, k, at, span);
      const { points } = portion;
      const n = points.length;
      const error = Math.abs(Math.hypot(points[n - 2] - points[0], points[n - 1] - points[1]) - length);
      // The same portion may be found from both passes at a common end.
      if (error < off - 1e-6 * length) [best, off] = [portion, error];
    }
  });
  return best;
}

function portionFrom({ linkage, joint }, { passes, closed }, first, start, span) {
  const PARTS = 48;
  const points = [];
  let [k, at, left] = [first, start, span];
  for (let guard = 0; guard <= passes.length + 1; guard++) {
    const { from, to } = passes[k];
    const heading = to >= from ? 1 : -1;
    const far = Math.min(left, Math.abs(to - at));
    const isWhole = far < left;
    const inputs = Array.from({ length: PARTS + 1 }, (_, i) =>
      i === PARTS && isWhole ? to : at + (heading * far * i) / PARTS,
    );
    const { x, y } = posesAt(linkage, passes[k], inputs);
    for (let i = 0; i <= PARTS; i++) points.push(x[joint][i], y[joint][i]);
    left -= far;
    at = inputs[PARTS];
    if (!(left > 1e-12 * span) || (k === passes.length - 1 && !closed)) break;
    k = (k + 1) % passes.length;
    at = passes[k].from;
  }
  return { points, from: { pass: first, input: start }, to: { pass: k, input: at } };
}
