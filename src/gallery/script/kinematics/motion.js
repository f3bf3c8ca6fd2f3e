// Solves the motion of a linkage: all its circuits.

import { findCircuits } from "./circuit.js";
import { OUT_OF_RANGE_REASON } from "./dyad-limits.js";
import { excessReason, sampleCircuit, newSampler } from "./sampling.js";

/**
 * The circuits of a linkage, sampled by `sampling` ({ step } or { samples, spacing }, see sampling.js): {
 * circuits, shortfall }. The shortfall says in a sentence why the linkage is not assembled at all, or not
 * over the whole requested range; null if it is.
 *
 * A circuit is { passes, closed, count, input, pass, x, y, signs(sample), branch(sample, dyad) }: its passes
 * (pass.js), the number of samples, the input of each (degrees, continuous and never wrapped, or lengths),
 * the pass each is on, and the places of each joint in columns x[joint][sample], y[joint][sample], as the
 * linkage is seen and placed. A branch is 1 left or -1 right, of the first two-valued joint or of another; at
 * the end of a pass, that of the pass it ends.
 */
export function motionOf(linkage, sampling) {
  const { routes, shortfall } = findCircuits(linkage);
  const sampler = newSampler(sampling);
  const excess = routes.map((route) => excessReason(sampler, route)).find((reason) => reason !== null);
  if (excess) return { circuits: [], shortfall: excess };
  const circuits = routes.map((route) => sampleCircuit(linkage, sampler, route));
  if (circuits.some((circuit) => linkage.traced.some((joint) => isNowhereDefined(circuit, joint)))) {
    return { circuits: [], shortfall: OUT_OF_RANGE_REASON };
  }
  return { circuits, shortfall };
}

// Whether a joint has no place at any sample.
function isNowhereDefined({ x, y, count }, joint) {
  for (let i = 0; i < count; i++)
    if (Number.isFinite(x[joint][i]) && Number.isFinite(y[joint][i])) return false;
  return true;
}
