// Extracts the outlines drawn by an SVG document or fragment, with all transforms applied.

import { parseMarkup } from "./markup.js";
import { subpathsOf } from "./svg-path.js";
import {
  parseNumbers,
  matrixOfTransform,
  matrixProduct,
  transformPoints,
  IDENTITY_MATRIX,
} from "./svg-transform.js";

// The contents of these are drawn elsewhere, if at all.
const UNDRAWN = new Set(
  "defs symbol clippath mask marker pattern lineargradient radialgradient filter metadata".split(" "),
);
// These contain no outlines, but their text may look like some.
const WORDS = new Set("title desc style script text foreignobject".split(" "));
const USED_WITHIN_USED = 12;
// CSS pixels to a unit of length.
const UNITS = { "": 1, px: 1, in: 96, cm: 96 / 2.54, mm: 96 / 25.4, q: 96 / 101.6, pt: 4 / 3, pc: 16 };

/**
 * The outlines drawn by SVG markup, [{ points: flat array, closed }], y down as in SVG, in the units of its
 * outermost element: paths, polylines, polygons, lines, rectangles, circles and ellipses, and their copies by
 * `use`. A `viewBox` is ignored: it changes only the size.
 *
 * @throws {Error} a sentence about what cannot be read
 */
export function svgOutlines(text) {
  // A style sheet would override the attributes.
  for (const [, sheet] of text.matchAll(/<style\b[^>]*>([\s\S]*?)<\/style/gi))
    if (/(?:^|[;{\s/])transform\s*:/i.test(sheet))
      throw new Error("A transform in a sheet of styles is not read: write it as an attribute.");
  const root = parseMarkup(text);
  const byId = new Map();
  indexById(root, byId);
  return outlinesWithin(root, IDENTITY_MATRIX, { byId, used: 0 });
}

function indexById(element, byId) {
  const id = element.attributes.get("id");
  if (id !== undefined && !byId.has(id)) byId.set(id, element);
  for (const child of element.children) indexById(child, byId);
}

function outlinesWithin(element, matrix, drawing) {
  if (WORDS.has(element.name) || UNDRAWN.has(element.name)) return [];
  return outlinesOfElement(element, matrix, drawing);
}

/** The outlines of an element that is drawn directly or by `use`. */
function outlinesOfElement(element, outer, drawing) {
  if (isHidden(element)) return [];
  const matrix = matrixProduct(outer, ownMatrix(element));
  const data = Object.hasOwn(SHAPE_DATA, element.name) ? SHAPE_DATA[element.name](element) : "";
  const own = subpathsOf(data ?? "").map(({ points, closed }) => ({
    points: transformPoints(matrix, points),
    closed,
  }));
  const used = element.name === "use" ? usedOutlines(element, matrix, drawing) : [];
  return [...own, ...used, ...element.children.flatMap((child) => outlinesWithin(child, matrix, drawing))];
}

function ownMatrix({ name, attributes }) {
  if (/(?:^|[;\s])(?:transform|rotate|scale|translate)\s*:/i.test(attributes.get("style") ?? ""))
    throw new Error("A transform in the style of an element is not read: write it as its attribute.");
  if (attributes.has("transform-origin"))
    throw new Error("A transform-origin is not read: write it into the transform.");
  if (name === "svg" && attributes.has("viewBox") && /none/.test(attributes.get("preserveAspectRatio") ?? ""))
    throw new Error("A drawing that is stretched (preserveAspectRatio none) is not read.");
  return matrixOfTransform(attributes.get("transform") ?? "");
}

function usedOutlines(element, matrix, { byId, used }) {
  const name = element.attributes.get("href") ?? element.attributes.get("xlink:href") ?? "";
  const there = name.startsWith("#") ? byId.get(name.slice(1)) : undefined;
  if (!there) throw new Error(`The element that is used as “${name}” is not in the drawing.`);
  if (used >= USED_WITHIN_USED) throw new Error(`The element “${name}” uses itself.`);
  const [x, y] = ["x", "y"].map((word) => attributeLength(element, word, 0));
  return outlinesOfElement(there, matrixProduct(matrix, [1, 0, 0, 1, x, y]), { byId, used: used + 1 });
}

function isHidden({ attributes }) {
  const style = attributes.get("style") ?? "";
  return attributes.get("display") === "none" || /(?:^|[;\s])display\s*:\s*none/i.test(style);
}

/** The path data of each kind of SVG shape; empty for a shape that is not drawn. */
const SHAPE_DATA = {
  path: ({ attributes }) => attributes.get("d") ?? "",
  polyline: (element) => polygonData(element, ""),
  polygon: (element) => polygonData(element, "Z"),
  line: (element) => {
    const [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map((word) => attributeLength(element, word, 0));
    return `M${x1},${y1}L${x2},${y2}`;
  },
  rect: (element) => rectangleData(element),
  circle: (element) => {
    const r = attributeLength(element, "r", 0);
    return ellipseData(element, r, r);
  },
  ellipse: (element) => {
    const rx = attributeLength(element, "rx", null);
    const ry = attributeLength(element, "ry", null);
    return ellipseData(element, rx ?? ry ?? 0, ry ?? rx ?? 0);
  },
};

function polygonData({ name, attributes }, end) {
  const numbers = parseNumbers(attributes.get("points") ?? "");
  if (!numbers) throw new Error(`The points of a ${name} cannot be read.`);
  const whole = numbers.slice(0, 2 * Math.floor(numbers.length / 2));
  return whole.length >= 4 ? `M${whole.join(" ")}${end}` : "";
}

/** Path data of an ellipse in four arcs, starting at the greatest x, as in SVG. */
function ellipseData(element, rx, ry) {
  const [cx, cy] = ["cx", "cy"].map((word) => attributeLength(element, word, 0));
  if (!(rx > 0 && ry > 0)) return "";
  const ends = [
    [cx, cy + ry],
    [cx - rx, cy],
    [cx, cy - ry],
    [cx + rx, cy],
  ];
  return `M${cx + rx},${cy}${ends.map((end) => `A${rx} ${ry} 0 0 1 ${end}`).join("")}Z`;
}

function rectangleData(element) {
  const [x, y, width, height] = ["x", "y", "width", "height"].map((word) =>
    attributeLength(element, word, 0),
  );
  const [givenX, givenY] = ["rx", "ry"].map((word) => attributeLength(element, word, null));
  const rx = Math.min(Math.max(givenX ?? givenY ?? 0, 0), width / 2);
  const ry = Math.min(Math.max(givenY ?? givenX ?? 0, 0), height / 2);
  if (!(width > 0 && height > 0)) return "";
  if (!(rx > 0 && ry > 0)) return `M${x},${y}h${width}v${height}h${-width}Z`;
  const round = (toX, toY) => `a${rx} ${ry} 0 0 1 ${toX},${toY}`;
  const [across, down] = [width - 2 * rx, height - 2 * ry];
  const top = `M${x + rx},${y}h${across}${round(rx, ry)}v${down}${round(-rx, ry)}`;
  return `${top}h${-across}${round(-rx, -ry)}v${-down}${round(rx, -ry)}Z`;
}

/** A length of an element, in pixels; `otherwise` if it is missing or "auto". */
function attributeLength({ name, attributes }, word, otherwise) {
  const text = (attributes.get(word) ?? "").trim().toLowerCase();
  if (text === "" || text === "auto") return otherwise;
  const [, number, unit] = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)([a-z%]*)$/.exec(text) ?? [];
  if (number === undefined || !Object.hasOwn(UNITS, unit))
    throw new Error(`The length ${word} = “${text.slice(0, 30)}” of a ${name} cannot be read.`);
  return Number(number) * UNITS[unit];
}
