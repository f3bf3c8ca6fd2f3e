// A result of the search by shape: a curve with the best fit of the shape overlaid, or a four-bar.

import { curveKey } from "../../data/family.js";
import { portion } from "../../shape/outline.js";
import { smoothData, placedData } from "../../draw/path-data.js";
import { boxOfPoints, fittedView, inverted } from "../../draw/plane-view.js";
import { transformed, pointPairs, screenPoint } from "../../draw/plane-view.js";
import { h, s, sizedThumbnail, buttonOf, setAttributes, termList } from "../dom.js";
import { address, newAddress } from "../../data/address.js";
import { formatCaption, formatNumber } from "../labels.js";
import { pinButton } from "../pins.js";
import { familiesText } from "./matches.js";
import { copyText } from "../export/files.js";
import { fourBarAddress } from "../new-view.js";

/**
 * The list item of a result of `mergedMatches` for a shape with the options of a query (query.js).
 * @param {App} app @param {MergedMatch} merged @param {Outline} shape
 */
export function matchItem(app, merged, shape, /** @type {ShapeQuery} */ { by, part }) {
  const { match: one, others } = merged;
  const { family, curve, name, caption } = one;
  const other = by === "rms" ? "greatest" : "rms";
  /** @param {"rms" | "greatest"} measure */
  const percent = (/** @type {"rms" | "greatest"} */ measure) =>
    `${(100 * one[measure]).toFixed(2)} % ${measure}`;
  const share = part ? `, ${Math.round(100 * Math.abs(one.to - one.from))} % of the curve` : "";
  const href = address([family.id, "curve", curveKey(family, curve)]);
  const picture = matchPicture(one, shape, { width: 220, height: 170 });
  const deviations = [qualityMark(one.quality), " ", h("b", percent(by)), ` ${percent(other)}${share}`];
  const label = h("span.label", formatCaption(caption || name));
  const title = [one, ...others].map((same) => same.name).join(", ");
  const families = h("span.label", { title }, familiesText(merged));
  const words = ["Pin", h("span.visually-hidden", ` ${name}`)];
  const pin = pinButton(app, name, { class: "quiet" }, ...words);
  const similar = h("a", { href: address(["shape"], { like: name }) }, "Find similar");
  const link = h("a", { href, "data-name": name }, picture, h("span.label", deviations), families, label);
  return h("li", link, h("span.acts", similar, pin));
}

/** How near a curve is in a word, as `find` has it (crates/coupler-find/src/quality.rs). */
export function qualityMark(/** @type {string} */ quality) {
  return h(`span.quality.${quality}`, quality);
}

/** A sentence on the results among so many curves. @param {MergedMatch[]} merged @param {number} curves @param {string} by */
export function matchesText(merged, curves, by) {
  const count = merged.length;
  if (count === 0) return "No similar curve found";
  const poor = merged[0].match.quality === "poor" ? ", all of them poor" : "";
  const nearest = count === 1 ? "nearest" : `${count} nearest`;
  const ranked = `equal ones together, ranked by ${by} deviation in % of the shape’s size`;
  return `The ${nearest} of ${curves.toLocaleString("en")} curves${poor}, ${ranked}`;
}

const MATCH_INSET = 6;

/** The picture of a result of `nearestCurves` with the shape overlaid, `width` × `height` pixels. @param {Match} _ @param {Outline} shape @param {Size} size */
function matchPicture({ outline: { points, closed }, similarity, from, to }, shape, size) {
  const fitted = transformed(inverted(similarity), shape.points);
  const view = viewOfOutlines([points, fitted], size);
  const isPart = from !== 0 || to !== 1;
  const [first, last] = from < to ? [from, to] : [to, from];
  const part = isPart ? portion(points, closed, first, last, 96).points : points;
  return sizedThumbnail(
    ".match-picture",
    size,
    s("path", { class: isPart ? "rest" : "curve", d: smoothData(points, closed, view) }),
    isPart ? s("path.curve", { d: smoothData(part, false, view) }) : null,
    s("path.query-shape", { d: smoothData(fitted, shape.closed, view) }),
  );
}

/** The placement that fits outlines into a frame, `margin` pixels from its edges. @param {Points[]} outlines @param {Size} size */
export function viewOfOutlines(outlines, size, margin = MATCH_INSET) {
  return fittedView(boxOfPoints(...outlines), { ...size, margin });
}

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
