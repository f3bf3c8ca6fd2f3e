// Finds the parts of a linkage to draw: bars and plates, pivots and pins, sliders with their guides, slots,
// actuators and gears.

import { groundOf, placeOnLink } from "../kinematics/linkage.js";
import { emptyBox, widenedBox } from "./plane-view.js";

/**
 * The parts of a linkage over a sampled circuit (kinematics/motion.js), joints by their indices: { bars:
 * [[joints]], plates: [[joints]], frame: [joints], fixed: [joints], pins: [joints], blocks: [{ at, line: [p,
 * q] }], slots: [{ foot, through, base: [from, to], near: [x, y], far: [x, y] }], actuators: [[pivot,
 * joint]], guides: [[x0, y0, x1, y1]], wheels: [{ joint, radius }] }. Plates are links with three joints or
 * more that are not in line, in the order of their outline. The ends of a slot are relative to its foot, in
 * the frame whose x-axis goes from `base[0]` to `base[1]`. Of the points of a grid only the one `traced` is
 * on its plate.
 */
export function mechanismOf(linkage, circuit, traced) {
  const { joints } = linkage;
  const outlines = movingOutlines(linkage, traced);
  const plates = outlines.filter(({ isPlate }) => isPlate).map(({ joints: outline }) => outline);
  const bars = outlines.filter(({ isPlate }) => !isPlate).map(({ joints: outline }) => outline);
  const frame = groundPivots(linkage);
  const blocks = [];
  const actuators = [];
  joints.forEach(({ step }, id) => {
    if (step.kind === "slide" || step.kind === "yoke") blocks.push({ at: id, line: step.line });
    if (step.kind === "piston") actuators.push([step.base[0], id]);
  });
  const slots = joints.map((_, id) => slotOf(linkage, circuit, id)).filter(Boolean);
  for (const { foot, through } of slots) blocks.push({ at: through, line: [foot, through] });
  const guides = joints.map((_, id) => guideOf(linkage, circuit, id)).filter(Boolean);
  const isShown = (id) => !(joints[id].step.kind === "slot" && joints[id].step.offset === 0);
  const pins = [...new Set(outlines.flatMap(({ joints: outline }) => outline))].filter(
    (id) => !frame.includes(id) && isShown(id),
  );
  return {
    bars,
    plates,
    frame,
    fixed: frame.filter(isShown),
    pins,
    blocks,
    slots,
    actuators,
    guides,
    wheels: wheelsOf(linkage, circuit),
  };
}

/** The joints of the ground link that other links are connected to. */
function groundPivots(linkage) {
  const ground = groundOf(linkage);
  const isPivot = (joint) => linkage.links.some((link) => link !== ground && placeOnLink(link, joint));
  return ground.map(({ joint }) => joint).filter(isPivot);
}

/** The bounding box of a mechanism over a circuit, and of the paths of further joints. */
export function sweptBox(mechanism, circuit, further = []) {
  const box = emptyBox();
  const { pins, frame, slots, guides, wheels } = mechanism;
  const joints = new Set([...pins, ...frame, ...further, ...slots.map(({ through }) => through)]);
  for (const joint of joints) widenedBox(box, circuit.x[joint], circuit.y[joint], circuit.count);
  for (const [x0, y0, x1, y1] of guides) widenedBox(box, [x0, x1], [y0, y1]);
  for (const { joint, radius } of wheels) {
    const [x, y] = [circuit.x[joint][0], circuit.y[joint][0]];
    widenedBox(box, [x - radius, x + radius], [y - radius, y + radius]);
  }
  return box;
}

function movingOutlines(linkage, traced) {
  const ground = groundOf(linkage);
  const moving = linkage.links.filter((link) => link !== ground);
  return moving.map((link) => linkOutline(linkage, link, traced)).filter(({ joints }) => joints.length > 1);
}

// The joints of a link along a bar or round a plate.
function linkOutline({ joints }, link, traced) {
  // The points of a grid are consecutive joints with one name.
  const isGrid = (id) =>
    id !== traced &&
    joints[id].step.kind === "rigid" &&
    (joints[id + 1]?.name === joints[id].name || joints[id - 1]?.name === joints[id].name);
  const places = link.filter(({ joint }) => !isGrid(joint));
  const isPlate = places.length > 2 && !isFlatOutline(places);
  const centre = ["x", "y"].map(
    (axis) => places.reduce((sum, place) => sum + place[axis], 0) / Math.max(places.length, 1),
  );
  const [first, last] = [places[0], places[places.length - 1]];
  const key = isPlate
    ? ({ x, y }) => Math.atan2(y - centre[1], x - centre[0])
    : ({ x, y }) => x * (last.x - first.x) + y * (last.y - first.y);
  const order = [...places].sort((a, b) => key(a) - key(b));
  return { joints: order.map(({ joint }) => joint), isPlate };
}

