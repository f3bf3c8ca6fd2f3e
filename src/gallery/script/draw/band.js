// The stretch of a curve between two inputs, as the band that marks its straight portion.

import { singlePointLinkage } from "../kinematics/linkage.js";
import { posesAt } from "../kinematics/poses.js";

/**
 * The stretch of a joint's path over a circuit { passes, closed } from the input `start` over `span` of
 * input, on over limits, and of a closed circuit over its beginning: { points: [x, y, …], from: { pass, input
 * }, to: { pass, input } }. Where more than one pass has that input, the stretch is taken whose ends are
 * `length` apart. Null where no pass has it.
 */
export function stretchOfCircuit(linkage, circuit, joint, { start, span, length }) {
  const alone = singlePointLinkage(linkage, joint);
  const { period } = linkage.input;
  let best = null;
  let off = Infinity;
  circuit.passes.forEach((pass, k) => {
    for (const at of linkage.input.isLength ? [start] : [start, start - period, start + period]) {
      const slack = 1e-9 * Math.abs(pass.to - pass.from);
      if (at < Math.min(pass.from, pass.to) - slack || at > Math.max(pass.from, pass.to) + slack) continue;
      const stretch = walkedStretch(alone, circuit, k, at, span);
      const { points } = stretch;
      const n = points.length;
      const error = Math.abs(Math.hypot(points[n - 2] - points[0], points[n - 1] - points[1]) - length);
      // The same place may be found at the seam of two passes.
      if (error < off - 1e-6 * length) [best, off] = [stretch, error];
    }
  });
  return best;
}

function walkedStretch({ linkage, joint }, { passes, closed }, first, start, span) {
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
