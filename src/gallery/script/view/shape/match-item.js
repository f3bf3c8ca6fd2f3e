// A result of the search by shape: a curve with the best fit of the shape overlaid.

import { curveKey } from "../../data/family.js";
import { portion } from "../../shape/outline.js";
import { smoothData } from "../../draw/path-data.js";
import { boxOfPoints, fittedView, inverted, transformed } from "../../draw/plane-view.js";
import { h, s, sizedThumbnail } from "../dom.js";
import { address } from "../../data/address.js";
import { formatCaption } from "../labels.js";
import { pinButton } from "../pins.js";
import { familiesText } from "./matches.js";

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
