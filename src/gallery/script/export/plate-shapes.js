// The linkage of an exported curve as shapes of a plate, each with its path data as a function of the pose.

import { blockData, cylinderData, linkData, slotData, slotEnds } from "../draw/link-shapes.js";
import { circleData, pixel } from "../draw/path-data.js";

/** The radius of a pin on a plate, in quarter millimetres. */
const PLATE_PIN = 4;

// The style of each kind of shape. A plate contains its own colours, because it is shown in other programs.
const PLATE_INK = "#191816";
const PLATE_PAPER = "#fffdf8";
const SHAPE_STYLES = {
  body: { fill: "#191816", "fill-opacity": 0.07 },
  link: { stroke: PLATE_INK, "stroke-width": 1.9, "stroke-linecap": "round" },
  hollow: { fill: PLATE_PAPER, stroke: PLATE_INK, "stroke-width": 0.9 },
  joint: { fill: PLATE_PAPER, stroke: PLATE_INK, "stroke-width": 0.9 },
  tracer: { fill: "#7d2115", stroke: PLATE_PAPER, "stroke-width": 0.6 },
};

/**
 * The shapes of a mechanism (draw/mechanism.js) from bottom to top, [{ style: attributes, data(at, scale) }]:
 * `at` are the positions of all joints on the plate, [X0, Y0, X1, Y1, …]; `scale` is in plate units per unit
 * of length.
 */
export function plateShapes(mechanism, traced) {
  const { bars, plates, blocks, slots, actuators, fixed, pins } = mechanism;
  const shape = (kind, data) => ({ style: SHAPE_STYLES[kind], data });
  const ends = new Float64Array(4);
  const stem = (slot) =>
    shape("link", (at, scale) => {
      slotEnds(slot, at, scale, ends);
      const [x, y, x0, y0, x1, y1] = [at[2 * slot.foot], at[2 * slot.foot + 1], ...ends].map(pixel);
      return `M${x} ${y}L${x0} ${y0}L${x1} ${y1}`;
    });
  const hole = (slot) => shape("hollow", (at, scale) => slotData(...slotEnds(slot, at, scale, ends)));
  const rod = ([p, q]) => shape("link", (at) => linkData([p, q], at, false));
  const cylinder = ([p, q]) =>
    shape("hollow", (at) => cylinderData(at[2 * p], at[2 * p + 1], at[2 * q], at[2 * q + 1]));
  const block = ({ at: joint, line: [p, q] }) =>
    shape("hollow", (at) =>
      blockData(at[2 * joint], at[2 * joint + 1], at[2 * q] - at[2 * p], at[2 * q + 1] - at[2 * p + 1]),
    );
  const rings = (joints, radii) =>
    shape("joint", (at) =>
      joints
        .flatMap((joint) => radii.map((r) => circleData(pixel(at[2 * joint]), pixel(at[2 * joint + 1]), r)))
        .join(""),
    );
  return [
    // Plates are transparent.
    ...plates.map((joints) => shape("body", (at) => linkData(joints, at, true))),
    ...plates.map((joints) => shape("link", (at) => linkData(joints, at, true))),
    ...bars.map((joints) => shape("link", (at) => linkData(joints, at, false))),
    ...slots.flatMap((slot) => [stem(slot), hole(slot)]),
    ...actuators.flatMap((pair) => [rod(pair), cylinder(pair)]),
    ...blocks.map(block),
    rings(
      pins.filter((joint) => joint !== traced),
      [PLATE_PIN],
    ),
    rings(fixed, [1.5 * PLATE_PIN, 0.7 * PLATE_PIN]),
    shape("tracer", (at) => circleData(pixel(at[2 * traced]), pixel(at[2 * traced + 1]), PLATE_PIN)),
  ];
}
