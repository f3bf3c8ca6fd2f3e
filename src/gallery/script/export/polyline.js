// Approximates the path of an exported curve by a polyline with few points, as the program does.

import { singlePointLinkage } from "../kinematics/linkage.js";
import { passLength } from "../kinematics/pass.js";
import { posesAt } from "../kinematics/poses.js";
import { distanceToChord } from "../kinematics/path.js";

/**
 * The path over a circuit, [{ x, y }, …] from start to end. No chord is further than `tolerance` from the
 * curve: half of it is for the refinement, tested at the first quarter and the middle of each chord's input,
 * and half for the simplification.
 */
export function polylineOfCurve({ linkage, circuitSamples, joint }, tolerance) {
  const alone = singlePointLinkage(linkage, joint);
  const out = [];
  for (const pass of circuitSamples.passes) {
    const nodes = refinePass(alone.linkage, pass, alone.joint, tolerance / 2);
    const points = nodes.filter(({ x, y }) => Number.isFinite(x) && Number.isFinite(y));
    const continues = out.length > 0 && points.length > 0 && separation(out.at(-1), points[0]) <= tolerance;
    out.push(...simplifyPath(points, tolerance / 2).slice(continues ? 1 : 0));
  }
  return out;
}

function separation(a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  return Math.sqrt(dx * dx + dy * dy);
}

/** The turns of a linkage's fastest crank for a turn of the driven one, at least 1. */
function fastestCrankRatio(linkage) {
  const ratio = ({ step }) => (step.kind === "gear" ? Math.abs(step.ratio[0] / step.ratio[1]) : 1);
  return Math.max(1, ...linkage.joints.map(ratio));
}

// Refines the points of a pass; each round bisects the inputs of chords that are too far from the curve.
function refinePass(linkage, pass, joint, tolerance) {
  // A chord spans at most 3 degrees of the fastest crank's rotation and 1/64 of the pass: a longer one may cross
  // its curve at the middle.
  const [LONGEST, FEWEST, ROUNDS, MOST] = [3, 64, 60, 100000];
  const length = passLength(pass);
  const most = LONGEST / fastestCrankRatio(linkage);
  const longest = linkage.input.isLength ? length / FEWEST : Math.min(most, length / FEWEST);
  const chords = Math.min(Math.max(Math.ceil(length / longest), 1), MOST);
  const { from, to } = pass;
  const inputs = Array.from({ length: chords }, (_, k) => from + (to - from) * (k / chords));
  let nodes = nodesOnPass(linkage, pass, joint, [...inputs, to]);
  for (let round = 0; round < ROUNDS; round++) {
    const [middles, quarters] = [[], []];
    for (let k = 1; k < nodes.length; k++) {
      if (!nodes[k - 1].open) continue;
      const [a, b] = [nodes[k - 1].at, nodes[k].at];
      middles.push((a + b) / 2);
      quarters.push(a + (b - a) / 4);
    }
    if (middles.length === 0 || nodes.length > MOST) break;
    const at = (inputs) => nodesOnPass(linkage, pass, joint, inputs);
    nodes = splitLongChords(nodes, at(middles), at(quarters), tolerance);
  }
  return nodes;
}

function nodesOnPass(linkage, pass, joint, inputs) {
  const { x, y } = posesAt(linkage, pass, inputs);
  return inputs.map((at, k) => ({ at, x: x[joint][k], y: y[joint][k], open: true }));
}

function splitLongChords(nodes, middles, quarters, tolerance) {
  const out = [nodes[0]];
  let next = 0;
  for (let k = 1; k < nodes.length; k++) {
    const [before, after] = [nodes[k - 1], nodes[k]];
    if (before.open) {
      const [middle, quarter] = [middles[next], quarters[next]];
      next += 1;
      before.open =
        distanceToChord(middle, before, after) > tolerance ||
        distanceToChord(quarter, before, after) > tolerance ||
        isUneven(before, middle, after, tolerance);
      middle.open = before.open;
      if (before.open) out.push(middle);
    }
    out.push(after);
  }
  return out;
}

// Whether the middle of a chord's input is so near one of its ends that the chord cannot be judged by it.
function isUneven(from, middle, to, tolerance) {
  const [before, after] = [separation(from, middle), separation(middle, to)];
  return Math.max(before, after) > Math.max(tolerance, 4 * Math.min(before, after));
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
