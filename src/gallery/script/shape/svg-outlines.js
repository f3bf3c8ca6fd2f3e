// Extracts the outlines drawn by an SVG document or fragment, with all transforms applied.

import { parseMarkup } from "./markup.js";
import { subpathsOf } from "./svg-path.js";

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

function indexById(/** @type {Markup} */ element, byId) {
  const id = element.attributes.get("id");
  if (id !== undefined && !byId.has(id)) byId.set(id, element);
  for (const child of element.children) indexById(child, byId);
}

function outlinesWithin(/** @type {Markup} */ element, /** @type {Matrix} */ matrix, drawing) {
  if (WORDS.has(element.name) || UNDRAWN.has(element.name)) return [];
  return outlinesOfElement(element, matrix, drawing);
}

/** The outlines of an element that is drawn directly or by `use`. */
function outlinesOfElement(/** @type {Markup} */ element, /** @type {Matrix} */ outer, drawing) {
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

function ownMatrix(/** @type {Markup} */ { name, attributes }) {
  if (/(?:^|[;\s])(?:transform|rotate|scale|translate)\s*:/i.test(attributes.get("style") ?? ""))
    throw new Error("A transform in the style of an element is not read: write it as its attribute.");
  if (attributes.has("transform-origin"))
    throw new Error("A transform-origin is not read: write it into the transform.");
  if (name === "svg" && attributes.has("viewBox") && /none/.test(attributes.get("preserveAspectRatio") ?? ""))
    throw new Error("A drawing that is stretched (preserveAspectRatio none) is not read.");
  return matrixOfTransform(attributes.get("transform") ?? "");
}

function usedOutlines(/** @type {Markup} */ element, /** @type {Matrix} */ matrix, { byId, used }) {
  const name = element.attributes.get("href") ?? element.attributes.get("xlink:href") ?? "";
  const there = name.startsWith("#") ? byId.get(name.slice(1)) : undefined;
  if (!there) throw new Error(`The element that is used as “${name}” is not in the drawing.`);
  if (used >= USED_WITHIN_USED) throw new Error(`The element “${name}” uses itself.`);
  const [x, y] = ["x", "y"].map((word) => attributeLength(element, word, 0));
  return outlinesOfElement(there, matrixProduct(matrix, [1, 0, 0, 1, x, y]), { byId, used: used + 1 });
}

function isHidden(/** @type {Markup} */ { attributes }) {
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

function polygonData(/** @type {Markup} */ { name, attributes }, end) {
  const numbers = parseNumbers(attributes.get("points") ?? "");
  if (!numbers) throw new Error(`The points of a ${name} cannot be read.`);
  const whole = numbers.slice(0, 2 * Math.floor(numbers.length / 2));
  return whole.length >= 4 ? `M${whole.join(" ")}${end}` : "";
}

/** Path data of an ellipse in four arcs, starting at the greatest x, as in SVG. @param {Markup} element */
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

function rectangleData(/** @type {Markup} */ element) {
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

/** A length of an element, in pixels; `otherwise` if it is missing or "auto". @param {Markup} _ */
function attributeLength({ name, attributes }, word, otherwise) {
  const text = (attributes.get(word) ?? "").trim().toLowerCase();
  if (text === "" || text === "auto") return otherwise;
  const [, number, unit] = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)([a-z%]*)$/.exec(text) ?? [];
  if (number === undefined || !Object.hasOwn(UNITS, unit))
    throw new Error(`The length ${word} = “${text.slice(0, 30)}” of a ${name} cannot be read.`);
  return Number(number) * UNITS[unit];
}

/** @type {Matrix} */
export const IDENTITY_MATRIX = [1, 0, 0, 1, 0, 0];

/** The product of two matrices, which applies the second, then the first. @returns {Matrix} */
export function matrixProduct(
  /** @type {Matrix} */ [a, b, c, d, e, f],
  /** @type {Matrix} */ [p, q, r, s, t, u],
) {
  return [a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f];
}

/** A flat array of points transformed by a matrix. */
export function transformPoints(
  /** @type {Matrix} */ [a, b, c, d, e, f],
  /** @type {Float64Array} */ points,
) {
  return points.map((value, k) =>
    k % 2 ? b * points[k - 1] + d * value + f : a * value + c * points[k + 1] + e,
  );
}

/**
 * The matrix of each kind of transform from its numbers; null if they are too few or too many.
 * @type {Record<string, (numbers: number[]) => Matrix | null>}
 */
const TRANSFORMS = {
  matrix: ([a, b, c, d, e, f, ...more]) => (f === undefined || more.length ? null : [a, b, c, d, e, f]),
  translate: ([x, y = 0, ...more]) => (more.length ? null : [1, 0, 0, 1, x, y]),
  scale: ([x, y = x, ...more]) => (more.length ? null : [x, 0, 0, y, 0, 0]),
  rotate: (numbers) => {
    const [angle, x = 0, y = 0] = numbers;
    if (![1, 3].includes(numbers.length)) return null;
    // Quarter turns have exact zeros.
    const round = (part) => (angle % 90 === 0 ? Math.round(part) : part);
    const [cos, sin] = [round(Math.cos(radiansOf(angle))), round(Math.sin(radiansOf(angle)))];
    return [cos, sin, -sin, cos, x - cos * x + sin * y, y - sin * x - cos * y];
  },
  skewX: ([angle, ...more]) => (more.length ? null : [1, 0, Math.tan(radiansOf(angle)), 1, 0, 0]),
  skewY: ([angle, ...more]) => (more.length ? null : [1, Math.tan(radiansOf(angle)), 0, 1, 0, 0]),
};

function radiansOf(deg) {
  return deg * (Math.PI / 180);
}

/**
 * The matrix of a list of transforms, of which the last is applied first.
 *
 * @throws {Error} a sentence, if the text is not such a list
 */
export function matrixOfTransform(text) {
  const list = text.trim();
  const refused = () => new Error(`The transform “${list.slice(0, 60)}” cannot be read.`);
  if (list === "" || list === "none") return IDENTITY_MATRIX;
  let matrix = IDENTITY_MATRIX;
  let rest = list;
  while (rest) {
    const found = /^(\w+)\s*\(([^()]*)\)[\s,]*/.exec(rest);
    const numbers = found && parseNumbers(found[2]);
    const isKnown = found && Object.hasOwn(TRANSFORMS, found[1]);
    const next = isKnown && numbers?.length ? TRANSFORMS[found[1]](numbers) : null;
    if (!found || !next || !next.every(Number.isFinite)) throw refused();
    matrix = matrixProduct(matrix, next);
    rest = rest.slice(found[0].length);
  }
  return matrix;
}

/** The numbers of a list separated by commas, blanks or signs; null if there is anything else. */
export function parseNumbers(text) {
  const number = /[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?/gi;
  if (/[^\s,]/.test(text.replace(number, " "))) return null;
  return (text.match(number) ?? []).map(Number);
}
