// Thumbnails of curves and of pages, from the stored points: SVG in the colours of the theme, for screen and print.

import { pageFile } from "../data/atlas.js";
import { curveBox, curveOutline, pageViews } from "../data/family.js";
import { isScattered } from "../data/needs.js";
import { smoothData } from "../draw/path-data.js";
import { boxOfPoints, fittedView } from "../draw/plane-view.js";
import { h, s, sizedThumbnail, thumbnailFrame } from "./dom.js";

// The margin of a thumbnail, in pixels.
const THUMBNAIL_INSET = 3;
// Points closer than this, in millimetres of paper, are merged in a thumbnail.
const PAPER_GRAIN = 0.2;

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

/**
 * The thumbnail of a page: its curves drawn from the data if they are loaded (needs.js), or its file. Null if
 * there is neither. The curves of a scattered page are not drawn.
 * @param {number} page
 */
export function pageThumbnail(/** @type {Atlas} */ atlas, /** @type {Family} */ family, page) {
  const views = isScattered(family) ? [] : pageViews(family, page);
  if (views.length) return drawPage(family, views, ".page-thumbnail", PAPER_GRAIN);
  const file = pageFile(atlas, family.id, page);
  if (!file) return null;
  const lazy = { loading: "lazy", decoding: "async" };
  return h("img.page-thumbnail.printed", { src: file, alt: "", ...lazy, "data-paper": paperTone(family) });
}

/**
 * The curves of views of a page at their positions on paper, in millimetres, as an SVG with the page's aspect ratio.
 * @param {string} name @param {number} grain
 */
export function drawPage(/** @type {Family} */ family, /** @type {PageDrawing[]} */ views, name, grain) {
  const paths = views.flatMap((view) =>
    view.curves.map((curve, k) =>
      s("path", {
        class: `ink-${(k % 5) + 1}`,
        d: curvePath(family, curve, view, grain),
        "vector-effect": "non-scaling-stroke",
      }),
    ),
  );
  return thumbnailFrame(name, family.paper, paths);
}

/** The `data-paper` attribute of a family's pictures: "dark" for dark paper, otherwise null. */
export function paperTone(/** @type {Family} */ { paper }) {
  return paper.is_dark ? "dark" : null;
}
