// Overlaid curves, distinguished by colour, dash pattern and letter.

import { placedData, smoothData } from "../../draw/path-data.js";
import { boxOfPoints, screenPoint, transformed } from "../../draw/plane-view.js";
import { nextTurn, s, thumbnailFrame } from "../dom.js";
import { viewOfOutlines } from "../shape/match-item.js";
import { solveCurve } from "../curve-reading.js";

const OVER_WIDE = 720;
const OVER_LOW = 240;
const OVER_HIGH = 540;
// The margin of the picture and the distance of letters from their curves, in picture pixels: a letter fits on either side of a curve.
const OVER_INSET = 34;
const LETTER_AWAY = 16;
const FINE_DECIMALS = 3;
// The frame of each curve side by side, in picture pixels.
const SIDE_SIZE = { width: 300, height: 220 };
const SIDE_INSET = 8;

/** The letter of the k-th curve, from 0. */
export function letterOf(/** @type {number} */ k) {
  return String.fromCharCode(65 + k);
}

/** The class of the k-th curve's line, which sets its colour and dash pattern. */
function strokeClass(/** @type {number} */ k) {
  return `compared ink-${(k % 5) + 1} dash-${k % 6}`;
}

/** The lines of outlines in a view; `redraw(k, points)` replaces one by a finer one. @param {Outline[]} outlines */
function linesOf(outlines, /** @type {Placement} */ view, isOver = false) {
  const lines = outlines.map(({ points, closed }, k) =>
    s("path", { class: isOver && strokeClass(k), d: smoothData(points, closed, view) }),
  );
  const redraw = (/** @type {number} */ k, /** @type {Points} */ points) =>
    lines[k].setAttribute("d", placedData(points, outlines[k].closed, view, FINE_DECIMALS));
  return { lines, redraw, scale: view.scale };
}

/**
 * A picture of overlaid outlines, each with its letter. `scale` is in picture pixels per unit of length.
 * @param {Outline[]} outlines @param {string} label @returns {ComparedPicture}
 */
export function overlaidPicture(outlines, label) {
  const all = outlines.map(({ points }) => points);
  const high = heightFor(all);
  const view = viewOfOutlines(all, { width: OVER_WIDE, height: high }, OVER_INSET);
  const { lines, ...drawn } = linesOf(outlines, view, true);
  const letters = outlines.map((outline, k) => letterLabel(outline, k, outlines.length, view));
  const attributes = { viewBox: `0 0 ${OVER_WIDE} ${high}`, role: "img", "aria-label": label };
  return { element: s("svg.thumbnail.over", attributes, lines, letters), ...drawn };
}

/**
 * Pictures of outlines side by side. All frames show the same part of the plane, so that aligned curves appear at
 * the same position and size.
 * @param {Outline[]} outlines @returns {ComparedPicture}
 */
export function sideBySidePictures(outlines) {
  const all = outlines.map(({ points }) => points);
  const { lines, ...drawn } = linesOf(outlines, viewOfOutlines(all, SIDE_SIZE, SIDE_INSET));
  return { elements: lines.map((line) => thumbnailFrame("", SIDE_SIZE, line)), ...drawn };
}

/** The letter of the k-th of `count` outlines, next to its line, on the side away from the outline's centre. @param {number} k @param {number} count */
function letterLabel(/** @type {Outline} */ { points, closed }, k, count, /** @type {Placement} */ view) {
  const places = points.length / 2;
  // Letters are spread along overlaid curves, and away from the ends of open ones.
  const part = (k + 0.5) / count;
  const at = Math.floor((closed ? part : 0.1 + 0.8 * part) * places);
  const seen = (/** @type {number} */ index) => {
    const place = 2 * Math.min(Math.max(index, 0), places - 1);
    return screenPoint(view, [points[place], points[place + 1]]);
  };
  const [[x, y], [x0, y0], [x1, y1]] = [seen(at), seen(at - 1), seen(at + 1)];
  const length = Math.hypot(x1 - x0, y1 - y0);
  const [across, down] = length > 0 ? [(y1 - y0) / length, (x0 - x1) / length] : [0, -1];
  const [middleX, middleY] = meanPixel(points, view);
  const away = (x - middleX) * across + (y - middleY) * down < 0 ? -LETTER_AWAY : LETTER_AWAY;
  const place = { x: (x + away * across).toFixed(1), y: (y + away * down).toFixed(1) };
  return s("text", { class: `letter ink-${(k % 5) + 1}`, ...place, dy: "0.35em" }, letterOf(k));
}

function meanPixel(/** @type {Points} */ points, /** @type {Placement} */ view) {
  const mean = [0, 0];
  for (let k = 0; k < points.length; k += 1) mean[k % 2] += (2 * points[k]) / points.length;
  return screenPoint(view, [mean[0], mean[1]]);
}

/** The height that the outlines need at full width, within bounds. */
function heightFor(/** @type {Points[]} */ outlines) {
  const [x0, y0, x1, y1] = boxOfPoints(...outlines);
  const height = ((OVER_WIDE - 2 * OVER_INSET) * (y1 - y0)) / (x1 - x0 || 1) + 2 * OVER_INSET;
  return Math.round(Math.min(Math.max(height, OVER_LOW), OVER_HIGH));
}

/** A short sample of the k-th curve's line. */
export function strokeSample(/** @type {number} */ k) {
  const line = s("path", { class: strokeClass(k), d: "M2 6H42" });
  return s("svg.thumbnail.sample", { width: 44, height: 12, "aria-hidden": "true" }, line);
}

// The chord error of a curve, in picture pixels.
const REFINED_ERROR = 0.05;

/**
 * Redraws the curves of a picture (overlaidPicture) one after another as they are solved, without blocking the page. `curves` are those of
 * loadComparedCurve(), `aligned` the results of alignCurve(). Without the kernel, the stored points remain.
 * @param {Kernel | null} kernel @param {ComparedCurve[]} curves @param {{ similarity: Similarity }[]} aligned @param {ComparedPicture} picture @param {AbortSignal} signal
 */
export async function refinePicture(kernel, picture, curves, aligned, signal) {
  for (const [k, { family, curve, requested, shown }] of curves.entries()) {
    await nextTurn();
    if (signal.aborted || !kernel) return;
    const { similarity } = aligned[k];
    const enlarged = picture.scale * Math.hypot(similarity.re, similarity.im);
    const solved = solveCurve(kernel, requested ?? kernel.curve(family, curve), shown);
    const points = solved?.path(REFINED_ERROR / enlarged);
    solved?.close();
    if (points) picture.redraw(k, transformed(similarity, points));
  }
}
