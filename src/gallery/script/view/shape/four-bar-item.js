// A four-bar that has been found for a path, with its curve and its cognates.

import { placedData } from "../../draw/path-data.js";
import { buttonOf, h, s, setAttributes, termList, thumbnailFrame } from "../dom.js";
import { copyText } from "../export/save.js";
import { formatNumber } from "../labels.js";
import { viewOfOutlines } from "./match-item.js";

const FOUR_BAR_SIZE = { width: 320, height: 240 };
const DIMENSIONS = ["frame", "crank", "coupler", "rocker", "along", "across"];

/** The list item of an answer for a path with a size. @param {App} app @param {FourBarAnswer} answer @param {Outline} path */
export function fourBarItem(app, answer, path, size) {
  const { record, manifest } = answer;
  const { quality, rms_relative: relative, rms, max, longest_link: longest } = record;
  const pivots = [record.crank_pivot, record.rocker_pivot].map(
    (pivot) => `(${pivot.map((value) => lengthText(value, size)).join(", ")})`,
  );
  const rows = [
    ["Class", record.class],
    ["Worst transmission angle", angleText(record.mu_worst_deg)],
    ["Longest link", `${lengthText(longest, size)} = ${(longest / size).toFixed(2)} S`],
    ["Lengths", dimensionsText(record.parameters, size)],
    ["Crank pivot, rocker pivot", pivots.join(", ")],
    ...record.cognates.map((cognate) => ["Cognate", cognateText(cognate, size)]),
  ];
  const copy = async () => {
    if (await copyText("manifest", manifest)) app.announce("Manifest copied");
  };
  const deviation = [
    h("b", `${relative === 0 ? "0" : relative.toPrecision(3)} S, ${quality}`),
    ` E = ${lengthText(rms, size)}, greatest ${lengthText(max, size)}`,
  ];
  return h(
    "li",
    fourBarPicture(answer, path),
    h(
      "div",
      h("p.deviation", deviation),
      termList("dl.four-bar-facts", rows),
      buttonOf("Copy manifest", copy),
    ),
  );
}

/** The path, the curve and the linkage at the path's first point. @param {FourBarAnswer} _ @param {Outline} path */
function fourBarPicture({ curve, pose }, path) {
  const { width, height } = FOUR_BAR_SIZE;
  const outlines = curve ? [curve.points, path.points, pose] : [path.points, pose];
  const view = viewOfOutlines(outlines, width, height);
  const [crankPivot, rockerPivot, crankPin, rockerPin, point] = [0, 2, 4, 6, 8].map((k) =>
    pose.subarray(k, k + 2),
  );
  const bar = (...joints) =>
    placedData(Float64Array.from(joints.flatMap((joint) => [...joint])), false, view);
  const dot = (/** @type {Float64Array} */ [x, y]) =>
    s("circle", { cx: (view.x + view.scale * x).toFixed(1), cy: (view.y - view.scale * y).toFixed(1), r: 3 });
  const frame = thumbnailFrame(
    ".match-picture",
    FOUR_BAR_SIZE,
    curve && s("path.curve", { d: placedData(curve.points, curve.closed, view) }),
    s("path.query-shape", { d: placedData(path.points, path.closed, view) }),
    s("path.links", {
      d: bar(crankPivot, crankPin, point, rockerPin, crankPin) + bar(rockerPin, rockerPivot),
    }),
    s("g.joints", [crankPivot, rockerPivot, crankPin, rockerPin].map(dot)),
  );
  setAttributes(frame, FOUR_BAR_SIZE);
  return frame;
}

function lengthText(value, size) {
  return formatNumber(Math.abs(value) < 1e-12 * size ? 0 : value, 6);
}

function angleText(/** @type {number | null} */ degrees) {
  return degrees === null ? "–" : `${degrees.toFixed(1)}°`;
}

function dimensionsText(/** @type {Lengths} */ lengths, size) {
  return DIMENSIONS.map((name) => `${name} ${lengthText(lengths[name], size)}`).join(", ");
}

function cognateText(/** @type {FoundLinkage} */ cognate, size) {
  const outside = cognate.meets_constraints ? "" : ", outside the conditions";
  const angle = angleText(cognate.mu_worst_deg);
  return `${cognate.class}, worst transmission angle ${angle}${outside}: ${dimensionsText(cognate.parameters, size)}`;
}
