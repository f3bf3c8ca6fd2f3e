// Overlaid curves, distinguished by colour, dash pattern and letter.

import { s } from "../dom.js";
import { viewOfOutlines, outlineData } from "../shape/match-picture.js";

const OVER_WIDE = 720;
const OVER_LOW = 240;
const OVER_HIGH = 540;
// The margin of the picture and the distance of letters from their curves, in picture pixels: a letter fits
// on either side of a curve.
const OVER_INSET = 34;
const LETTER_AWAY = 16;
const FINE_DECIMALS = 3;
// The frame of each curve side by side, in picture pixels.
const SIDE_WIDE = 300;
const SIDE_HIGH = 220;
const SIDE_INSET = 8;

/** The letter of the k-th curve, from 0. */
export function letterOf(k) {
  return String.fromCharCode(65 + k);
}

/** The class of the k-th curve's line, which sets its colour and dash pattern. */
function strokeClass(k) {
  return `compared ink-${(k % 5) + 1} dash-${k % 6}`;
}

/**
 * A picture of overlaid outlines, [{ points, closed }], each with its letter: { element, scale, redraw(k,
 * points) }. `scale` is in picture pixels per unit of length; `redraw` replaces the points of an outline by
 * finer ones.
 */
export function overlaidPicture(outlines, label) {
  const all = outlines.map(({ points }) => points);
  const high = heightFor(all);
  const view = viewOfOutlines(all, OVER_WIDE, high, OVER_INSET);
  const paths = outlines.map(({ points, closed }, k) =>
    s("path", { class: strokeClass(k), d: outlineData(points, closed, view) }),
  );
  const element = s(
    "svg",
    { class: "thumbnail over", viewBox: `0 0 ${OVER_WIDE} ${high}`, role: "img", "aria-label": label },
    paths,
    outlines.map((outline, k) => letterLabel(outline, k, outlines.length, view)),
  );
  const redraw = (k, points) =>
    paths[k].setAttribute("d", outlineData(points, outlines[k].closed, view, FINE_DECIMALS));
  return { element, scale: view.scale, redraw };
}

/**
 * Pictures of outlines, [{ points, closed }], side by side. All frames show the same part of the plane, so
 * that aligned curves appear at the same position and size. { elements, scale, redraw } as for
 * overlaidPicture.
 */
export function sideBySidePictures(outlines) {
  const all = outlines.map(({ points }) => points);
  const view = viewOfOutlines(all, SIDE_WIDE, SIDE_HIGH, SIDE_INSET);
  const paths = outlines.map(({ points, closed }) => s("path", { d: outlineData(points, closed, view) }));
  const elements = paths.map((path) =>
    s("svg", { class: "thumbnail", viewBox: `0 0 ${SIDE_WIDE} ${SIDE_HIGH}`, "aria-hidden": "true" }, path),
  );
  const redraw = (k, points) =>
    paths[k].setAttribute("d", outlineData(points, outlines[k].closed, view, FINE_DECIMALS));
  return { elements, scale: view.scale, redraw };
}

/**
 * The letter of the k-th of `count` outlines, next to its line, on the side away from the outline's centre.
 */
function letterLabel({ points, closed }, k, count, view) {
  const places = points.length / 2;
  // Letters are spread along overlaid curves, and away from the ends of open ones.
  const part = (k + 0.5) / count;
  const at = Math.floor((closed ? part : 0.1 + 0.8 * part) * places);
  const seen = (index) => {
    const place = 2 * Math.min(Math.max(index, 0), places - 1);
    return [view.x + view.scale * points[place], view.y - view.scale * points[place + 1]];
  };
  const [[x, y], [x0, y0], [x1, y1]] = [seen(at), seen(at - 1), seen(at + 1)];
  const length = Math.hypot(x1 - x0, y1 - y0);
  const [across, down] = length > 0 ? [(y1 - y0) / length, (x0 - x1) / length] : [0, -1];
  const [middleX, middleY] = meanPixel(points, view);
  const away = (x - middleX) * across + (y - middleY) * down < 0 ? -LETTER_AWAY : LETTER_AWAY;
  const place = { x: (x + away * across).toFixed(1), y: (y + away * down).toFixed(1) };
  return s("text", { class: `letter ink-${(k % 5) + 1}`, ...place, dy: "0.35em" }, letterOf(k));
}

function meanPixel(points, { scale, x, y }) {
  const mean = (part) => {
    let sum = 0;
    for (let k = part; k < points.length; k += 2) sum += points[k];
    return sum / (points.length / 2);
  };
  return [x + scale * mean(0), y - scale * mean(1)];
}

/** The height that the outlines need at full width, within bounds. */
function heightFor(outlines) {
  const side = (part) => {
    const values = outlines.flatMap((points) => Array.from(points).filter((_, k) => k % 2 === part));
    return (
      values.reduce((most, value) => Math.max(most, value), -Infinity) -
      values.reduce((least, value) => Math.min(least, value), Infinity)
    );
  };
  const height = ((OVER_WIDE - 2 * OVER_INSET) * side(1)) / (side(0) || 1) + 2 * OVER_INSET;
  return Math.round(Math.min(Math.max(height, OVER_LOW), OVER_HIGH));
}

/** A short sample of the k-th curve's line. */
export function strokeSample(k) {
  return s(
    "svg",
    { class: "thumbnail sample", width: 44, height: 12, "aria-hidden": "true" },
    s("path", { class: strokeClass(k), d: "M2 6H42" }),
  );
}
