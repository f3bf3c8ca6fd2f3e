// Recognizes paths that are circles or circular arcs.

import { roundToPlaces } from "./digits.js";

// The largest distance of a point from the circle, relative to its radius.
const OFF_CIRCLE = 1e-9;
// A larger arc, relative to the path's extent, is drawn as a polyline.
const LARGEST_CIRCLE = 1e4;
// Fewer points may lie on a circle by chance.
const FEWEST_ON_CIRCLE = 12;

/**
 * The circle that contains all points of a path and some further points, all { x, y }: { x, y, radius, arc:
 * [from, to] in degrees counter-clockwise, or null for a full circle }; null if there is none. The path may
 * go back and forth on it.
 */
export function circleOfPath(path, further) {
  if (path.length + further.length < FEWEST_ON_CIRCLE) return null;
  const circle = circleThrough(path);
  if (!circle) return null;
  const { x, y, radius } = circle;
  const isOn = (p) =>
    Math.abs(Math.sqrt((p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)) - radius) <= OFF_CIRCLE * radius;
  if (radius > LARGEST_CIRCLE * extentOfPath(path) || !path.every(isOn) || !further.every(isOn)) return null;
  let angle = 0;
  let [least, most] = [
    { angle, at: path[0] },
    { angle, at: path[0] },
  ];
  for (let k = 1; k < path.length; k++) {
    const [ax, ay, bx, by] = [path[k - 1].x - x, path[k - 1].y - y, path[k].x - x, path[k].y - y];
    angle += Math.atan2(ax * by - ay * bx, ax * bx + ay * by);
    if (angle < least.angle) least = { angle, at: path[k] };
    if (angle > most.angle) most = { angle, at: path[k] };
  }
  const isWhole = ((most.angle - least.angle) * 180) / Math.PI >= 360 * (1 - OFF_CIRCLE);
  const arc = isWhole ? null : [least, most].map(({ at }) => directionDeg(at.x - x, at.y - y));
  // Further digits are not significant.
  const places = 12 - Math.ceil(Math.log10(radius));
  const rounded = (value) => roundToPlaces(value, places);
  return { x: rounded(x), y: rounded(y), radius: rounded(radius), arc };
}

/** The longer side of the bounding box of points { x, y }. */
export function extentOfPath(points) {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const { x, y } of points) {
    [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
  }
  return points.length > 0 ? Math.max(x1 - x0, y1 - y0) : 0;
}

// The circle through the first point, the point furthest from it, and the point furthest from their line.
function circleThrough(path) {
  const a = path[0];
  // Of equally distant points, the last.
  const furthest = (value) => path.reduce((best, p) => (value(p) >= value(best) ? p : best));
  const b = furthest((p) => (p.x - a.x) * (p.x - a.x) + (p.y - a.y) * (p.y - a.y));
  const [abx, aby] = [b.x - a.x, b.y - a.y];
  const area = (p) => Math.abs(abx * (p.y - a.y) - aby * (p.x - a.x));
  const c = furthest(area);
  const [acx, acy] = [c.x - a.x, c.y - a.y];
  const twice = 2 * (abx * acy - aby * acx);
  const [b2, c2] = [abx * abx + aby * aby, acx * acx + acy * acy];
  const [x, y] = [(acy * b2 - aby * c2) / twice, (abx * c2 - acx * b2) / twice];
  const radius = Math.sqrt(x * x + y * y);
  return Number.isFinite(radius) && radius > 0 ? { x: a.x + x, y: a.y + y, radius } : null;
}

// A direction in degrees from 0 up to 360, to nine decimal places.
function directionDeg(x, y) {
  const deg = roundToPlaces((Math.atan2(y, x) * 180) / Math.PI, 9);
  return roundToPlaces(deg < 0 ? deg + 360 : deg, 9);
}
