// A four-bar that has been found for a path, with its curve and its cognates.

import { placedData, smoothData } from "../../draw/path-data.js";
import { pointPairs, screenPoint } from "../../draw/plane-view.js";
import { newAddress } from "../../data/address.js";
import { buttonOf, h, s, setAttributes, sizedThumbnail, termList } from "../dom.js";
import { copyText } from "../export/files.js";
import { fourBarAddress } from "../new-view.js";
import { formatNumber } from "../labels.js";
import { qualityMark, viewOfOutlines } from "./match-item.js";

const FOUR_BAR_SIZE = { width: 320, height: 240 };
/** @type {(keyof Lengths)[]} */
const DIMENSIONS = ["frame", "crank", "coupler", "rocker", "along", "across"];

/** The list item of an answer for a path with a size. @param {App} app @param {FourBarAnswer} answer @param {Outline} path */
export function fourBarItem(app, answer, path, /** @type {number} */ size) {
  const { record, manifest, degeneracy } = answer;
  const { quality, rms_relative: relative, rms, max, longest_link: longest } = record;
  const pivots = [record.crank_pivot, record.rocker_pivot].map(
    (pivot) => `(${pivot.map((value) => lengthText(value, size)).join(", ")})`,
  );
  const rows = [
    ["Class", degeneracy ?? record.class],
    ["Worst transmission angle", angleText(record.mu_worst_deg)],
    ["Longest link", `${lengthText(longest, size)} = ${(longest / size).toFixed(2)} S`],
    ["Lengths", dimensionsText(record.parameters, size)],
    ["Crank pivot, rocker pivot", pivots.join(", ")],
    ...record.cognates.map((cognate) => ["Cognate", cognateText(cognate, size)]),
  ];
  const plate = h("a", { href: newAddress("four-bar", record.parameters) }, "Open on a plate");
  fourBarAddress(app, answer).then(
    (href) => setAttributes(plate, { href }),
    () => {},
  );
  const deviation = [
    h("b", qualityMark(quality), ` ${relative === 0 ? "0" : relative.toPrecision(3)} S`),
    ` E = ${lengthText(rms, size)}, greatest ${lengthText(max, size)}`,
  ];
  return h(
    "li",
    fourBarPicture(answer, path),
    h(
      "div",
      h("p.deviation", deviation),
      termList("dl.four-bar-facts", rows),
      h("div.toolbar", plate, copyButton(app, "Copy manifest", manifest)),
    ),
  );
}

/** A button that copies a manifest. @param {App} app */
export function copyButton(app, /** @type {string} */ label, /** @type {string} */ manifest) {
  return buttonOf(label, async () => {
    if (await copyText("manifest", manifest)) app.announce("Manifest copied");
  });
}

/** The path, the curve and the linkage at the first point of the path. @param {FourBarAnswer} answer @param {Outline} path */
function fourBarPicture(answer, path) {
  const { curve, pose } = answer;
  const outlines = curve ? [curve.points, path.points, pose] : [path.points, pose];
  const view = viewOfOutlines(outlines, FOUR_BAR_SIZE);
  const line = s("path.query-shape", { d: placedData(path.points, path.closed, view) });
  return sizedThumbnail(".match-picture", FOUR_BAR_SIZE, line, fourBarDrawing(answer, view));
}

/** A four-bar with its curve. @param {FourBarAnswer} _ @param {Placement} view */
export function fourBarDrawing({ curve, pose }, view, rank = 1) {
  const [o, c, a, b, m] = pointPairs(pose);
  const bars = (/** @type {Point[]} */ ...joints) => placedData(joints.flat(), false, view);
  const joint = (/** @type {Point} */ [cx, cy]) => s("circle", { cx, cy, r: 3 });
  return s(
    "g.four-bar",
    { "data-rank": rank },
    curve && s("path.curve", { d: smoothData(curve.points, curve.closed, view) }),
    s("path.links", { d: bars(o, a, m, b, a) + bars(b, c) }),
    [o, c, a, b].map((point) => joint(screenPoint(view, point))),
  );
}

function lengthText(/** @type {number} */ value, /** @type {number} */ size) {
  return formatNumber(Math.abs(value) < 1e-12 * size ? 0 : value, 6);
}

function angleText(/** @type {number | null} */ degrees) {
  return degrees === null ? "–" : `${degrees.toFixed(1)}°`;
}

function dimensionsText(/** @type {Lengths} */ lengths, /** @type {number} */ size) {
  return DIMENSIONS.map((name) => `${name} ${lengthText(lengths[name], size)}`).join(", ");
}

function cognateText(/** @type {FoundLinkage} */ cognate, /** @type {number} */ size) {
  const outside = cognate.meets_constraints ? "" : ", outside the conditions";
  const angle = angleText(cognate.mu_worst_deg);
  return `${cognate.class}, worst transmission angle ${angle}${outside}: ${dimensionsText(cognate.parameters, size)}`;
}
