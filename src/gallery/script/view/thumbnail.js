// Thumbnails of curves, from the stored points: SVG in the colours of the theme, for screen and print.

import { curveBox, curvePoints } from "../data/family.js";
import { s } from "./dom.js";

// The margin of a thumbnail, in pixels.
const THUMBNAIL_INSET = 3;
// Points closer than this, in pixels, are merged.
const THUMBNAIL_GRAIN = 0.6;

/**
 * Curves of a family in one frame, at one scale, y up: an SVG element of `width` × `height` pixels, hidden
 * from screen readers because adjacent text describes it. Several curves cycle through the five curve
 * colours; with `plain` all have the text colour.
 */
export function thumbnail(family, curves, { width, height, plain = curves.length === 1 }) {
  const [x0, y0, x1, y1] = boxOfCurves(family, curves);
  const scale = scaleToFit(x1 - x0, y1 - y0, width - 2 * THUMBNAIL_INSET, height - 2 * THUMBNAIL_INSET);
  const across = width / 2 - (scale * (x0 + x1)) / 2;
  const down = height / 2 + (scale * (y0 + y1)) / 2;
  const paths = curves.map((curve, k) =>
    s("path", {
      class: plain ? null : `ink-${(k % 5) + 1}`,
      d: curvePath(family, curve, { scale, origin: [across, down] }, THUMBNAIL_GRAIN),
    }),
  );
  return s(
    "svg",
    {
      class: "thumbnail",
      width,
      height,
      viewBox: `0 0 ${width} ${height}`,
      "aria-hidden": "true",
      focusable: "false",
    },
    paths,
  );
}

/** The bounding box of curves, [x0, y0, x1, y1], in the unit of length. */
function boxOfCurves(family, curves) {
  const whole = [Infinity, Infinity, -Infinity, -Infinity];
  for (const curve of curves) {
    const box = curveBox(family, curve);
    for (const k of [0, 1]) whole[k] = Math.min(whole[k], box[k]);
    for (const k of [2, 3]) whole[k] = Math.max(whole[k], box[k]);
  }
  return whole.every(Number.isFinite) ? whole : [0, 0, 0, 0];
}

function scaleToFit(wide, high, width, height) {
  const scale = Math.min(width / wide, height / high);
  return Number.isFinite(scale) && scale > 0 ? scale : 1;
}

/**
 * The path data of a curve in a view, { scale, origin: [x, y] }: X = x + scale · px, Y = y − scale · py.
 * Points closer than `grain` to the previous one are left out, except the first and the last.
 */
export function curvePath(family, curve, { scale, origin }, grain) {
  const points = curvePoints(family, curve);
  const digits = grain < 0.1 ? 3 : 1;
  const place = (k) => [origin[0] + scale * points[k], origin[1] - scale * points[k + 1]];
  let [lastX, lastY] = [Infinity, Infinity];
  let path = "";
  for (let k = 0; k < points.length; k += 2) {
    const [x, y] = place(k);
    if (Math.abs(x - lastX) < grain && Math.abs(y - lastY) < grain && k + 2 < points.length) continue;
    path += `${path ? "L" : "M"}${x.toFixed(digits)} ${y.toFixed(digits)}`;
    [lastX, lastY] = [x, y];
  }
  return family.curves.closed[curve] ? `${path}Z` : path;
}
