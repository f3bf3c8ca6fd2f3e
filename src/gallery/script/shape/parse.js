// Parses pasted points: CSV, JSON, numbers in lines, points.csv, SVG path data, or a whole SVG.

import { svgOutlines } from "./svg-outlines.js";
import { hasLength } from "./encode.js";
import { lengthOf, looksClosed } from "./outline.js";
import { subpathsOf } from "./svg-path.js";

/**
 * Parses the shape in a text: { points: flat array, y up, closed, said: a description of what was read }.
 *
 * @throws {Error} a sentence about what cannot be read
 */
export function parseShape(text) {
  const plain = text.trim();
  if (!plain) throw new Error("There is nothing to read.");
  const found = parserFor(plain)(plain);
  if (!hasLength(found.points)) throw new Error("Fewer than two different points could be read.");
  return found;
}

/** The parser for a text, by how it begins; SVG may be a fragment within other text. */
function parserFor(text) {
  if (/^[[{]/.test(text)) return parseJson;
  if (/<[a-z!?]/i.test(text)) return parseSvg;
  return /^m[\s,.\d+-]/i.test(text) ? parsePath : parseTable;
}

/** The longest of the outlines of an SVG; its coordinates point down. */
function parseSvg(text) {
  const outlines = svgOutlines(text);
  if (!outlines.length)
    throw new Error("The SVG draws no path, line, polygon, rectangle, circle or ellipse that could be read.");
  return longestShape(outlines);
}

function parsePath(data) {
  const outlines = subpathsOf(data);
  if (!outlines.length) throw new Error("The path data could not be read: it begins with M and a point.");
  return longestShape(outlines);
}

function longestShape(/** @type {Outline[]} */ outlines) {
  const length = (/** @type {Outline} */ { points, closed }) => lengthOf(points, closed);
  const longest = outlines.reduce((best, outline) => (length(outline) > length(best) ? outline : best));
  const several = outlines.length > 1 ? `, the longest of ${outlines.length} outlines` : "";
  return {
    points: longest.points.map((value, k) => (k % 2 ? -value : value)),
    closed: longest.closed || looksClosed(longest.points),
    said: `${longest.points.length / 2} points of SVG${several}`,
  };
}

function parseJson(text) {
  let value;
  try {
    value = JSON.parse(text);
  } catch {
    throw new Error("The JSON cannot be read.");
  }
  const points = pointsWithin(value);
  if (!points)
    throw new Error(
      'The JSON has no list of points: [[x, y], …], [{ "x": …, "y": … }, …] or [x, y, x, y, …].',
    );
  const closed = typeof value.closed === "boolean" ? value.closed : looksClosed(points);
  return { points, closed, said: `${points.length / 2} points of JSON` };
}

/** The first list of points in a JSON value, found by a depth-first search, or null. */
function pointsWithin(value) {
  if (Array.isArray(value)) {
    const isPair = (one) => Array.isArray(one) && one.length >= 2 && one.slice(0, 2).every(Number.isFinite);
    const isPoint = (one) => Number.isFinite(one?.x) && Number.isFinite(one?.y);
    if (value.length > 1 && value.every(isPair))
      return Float64Array.from(value.flatMap((one) => one.slice(0, 2)));
    if (value.length > 1 && value.every(isPoint))
      return Float64Array.from(value.flatMap(({ x, y }) => [x, y]));
    if (value.length > 3 && value.every(Number.isFinite))
      return Float64Array.from(value.slice(0, 2 * Math.floor(value.length / 2)));
  }
  if (value === null || typeof value !== "object") return null;
  if (Array.isArray(value.x) && Array.isArray(value.y))
    return Float64Array.from(value.x.flatMap((x, k) => [x, value.y[k] ?? NaN]));
  for (const one of Object.values(value)) {
    const points = pointsWithin(one);
    if (points) return points;
  }
  return null;
}

/** Parses numbers in lines: two columns, or those headed x and y; of several curves the first. */
function parseTable(text) {
  const lines = text
    .split(/\r?\n/)
    .map((line) => line.replace(/#.*$/, "").trim())
    .filter(Boolean);
  const cut = lineSplitter(lines);
  let rows = lines.map(cut);
  const isHead = (row) => row.some((word) => word !== "" && Number.isNaN(Number(word)));
  const head = isHead(rows[0]) ? rows[0].map((word) => word.replace(/^"|"$/g, "").toLowerCase()) : null;
  rows = rows
    .filter((row) => !isHead(row))
    .map((row) => row.map((word) => (word === "" ? NaN : Number(word))));
  if (!head && rows.length <= 2 && rows.flat().length > 4) return shapeOfList(rows.flat());
  const [x, y] =
    head && head.includes("x") && head.includes("y") ? [head.indexOf("x"), head.indexOf("y")] : [0, 1];
  const { kept, curves } = firstCurve(rows, head);
  const points = Float64Array.from(kept.flatMap((row) => [row[x], row[y]]).map((value) => value ?? NaN));
  const finite = points.filter(
    (_, k) => Number.isFinite(points[k - (k % 2)]) && Number.isFinite(points[k - (k % 2) + 1]),
  );
  const first = curves > 1 ? `, the first of ${curves} curves` : "";
  return {
    points: finite,
    closed: finite.length >= 4 && looksClosed(finite),
    said: `${finite.length / 2} points${first}`,
  };
}

function shapeOfList(numbers) {
  const points = Float64Array.from(
    numbers.slice(0, 2 * Math.floor(numbers.length / 2)).filter(Number.isFinite),
  );
  return { points, closed: looksClosed(points), said: `${points.length / 2} points` };
}

/**
 * The function that splits a line into words: at semicolons (numbers may have decimal commas), commas or
 * blanks.
 */
function lineSplitter(lines) {
  const most = lines.slice(0, 20).join("\n");
  if (most.includes(";")) return (line) => line.split(";").map((word) => word.trim().replace(",", "."));
  if (lines.slice(0, 20).every((line) => line.includes("\t")))
    return (line) => line.split("\t").map((word) => word.trim());
  // "1,2 3,4" are two points in a line; "1, 2" is one.
  if (most.includes(",")) return (line) => line.split(/\s*,\s*|\s+/).map((word) => word.trim());
  return (line) => line.split(/\s+/);
}

/** The rows of the first curve of a points.csv: those of one cell, trace and circuit. */
function firstCurve(rows, head) {
  const keys = ["cell", "trace", "circuit"].map((name) => head?.indexOf(name) ?? -1).filter((at) => at >= 0);
  if (!keys.length || !rows.length) return { kept: rows, curves: 1 };
  const keyOf = (row) => keys.map((at) => row[at]).join(".");
  return { kept: rows.filter((row) => keyOf(row) === keyOf(rows[0])), curves: new Set(rows.map(keyOf)).size };
}
