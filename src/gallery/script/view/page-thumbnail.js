// Thumbnails of pages.

import { pageFile } from "../data/atlas.js";
import { pageViews } from "../data/family.js";
import { isScattered } from "../data/needs.js";
import { h, s } from "./dom.js";
import { paperTone } from "./paper-tone.js";
import { curvePath } from "./thumbnail.js";

// Points closer than this, in millimetres of paper, are merged in a thumbnail.
const PAPER_GRAIN = 1;

/**
 * The thumbnail of a page: its curves drawn from the data if they are loaded (needs.js), or its file. Null if
 * there is neither. The curves of a scattered page are not drawn.
 */
export function pageThumbnail(atlas, family, page) {
  const views = isScattered(family) ? [] : pageViews(family, page);
  if (views.length) return drawPage(family, views, "page-thumbnail thumbnail", PAPER_GRAIN);
  const file = pageFile(atlas, family.id, page);
  if (!file) return null;
  return h("img", {
    class: "page-thumbnail printed",
    src: file,
    alt: "",
    loading: "lazy",
    decoding: "async",
    "data-paper": paperTone(family),
  });
}

/**
 * The curves of views of a page at their positions on paper, in millimetres, as an SVG with the page's aspect
 * ratio.
 */
export function drawPage(family, views, name, grain) {
  const { width, height } = family.paper;
  const paths = views.flatMap((view) =>
    view.curves.map((curve, k) =>
      s("path", {
        class: `ink-${(k % 5) + 1}`,
        d: curvePath(family, curve, view, grain),
        "vector-effect": "non-scaling-stroke",
      }),
    ),
  );
  return s(
    "svg",
    { class: name, viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true", focusable: "false" },
    paths,
  );
}
