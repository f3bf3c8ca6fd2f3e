// Approximates the path of an exported curve by a polyline with few points, as the program does.

import { singlePointLinkage } from "../kinematics/linkage.js";
import { passLength } from "../kinematics/pass.js";
import { posesAt } from "../kinematics/poses.js";
import { distanceToChord } from "../kinematics/path.js";

/**
 * The path over a circuit, [{ x, y }, …] from start to end. No chord is further than `tolerance` from the
 * curve: half of it is for the refinement, tested at the middle of each chord's input, and half for the
 * simplification.
 */
export function polylineOfCurve({ linkage, circuitSamples, joint }, tolerance) {
  const alone = singlePointLinkage(linkage, joint);
  const out = [];
  for (const pass of circuitSamples.passes) {
    const points = refinePass(alone.linkage, pass, alone.joint, tolerance / 2);
    out.push(...simplifyPath(points, tolerance / 2).slice(out.length > 0 ? 1 : 0));
  }
  return out.filter(({ x, y }) => Number.isFinite(x) && Number.isFinite(y));
}

// Refines the points of a pass; each round bisects the inputs of chords that are too far from the curve.
function refinePass(linkage, pass, joint, tolerance) {
  // A chord spans at most 3 degrees of crank rotation and 1/64 of the pass: a longer one may cross its curve
  // at the middle.
  const [LONGEST, FEWEST, ROUNDS, MOST] = [3, 64, 30, 100000];
  const length = passLength(pass);
  const longest = linkage.input.isLength ? length / FEWEST : Math.min(LONGEST, length / FEWEST);
  const chords = Math.min(Math.max(Math.ceil(length / longest), 1), MOST);
  const { from, to } = pass;
  const inputs = Array.from({ length: chords }, (_, k) => from + (to - from) * (k / chords));
  let nodes = nodesOnPass(linkage, pass, joint, [...inputs, to]);
  for (let round = 0; round < ROUNDS; round++) {
    const open = [];
    for (let k = 1; k < nodes.length; k++)
      if (nodes[k - 1].open) open.push((nodes[k - 1].at + nodes[k].at) / 2);
    if (open.length === 0 || nodes.length > MOST) break;
    nodes = splitLongChords(nodes, nodesOnPass(linkage, pass, joint, open), tolerance);
  }
  return nodes;
}

function nodesOnPass(linkage, pass, joint, inputs) {
  const { x, y } = posesAt(linkage, pass, inputs);
  return inputs.map((at, k) => ({ at, x: x[joint][k], y: y[joint][k], open: true }));
}

function splitLongChords(nodes, middles, tolerance) {
  const out = [nodes[0]];
  let next = 0;
  for (let k = 1; k < nodes.length; k++) {
    const before = nodes[k - 1];
    if (before.open) {
      const middle = middles[next++];
      before.open = distanceToChord(middle, before, nodes[k]) > tolerance;
      if (before.open) out.push(middle);
    }
    out.push(nodes[k]);
  }
  return out;
}

/**
 * Simplifies a polyline [{ x, y }, …] with a sweep from its start; keeps the first and last points. No
 * removed point is further than `tolerance` from the result (Zhao and Saalfeld, Auto-Carto 13, 1997).
 */
function simplifyPath(points, tolerance) {
  if (points.length < 2) return [...points];
  const out = [points[0]];
  let sleeve = { anchor: points[0], sides: null, reach: 0 };
  let last = points[0];
  for (const point of points.slice(1)) {
    if (!narrowSleeve(sleeve, point, tolerance)) {
      out.push(last);
      sleeve = { anchor: last, sides: null, reach: 0 };
      narrowSleeve(sleeve, point, tolerance);
    }
    last = point;
  }
  out.push(last);
  return out;
}

// Narrows the directions in which a line passes all points so far, if the line may end at this point.
function narrowSleeve(sleeve, point, tolerance) {
  const [x, y] = [point.x - sleeve.anchor.x, point.y - sleeve.anchor.y];
  const distance = Math.sqrt(x * x + y * y);
  const left = ([ax, ay], [bx, by]) => ax * by - ay * bx;
  const { sides } = sleeve;
  const isWithin = !sides || (left(sides[0], [x, y]) >= 0 && left([x, y], sides[1]) >= 0);
  if (!isWithin || distance < sleeve.reach) return false;
  if (distance > tolerance) {
    sleeve.reach = distance;
    // The tangents from the anchor to the circle with radius `tolerance` around the point.
    const part = Math.sqrt((distance - tolerance) * (distance + tolerance)) / (distance * distance);
    const aside = tolerance / (distance * distance);
    const right = [x * part + y * aside, y * part - x * aside];
    const far = [x * part - y * aside, y * part + x * aside];
    sleeve.sides = sides
      ? [left(sides[0], right) > 0 ? right : sides[0], left(far, sides[1]) > 0 ? far : sides[1]]
      : [right, far];
  }
  return true;
}
