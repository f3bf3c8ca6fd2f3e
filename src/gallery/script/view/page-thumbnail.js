// Thumbnails of pages.

import { pageFile } from "../data/atlas.js";
import { pageViews } from "../data/family.js";
import { isScattered } from "../data/needs.js";
import { h, s, thumbnailFrame } from "./dom.js";
import { curvePath } from "./thumbnail.js";

// Points closer than this, in millimetres of paper, are merged in a thumbnail.
const PAPER_GRAIN = 0.2;

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
