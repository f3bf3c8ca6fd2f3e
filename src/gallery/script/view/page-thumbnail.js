// Pages drawn small.

import { pageFile } from "../data/atlas.js";
import { h, s } from "./dom.js";
import { paperTone } from "./paper-tone.js";
import { curvePath } from "./thumbnail.js";

// Places on paper closer than this, in millimetres, are one in a thumbnail.
const PAPER_GRAIN = 1;

/**
 * A page of a family small: its curves where they stand on it, drawn from the data; a chart, of which the
 * data knows no places, as the picture it is. Null where there is neither.
 */
export function pageThumbnail(atlas, family, page) {
  const { views } = family.pages[page - 1] ?? { views: [] };
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
 * The curves of some views of a page where they stand on its paper, in millimetres, as an SVG of the page's
 * shape.
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
