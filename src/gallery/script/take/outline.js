// The path of a taken curve with as few points as its tolerance allows, as the program has it.

import { singlePointLinkage } from "../kinematics/linkage.js";
import { passLength } from "../kinematics/pass.js";
import { posesAt } from "../kinematics/poses.js";
import { distanceToChord } from "../kinematics/path.js";

/**
 * The path over a circuit, [{ x, y }, …] from its beginning to its end. No chord is further than `tolerance`
 * from the curve: half of that is for the refinement, as judged at the middle of a chord's input, half for
 * the points left out again.
 */
export function outlineOfCurve({ linkage, course, joint }, tolerance) {
  const alone = singlePointLinkage(linkage, joint);
  const out = [];
  for (const pass of course.passes) {
    const points = refinedPass(alone.linkage, pass, alone.joint, tolerance / 2);
    out.push(...thinnedPath(points, tolerance / 2).slice(out.length > 0 ? 1 : 0));
  }
  return out.filter(({ x, y }) => Number.isFinite(x) && Number.isFinite(y));
}

// Points of a pass, as many as it takes; each round halves the inputs of the chords that are off the curve.
function refinedPass(linkage, pass, joint, tolerance) {
  // No chord spans more of a crank's turn than 3 degrees, nor more of a pass than a part in 64: a longer one
  // may cross its curve at its middle.
  const [LONGEST, FEWEST, ROUNDS, MOST] = [3, 64, 30, 100000];
  const length = passLength(pass);
  const longest = linkage.input.isLength ? length / FEWEST : Math.min(LONGEST, length / FEWEST);
  const chords = Math.min(Math.max(Math.ceil(length / longest), 1), MOST);
  const { from, to } = pass;
  const inputs = Array.from({ length: chords }, (_, k) => from + (to - from) * (k / chords));
  let nodes = placedOnPass(linkage, pass, joint, [...inputs, to]);
  for (let round = 0; round < ROUNDS; round++) {
    const open = [];
    for (let k = 1; k < nodes.length; k++)
      if (nodes[k - 1].open) open.push((nodes[k - 1].at + nodes[k].at) / 2);
    if (open.length === 0 || nodes.length > MOST) break;
    nodes = refinedNodesOfPass(nodes, placedOnPass(linkage, pass, joint, open), tolerance);
  }
  return nodes;
}

function placedOnPass(linkage, pass, joint, inputs) {
  const { x, y } = posesAt(linkage, pass, inputs);
  return inputs.map((at, k) => ({ at, x: x[joint][k], y: y[joint][k], open: true }));
}

function refinedNodesOfPass(nodes, middles, tolerance) {
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
 * A polyline [{ x, y }, …] with as few of its points as a sweep from its beginning finds, first and last
 * among them: none of the others is further than `tolerance` from it (Zhao and Saalfeld, Auto-Carto 13,
 * 1997).
 */
function thinnedPath(points, tolerance) {
  if (points.length < 2) return [...points];
  const out = [points[0]];
  let sleeve = { anchor: points[0], sides: null, reach: 0 };
  let last = points[0];
  for (const point of points.slice(1)) {
    if (!sleeveTakes(sleeve, point, tolerance)) {
      out.push(last);
      sleeve = { anchor: last, sides: null, reach: 0 };
      sleeveTakes(sleeve, point, tolerance);
    }
    last = point;
  }
  out.push(last);
  return out;
}

// Narrows the directions in which a line passes all points so far by a point, if the line may end there.
function sleeveTakes(sleeve, point, tolerance) {
  const [x, y] = [point.x - sleeve.anchor.x, point.y - sleeve.anchor.y];
  const distance = Math.sqrt(x * x + y * y);
  const left = ([ax, ay], [bx, by]) => ax * by - ay * bx;
  const { sides } = sleeve;
  const isWithin = !sides || (left(sides[0], [x, y]) >= 0 && left([x, y], sides[1]) >= 0);
  if (!isWithin || distance < sleeve.reach) return false;
  if (distance > tolerance) {
    sleeve.reach = distance;
    // The tangents from the anchor to the circle of the tolerance about the point.
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
