// The picture of a page, the overlay of its curves, and the curve at a position.

import { pageFile } from "../data/atlas.js";
import { curveCaption, curveKey, pageViews, curvePoints } from "../data/family.js";
import { curveAddress } from "../data/address.js";
import { h, s, setAttributes } from "./dom.js";
import { drawPage, paperTone } from "./thumbnail.js";
import { boxOfPoints } from "../draw/plane-view.js";

// The minimum width of the area of a link, in millimetres of paper.
const MIN_LINK_WIDTH = 1;

/**
 * A page as an element with the paper's aspect ratio: the page's file, or its curves drawn from the data if
 * there is no readable file. Resolves when it can be painted.
 * @param {number} page @param {string} label
 */
export async function pagePicture(/** @type {App} */ app, /** @type {Family} */ family, page, label) {
  const views = pageViews(family, page);
  const file = pageFile(app.atlas, family.id, page);
  if (file) {
    const tone = { "data-paper": paperTone(family) };
    const image = h("img.picture.printed", { alt: label, src: file, draggable: "false", ...tone });
    try {
      await image.decode();
      return image;
    } catch {
      app.announce(`${file} cannot be read; the page is drawn from the data`);
    }
  }
  if (views.length) {
    const drawing = drawPage(family, views, ".picture.drawn", 0.05);
    return h("div.picture", { role: "img", "aria-label": label }, drawing);
  }
  return h("p.picture.nothing", "This page is a chart that was not written as SVG or PNG.");
}

/**
 * The overlay of the picture: a link for each curve of the page, invisible unless highlighted. Positions are in millimetres of paper.
 * @param {Family} family @param {DrawnCurve[]} drawn @param {{ onfocus(curve: number): void, onblur(): void }} _
 */
export function pageOverlay(family, drawn, { onfocus, onblur }) {
  const { width, height } = family.paper;
  const links = new Map(drawn.map((one) => [one.curve, curveLink(family, one, { onfocus, onblur })]));
  const path = s("path.highlighted", { "vector-effect": "non-scaling-stroke" });
  const circle = s("circle", { r: 1 });
  const dot = s("g.at", circle);
  const group = { role: "group", "aria-label": "Curves of this page" };
  const viewBox = `0 0 ${width} ${height}`;
  const element = s("svg.overlay", { viewBox, ...group }, path, dot, [...links.values()]);
  return {
    element,
    links,
    show: (/** @type {string | null} */ data) => setAttributes(path, { d: data }),
    point: (/** @type {Point | null} */ place, radius = 1) => {
      dot.toggleAttribute("hidden", !place);
      if (!place) return;
      setAttributes(dot, { transform: `translate(${place[0]} ${place[1]})` });
      setAttributes(circle, { r: radius });
    },
  };
}

/** The area of a curve's link for screen readers and the browser's focus. */
function linkArea(/** @type {Box} */ [x0, y0, x1, y1]) {
  // The box of a straight path has no width, and browsers do not draw a rectangle without one.
  const [width, height] = [Math.max(x1 - x0, MIN_LINK_WIDTH), Math.max(y1 - y0, MIN_LINK_WIDTH)];
  const corner = { x: (x0 + x1 - width) / 2, y: (y0 + y1 - height) / 2 };
  return s("rect.link-area", { ...corner, width, height });
}

/** @param {Family} family @param {DrawnCurve} _ @param {{ onfocus(curve: number): void, onblur(): void }} _1 */
function curveLink(family, { curve, box }, { onfocus, onblur }) {
  const key = curveKey(family, curve);
  const caption = curveCaption(family, curve);
  const attributes = {
    href: curveAddress(family.id, key),
    tabindex: "-1",
    "data-curve": curve,
    "aria-label": `Curve ${key}${caption ? `, ${caption}` : ""}`,
    onfocus: () => onfocus(curve),
    onblur,
  };
  return s("a", attributes, linkArea(box));
}

/** Prefetches the pages before and after a page. @param {App} app @param {Family} family */
export function prefetchPages(app, family, /** @type {number} */ page) {
  for (const other of [page + 1, page - 1]) {
    const file = other >= 1 && pageFile(app.atlas, family.id, other);
    if (file) new Image().src = file;
  }
}

/** The curves of a page's views on paper, with points and boxes in millimetres, y down. @param {Family} family @param {PageDrawing[]} views */
export function curvesOnPaper(/** @type {Family} */ family, /** @type {PageDrawing[]} */ views) {
  return views.flatMap((view) =>
    view.curves.map((curve) => {
      const points = curvePoints(family, curve);
      for (let k = 0; k < points.length; k += 2) {
        points[k] = view.origin[0] + view.scale * points[k];
        points[k + 1] = view.origin[1] - view.scale * points[k + 1];
      }
      return { curve, view, points, box: boxOfPoints(points), closed: family.curves.closed[curve] === 1 };
    }),
  );
}

/** The curve of `drawn` nearest to a position in millimetres, within `reach`; undefined if there is none. @param {number} reach */
export function nearestCurve(/** @type {DrawnCurve[]} */ drawn, /** @type {Point} */ [x, y], reach) {
  let nearest;
  let least = reach * reach;
  for (const candidate of drawn) {
    const [x0, y0, x1, y1] = candidate.box;
    if (x < x0 - reach || x > x1 + reach || y < y0 - reach || y > y1 + reach) continue;
    const square = squaredDistance(candidate, x, y);
    if (square <= least) [nearest, least] = [candidate, square];
  }
  return nearest;
}

/** The square of the distance of a point from an outline; infinite if it has no points. @param {number} x @param {number} y */
function squaredDistance(/** @type {Outline} */ { points, closed }, x, y) {
  const n = points.length;
  let least = n === 2 ? (x - points[0]) ** 2 + (y - points[1]) ** 2 : Infinity;
  for (let b = closed ? 0 : 2; b < n; b += 2) {
    const a = b === 0 ? n - 2 : b - 2;
    const [dx, dy] = [points[b] - points[a], points[b + 1] - points[a + 1]];
    const [u, v] = [x - points[a], y - points[a + 1]];
    const size = dx * dx + dy * dy;
    const t = size > 0 ? Math.min(Math.max((u * dx + v * dy) / size, 0), 1) : 0;
    least = Math.min(least, (u - t * dx) ** 2 + (v - t * dy) ** 2);
  }
  return least;
}
