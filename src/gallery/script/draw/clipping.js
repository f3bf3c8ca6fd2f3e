// Clips polylines to a box: centrodes extend to infinity.

import { dataNumber } from "./path-data.js";

/** Path data of the part of a polyline [x, y, …] in a box [x0, y0, x1, y1]; it is interrupted at points that are not finite. */
export function clippedData(/** @type {Points} */ points, /** @type {Box} */ box, digits = 6) {
  const number = (/** @type {number} */ x) => dataNumber(x, digits);
  let data = "";
  let penX = NaN;
  let penY = NaN;
  for (let i = 0; i + 3 < points.length; i += 2) {
    const part = segmentInBox(points[i], points[i + 1], points[i + 2], points[i + 3], box);
    if (!part) continue;
    const [x0, y0, x1, y1] = part;
    if (x0 !== penX || y0 !== penY) data += `M${number(x0)} ${number(y0)}`;
    data += `L${number(x1)} ${number(y1)}`;
    [penX, penY] = [x1, y1];
  }
  return data;
}

/**
 * The part of a segment in a box, [x0, y0, x1, y1], by the algorithm of Liang and Barsky; null if there is none.
 * @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1
 */
export function segmentInBox(x0, y0, x1, y1, /** @type {Box} */ [left, low, right, high]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  if (!Number.isFinite(dx + dy)) return null;
  let [from, to] = [0, 1];
  const edges = [
    [-dx, x0 - left],
    [dx, right - x0],
    [-dy, y0 - low],
    [dy, high - y0],
  ];
  for (const [rate, distance] of edges) {
    if (rate === 0 && distance < 0) return null;
    if (rate === 0) continue;
    const at = distance / rate;
    if (rate < 0) from = Math.max(from, at);
    else to = Math.min(to, at);
  }
  if (from > to) return null;
  return [
    from === 0 ? x0 : x0 + from * dx,
    from === 0 ? y0 : y0 + from * dy,
    to === 1 ? x1 : x0 + to * dx,
    to === 1 ? y1 : y0 + to * dy,
  ];
}
