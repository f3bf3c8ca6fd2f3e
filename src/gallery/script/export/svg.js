// Draws a plate of an exported curve and its linkage as SVG: 200 by 150 mm, in quarter millimetres.

import { cellCaption } from "../data/family.js";
import { finePath } from "../kinematics/path.js";
import { dashData, dashPattern } from "../draw/dashes.js";
import { mechanismOf, sweptBox } from "../draw/mechanism.js";
import { fittedView, roundBelow } from "../draw/plane-view.js";
import { circleData, polylineData } from "../draw/path-data.js";
import { passLength } from "../kinematics/pass.js";
import { shortestDigits } from "./digits.js";
import { plateShapes } from "./plate-shapes.js";
import { exportPose } from "./curve.js";

/** The plate's size in millimetres, and its units per millimetre. */
export const PLATE_SIZE = { width: 200, height: 150, units: 4 };

/** An exported curve as SVG. */
export function svgOfCurve(exported) {
  const pose = exportPose(exported);
  const joints = exported.linkage.joints.map((_, joint) => pose(joint));
  return svgOfPoses(exported, [joints], 0);
}

/**
 * A plate of an exported curve with its linkage in one pose, or animated through several in `seconds`, in a
 * loop; a pose has the position { x, y } of each joint.
 */
export function svgOfPoses(exported, poses, seconds) {
  const mechanism = mechanismOf(exported.linkage, exported.circuitSamples);
  const view = viewOfPlate(sweptBox(mechanism, exported.circuitSamples, [exported.joint]));
  const placed = poses.map((pose) =>
    pose.flatMap(({ x, y }) => [view.x + view.scale * x, view.y - view.scale * y]),
  );
  const shapes = plateShapes(mechanism, exported.joint).map(({ style, data }) => {
    const frames = placed.map((at) => data(at, view.scale));
    return pathElement({ d: frames[0], ...style }, frames.length > 1 ? animateElement(frames, seconds) : "");
  });
  const { width, height, units } = PLATE_SIZE;
  const head = {
    xmlns: "http://www.w3.org/2000/svg",
    width: `${width}mm`,
    height: `${height}mm`,
    viewBox: `0 0 ${units * width} ${units * height}`,
    "font-family": "'DejaVu Sans',Verdana,sans-serif",
    "stroke-linejoin": "round",
    fill: "none",
  };
  const body = [
    `<title>${escapeXml(`${exported.family.title}, ${exported.name}`)}</title>\n`,
    `<rect width="${units * width}" height="${units * height}" fill="#fffdf8"/>\n`,
    lettering(exported, view),
    staticShapes(exported, mechanism, view),
    `<g class="linkage">\n${shapes.join("")}</g>\n`,
  ];
  return `<svg${attributesOf(head)}>\n${body.join("")}</svg>\n`;
}

// The view centred in the area above the lettering.
function viewOfPlate(box) {
  const { width, height, units } = PLATE_SIZE;
  const [top, foot, side] = [84, 84, 48];
  const view = fittedView(box, {
    width: units * width - 2 * side,
    height: units * height - top - foot,
    margin: 8,
  });
  return { ...view, x: view.x + side, y: view.y + top };
}

// The static parts: the frame, guides and wheels, and the dashed curve on a light line.
function staticShapes(exported, { frame, guides, wheels }, view) {
  const { linkage, circuitSamples, joint, family } = exported;
  const place = (x, y) => [view.x + view.scale * x, view.y - view.scale * y];
  const at = (id) => place(circuitSamples.x[id][0], circuitSamples.y[id][0]);
  const hair = { stroke: "#8f8b80", "stroke-width": 0.6 };
  const fine = finePath(linkage, circuitSamples, joint, 0.05 / view.scale);
  const points = Float64Array.from(fine.points, (v, k) =>
    k % 2 === 0 ? view.x + view.scale * v : view.y - view.scale * v,
  );
  const dashes = dashPattern(dashPeriodOfCurve(family, linkage, circuitSamples));
  const through = (places, closed) => polylineData(places.flat(), { closed });
  const parts = [
    [through(frame.map(at), frame.length > 2), hair],
    [wheels.map(({ joint: hub, radius }) => circleData(...at(hub), view.scale * radius)).join(""), hair],
    [
      guides.map(([x0, y0, x1, y1]) => through([place(x0, y0), place(x1, y1)], false)).join(""),
      { ...hair, stroke: "#191816" },
    ],
    [polylineData(points), { stroke: "#cba79f", "stroke-width": 0.9 }],
    [
      dashData({ ...fine, points }, dashes),
      { stroke: "#7d2115", "stroke-width": 2, "stroke-linecap": "butt" },
    ],
  ];
  const drawn = parts.filter(([d]) => d !== "").map(([d, style]) => pathElement({ d, ...style }, ""));
  return `<g class="curve">\n${drawn.join("")}</g>\n`;
}

// The input covered by a dash and its gap: the family's, or, for a length, a round fraction of the longest
// pass.
function dashPeriodOfCurve(family, linkage, { passes }) {
  return linkage.input.isLength ? roundBelow(Math.max(...passes.map(passLength)) / 20) : family.dash_deg;
}

// The title, the name, the parameters and a scale bar.
function lettering(exported, view) {
  const { family, place, changes, values, name } = exported;
  const { width, height, units } = PLATE_SIZE;
  const [right, foot] = [units * width - 32, units * height - 32];
  const own = family.names
    .map((word, k) => `${word} = ${shortestDigits(Number(values[k].toPrecision(6)))}`)
    .join(", ");
  const caption = (changes.size === 0 && cellCaption(family, place)) || own;
  const length = roundBelow(100 / view.scale);
  const bar = `M32 ${foot - 3}v6M32 ${foot}h${Number((view.scale * length).toPrecision(6))}m0 -3v6`;
  const text = (x, y, size, fill, words, anchor = "start") =>
    `<text${attributesOf({ x, y, "font-size": size, fill, "text-anchor": anchor })}>` +
    `${escapeXml(words)}</text>\n`;
  return [
    text(32, 46, 20, "#191816", family.title),
    text(32, 66, 10, "#504d46", name),
    text((units * width) / 2, foot - 18, 12, "#191816", caption, "middle"),
    pathElement({ d: bar, stroke: "#504d46", "stroke-width": 0.7 }, ""),
    text(32, foot + 16, 9, "#504d46", shortestDigits(Number(length.toPrecision(6)))),
    text(right, foot + 4, 9, "#504d46", "coupler-atlas", "end"),
  ].join("");
}

// Path data animated through frames at equal time steps.
function animateElement(frames, seconds) {
  if (frames.every((frame) => frame === frames[0])) return "";
  const values = frames.join(";");
  const timing = { dur: `${seconds}s`, repeatCount: "indefinite" };
  return `<animate${attributesOf({ attributeName: "d", values, ...timing })}/>`;
}

function pathElement(attributes, inside) {
  return `<path${attributesOf(attributes)}${inside === "" ? "/>" : `>${inside}</path>`}\n`;
}

function attributesOf(attributes) {
  return Object.entries(attributes)
    .map(([name, value]) => ` ${name}="${escapeXml(String(value))}"`)
    .join("");
}

/** Escapes text for XML and removes characters that XML does not allow. */
function escapeXml(text) {
  const entities = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return text
    .replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, "")
    .replace(/[&<>"]/g, (c) => entities[c]);
}