// Whether points lie on one line, to a thousandth of their extent.
function isFlatOutline(places) {
  const [x0, y0, x1, y1] = widenedBox(
    emptyBox(),
    places.map(({ x }) => x),
    places.map(({ y }) => y),
  );
  const size2 = (x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0);
  const [first, ...rest] = places;
  const area = (a, b) => (a.x - first.x) * (b.y - first.y) - (a.y - first.y) * (b.x - first.x);
  return rest.every((a) => rest.every((b) => Math.abs(area(a, b)) <= 1e-3 * size2));
}

// The part of a line on the frame that a slider moves along, [x0, y0, x1, y1].
function guideOf(linkage, circuit, id) {
  const { step } = linkage.joints[id];
  if (step.kind !== "slide" && step.kind !== "yoke") return null;
  const ground = groundOf(linkage);
  const [p, q] = step.line;
  if (!placeOnLink(ground, p) || !placeOnLink(ground, q)) return null;
  const [dx, dy] = [circuit.x[q][0] - circuit.x[p][0], circuit.y[q][0] - circuit.y[p][0]];
  const along = (i) => dx * circuit.x[id][i] + dy * circuit.y[id][i];
  const [least, most] = extremeSamples(circuit.count, along);
  if (least < 0) return null;
  return [circuit.x[id][least], circuit.y[id][least], circuit.x[id][most], circuit.y[id][most]];
}

// The part of a line on a moving link that a joint slides along. The line has the direction of a base: the
// pivot and foot of a slot, the guide of a yoke, or the line itself for a slot without offset.
function slotOf(linkage, circuit, id) {
  const { step } = linkage.joints[id];
  let base = null;
  let through = null;
  if (step.kind === "slot")
    [base, through] = [step.offset === 0 ? step.base : [step.base[0], id], step.base[1]];
  else if (step.kind === "yoke") [base, through] = [step.line, step.from];
  else return null;
  const { x, y, count } = circuit;
  const arms = Array.from({ length: count }, (_, i) => {
    const [bx, by] = [x[base[1]][i] - x[base[0]][i], y[base[1]][i] - y[base[0]][i]];
    const [ax, ay] = [x[through][i] - x[id][i], y[through][i] - y[id][i]];
    const size = Math.hypot(bx, by);
    return [(bx * ax + by * ay) / size, (bx * ay - by * ax) / size];
  }).filter(([along, across]) => Number.isFinite(along + across));
  const longest = arms.reduce((best, arm) => (Math.hypot(...arm) > Math.hypot(...best) ? arm : best), [0, 0]);
  const by = (i) => longest[0] * arms[i][0] + longest[1] * arms[i][1];
  const [least, most] = extremeSamples(arms.length, by);
  if (least < 0) return null;
  return { foot: id, through, base, near: arms[least], far: arms[most] };
}

// The arguments, integers below `count`, at which a function is least and greatest; -1 if it has no finite
// value.
function extremeSamples(count, value) {
  let [least, most] = [-1, -1];
  for (let i = 0; i < count; i++) {
    const v = value(i);
    if (!Number.isFinite(v)) continue;
    if (least < 0 || v < value(least)) least = i;
    if (most < 0 || v > value(most)) most = i;
  }
  return [least, most];
}

// The pitch circles of gears, on the pivots of both cranks. Gears that turn in the same direction mesh
// through an idler, which is not drawn: their circles do not touch. The slower gear is the larger.
function wheelsOf({ joints }, circuit) {
  const crank = joints.find(({ step }) => step.kind === "crank");
  if (!crank) return [];
  const first = crank.step.pivot;
  return joints
    .filter(({ step }) => step.kind === "gear")
    .flatMap(
      ({
        step: {
          pivot,
          ratio: [turns, of],
        },
      }) => {
        const [dx, dy] = [
          circuit.x[pivot][0] - circuit.x[first][0],
          circuit.y[pivot][0] - circuit.y[first][0],
        ];
        const unit = ((turns < 0 ? 1 : 0.8) * Math.hypot(dx, dy)) / (Math.abs(turns) + Math.abs(of));
        return [
          { joint: pivot, radius: unit * Math.abs(of) },
          { joint: first, radius: unit * Math.abs(turns) },
        ];
      },
    );
}
