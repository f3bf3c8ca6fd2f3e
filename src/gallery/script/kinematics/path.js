// Computes the path of a joint to a chord tolerance.

import { singlePointLinkage } from "./linkage.js";
import { passLength } from "./pass.js";
import { posesAt } from "./poses.js";
import { easedInput } from "./spacing.js";

/**
 * The path of a joint over a circuit as { points: Float64Array [x, y, …], inputs: Float64Array, starts:
 * [index] }: from its beginning to its end, each limit once; `starts` has the place of each pass's first
 * point, the last of the pass before. No chord is further than `tolerance` (in the plane's unit) from the
 * curve, measured at its middle.
 */
export function finePath(linkage, circuit, joint, tolerance) {
  const alone = singlePointLinkage(linkage, joint);
  const [points, inputs, starts] = [[], [], []];
  for (const pass of circuit.passes) {
    const nodes = refinedNodes(alone.linkage, pass, alone.joint, tolerance);
    const seam = inputs.length > 0 ? 1 : 0;
    starts.push(inputs.length - seam);
    for (let k = seam; k < nodes.length; k++) {
      inputs.push(nodes[k].at);
      points.push(nodes[k].x, nodes[k].y);
    }
  }
  return { points: Float64Array.from(points), inputs: Float64Array.from(inputs), starts };
}

// Places { part, at, x, y } along a pass, as many as it takes; each round halves the open chords.
function refinedNodes(linkage, pass, joint, tolerance) {
  // No chord spans more of a crank's turn than 3 degrees, nor more of a pass than a part in 64: a longer one
  // may cross its curve at its middle.
  const [LONGEST, FEWEST, ROUNDS, MOST] = [3, 64, 24, 20000];
  const turned = linkage.input.isLength ? 0 : passLength(pass) / LONGEST;
  const chords = Math.max(FEWEST, Math.ceil(turned));
  let nodes = placedNodes(
    linkage,
    pass,
    joint,
    Array.from({ length: chords + 1 }, (_, k) => k / chords),
  );
  nodes.forEach((node) => (node.isOpen = true));
  for (let round = 0; round < ROUNDS && nodes.length < MOST; round++) {
    const open = [];
    for (let k = 1; k < nodes.length; k++)
      if (nodes[k - 1].isOpen) open.push((nodes[k - 1].part + nodes[k].part) / 2);
    if (open.length === 0) break;
    nodes = withMiddles(nodes, placedNodes(linkage, pass, joint, open), tolerance);
  }
  return nodes;
}

function placedNodes(linkage, pass, joint, parts) {
  const at = (part) => (part === 0 ? pass.from : part === 1 ? pass.to : easedInput(pass, part));
  const inputs = parts.map(at);
  const { x, y } = posesAt(linkage, pass, inputs);
  return parts.map((part, k) => ({ part, at: inputs[k], x: x[joint][k], y: y[joint][k], isOpen: false }));
}

// The nodes with those of the middles of their open chords that are off their chord.
function withMiddles(nodes, middles, tolerance) {
  const out = [nodes[0]];
  let next = 0;
  for (let k = 1; k < nodes.length; k++) {
    const from = nodes[k - 1];
    if (from.isOpen) {
      const middle = middles[next++];
      from.isOpen = distanceToChord(middle, from, nodes[k]) > tolerance;
      middle.isOpen = from.isOpen;
      if (from.isOpen) out.push(middle);
    }
    out.push(nodes[k]);
  }
  return out;
}

/** Distance of a point from the segment between two, all { x, y }. */
export function distanceToChord(p, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const length2 = dx * dx + dy * dy;
  const along = length2 === 0 ? 0 : ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2;
  const t = Math.min(Math.max(along, 0), 1);
  const [ex, ey] = [p.x - a.x - t * dx, p.y - a.y - t * dy];
  return Math.sqrt(ex * ex + ey * ey);
}
