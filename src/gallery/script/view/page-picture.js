// The picture of a page and the overlay of its curves.

import { pageFile } from "../data/atlas.js";
import { curveCaption, curveKey, pageViews } from "../data/family.js";
import { address } from "../data/address.js";
import { fill, h, s } from "./dom.js";
import { paperTone } from "./paper-tone.js";
import { drawPage } from "./page-thumbnail.js";

// The minimum width of the area of a link, in millimetres of paper.
const MIN_LINK_WIDTH = 1;

/**
 * A page as an element with the paper's aspect ratio: the page's file, or its curves drawn from the data if
 * there is no readable file. Resolves when it can be painted.
 */
export async function pagePicture(app, family, page, label) {
  const views = pageViews(family, page);
  const file = pageFile(app.atlas, family.id, page);
  if (file) {
    const tone = { "data-paper": paperTone(family) };
    const image = h("img", { class: "picture printed", alt: label, src: file, draggable: "false", ...tone });
    try {
      await image.decode();
      return image;
    } catch {
      app.announce(`${file} cannot be read; the page is drawn from the data`);
    }
  }
  if (views.length) {
    const drawing = drawPage(family, views, "picture drawn thumbnail", 0.05);
    return h("div", { class: "picture", role: "img", "aria-label": label }, drawing);
  }
  return h("p", { class: "picture nothing" }, "This page is a chart that was not written as SVG or PNG.");
}

/**
 * The overlay of the picture: a link for each curve of the page, invisible unless highlighted. Returns {
 * element, links: Map of curve to link, show(pathData), point([x, y] or null) }, with positions in
 * millimetres of paper.
 */
export function pageOverlay(family, drawn, { onfocus, onblur }) {
  const { width, height } = family.paper;
  const links = new Map(drawn.map(({ curve }) => [curve, curveLink(family, curve, { onfocus, onblur })]));
  const path = s("path", { class: "highlighted", "vector-effect": "non-scaling-stroke" });
  const dot = s("g", { class: "at" }, s("circle", { r: 1 }));
  const element = s(
    "svg",
    {
      class: "overlay",
      viewBox: `0 0 ${width} ${height}`,
      role: "group",
      "aria-label": "Curves of this page",
    },
    path,
    dot,
    [...links.values()],
  );
  for (const { curve, box } of drawn) fill(links.get(curve), linkArea(box));
  return {
    element,
    links,
    show: (data) => (data ? path.setAttribute("d", data) : path.removeAttribute("d")),
    point: (place, radius) => {
      dot.toggleAttribute("hidden", !place);
      if (!place) return;
      dot.setAttribute("transform", `translate(${place[0]} ${place[1]})`);
      dot.firstChild.setAttribute("r", radius);
    },
  };
}

/** The area of a curve's link for screen readers and the browser's focus. */
function linkArea([x0, y0, x1, y1]) {
  // The box of a straight path has no width, and browsers do not draw a rectangle without one.
  const [width, height] = [Math.max(x1 - x0, MIN_LINK_WIDTH), Math.max(y1 - y0, MIN_LINK_WIDTH)];
  const corner = { x: (x0 + x1 - width) / 2, y: (y0 + y1 - height) / 2 };
  return s("rect", { ...corner, width, height, class: "link-area" });
}

function curveLink(family, curve, { onfocus, onblur }) {
  const key = curveKey(family, curve);
  const caption = curveCaption(family, curve);
  return s("a", {
    href: address([family.id, "curve", key]),
    tabindex: "-1",
    "data-curve": curve,
    "aria-label": `Curve ${key}${caption ? `, ${caption}` : ""}`,
    onfocus: () => onfocus(curve),
    onblur: () => onblur(curve),
  });
}
