// Thumbnails of curves, from the stored points: SVG in the colours of the theme, for screen and print.

import { curveBox, curveOutline } from "../data/family.js";
import { smoothData } from "../draw/path-data.js";
import { boxOfPoints, fittedView } from "../draw/plane-view.js";
import { s, sizedThumbnail } from "./dom.js";

// The margin of a thumbnail, in pixels.
const THUMBNAIL_INSET = 3;

/**
 * Curves of a family in one frame, at one scale, y up: an SVG element of `width` × `height` pixels, hidden from screen readers because
 * adjacent text describes it. Several curves cycle through the five curve colours; with `plain` all have the text colour.
 * @param {Family} family @param {number[]} curves @param {Size & { plain?: boolean }} _2
 */
export function thumbnail(family, curves, { width, height, plain = curves.length === 1 }) {
  const boxes = curves.map((curve) => curveBox(family, curve));
  const { scale, x, y } = fittedView(boxOfPoints(...boxes), { width, height, margin: THUMBNAIL_INSET });
  const paths = curves.map((curve, k) =>
    s("path", {
      class: plain ? null : `ink-${(k % 5) + 1}`,
      d: curvePath(family, curve, { scale, origin: [x, y] }),
    }),
  );
  return sizedThumbnail("", { width, height }, paths);
}

/**
 * The path data of a curve in a view; points closer than `grain` to the one before are left out.
 * @param {Family} family @param {number} curve @param {Pick<PageDrawing, "scale" | "origin">} view
 */
export function curvePath(family, curve, { scale, origin: [x, y] }, grain = 0.1) {
  const { points, closed } = curveOutline(family, curve);
  return smoothData(points, closed, { scale, x, y }, grain < 0.1 ? 3 : 1, grain);
}
