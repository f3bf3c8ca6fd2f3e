// A curve with the best fit of a shape overlaid.

import { curvePoints } from "../../data/family.js";
import { inverted, transformed } from "../../shape/similarity.js";
import { portion } from "../../shape/outline.js";
import { s } from "../dom.js";

const MATCH_INSET = 6;

/** The picture of a result of `searchByShape` with the shape overlaid, `width` × `height` pixels. */
export function matchPicture({ family, curve, similarity, from, to }, shape, { width, height }) {
  const points = curvePoints(family, curve);
  const closed = family.curves.closed[curve] === 1;
  const fitted = transformed(inverted(similarity), shape.points);
  const view = viewOfOutlines([points, fitted], width, height);
  const isPart = from !== 0 || to !== 1;
  const part = isPart ? portion(points, closed, from, to, 96).points : points;
  return s(
    "svg",
    {
      class: "thumbnail match-picture",
      width,
      height,
      viewBox: `0 0 ${width} ${height}`,
      "aria-hidden": "true",
      focusable: "false",
    },
    s("path", { class: isPart ? "rest" : "curve", d: outlineData(points, closed, view) }),
    isPart ? s("path", { class: "curve", d: outlineData(part, false, view) }) : null,
    s("path", { class: "query-shape", d: outlineData(fitted, shape.closed, view) }),
  );
}

/**
 * The view that fits outlines into a frame, `inset` pixels from its edges: { scale, x, y } with X = x +
 * scale·px, Y = y − scale·py.
 */
export function viewOfOutlines(outlines, width, height, inset = MATCH_INSET) {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const points of outlines) {
    for (let k = 0; k < points.length; k += 2) {
      [x0, x1] = [Math.min(x0, points[k]), Math.max(x1, points[k])];
      [y0, y1] = [Math.min(y0, points[k + 1]), Math.max(y1, points[k + 1])];
    }
  }
  const scale = Math.min((width - 2 * inset) / (x1 - x0 || 1e-9), (height - 2 * inset) / (y1 - y0 || 1e-9));
  return { scale, x: width / 2 - (scale * (x0 + x1)) / 2, y: height / 2 + (scale * (y0 + y1)) / 2 };
}

/** The path data of an outline in a view, with a number of decimals of a pixel. */
export function outlineData(points, closed, { scale, x, y }, decimals = 1) {
  let path = "";
  for (let k = 0; k < points.length; k += 2) {
    const [across, down] = [x + scale * points[k], y - scale * points[k + 1]];
    path += `${k ? "L" : "M"}${across.toFixed(decimals)} ${down.toFixed(decimals)}`;
  }
  return closed ? `${path}Z` : path;
}
