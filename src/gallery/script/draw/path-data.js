// Writes SVG path data.

/** A number rounded to significant digits, in its shortest form; 0 if it is not finite. */
export function dataNumber(/** @type {number} */ x, digits = 7) {
  return Number.isFinite(x) ? String(Number(x.toPrecision(digits))) : "0";
}

/** The number of grid steps per unit, a power of ten, for coordinates exact to 1e-4 of a size. */
export function roundingGrid(/** @type {number} */ size) {
  return 10 ** Math.min(Math.max(Math.ceil(4 - Math.log10(size)), -12), 12);
}

/**
 * Path data of a polyline [x0, y0, x1, y1, …], from point `first` up to, not with, `last`, interrupted at points that are not finite; empty
 * for fewer than two points. Numbers are rounded to 1 / `grid` if it is given, else to `digits`.
 * @param {Points} points
 */
export function polylineData(
  points,
  { first = 0, last = points.length / 2, closed = false, digits = 7, grid = 0 } = {},
) {
  // Rounding to a grid is many times quicker than to digits.
  const number = (/** @type {number} */ x) =>
    grid > 0 ? Math.round(x * grid) / grid : dataNumber(x, digits);
  let data = "";
  let run = 0;
  for (let k = first; k < last; k++) {
    const [x, y] = [points[2 * k], points[2 * k + 1]];
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      run = 0;
      continue;
    }
    data += `${run === 0 ? "M" : "L"}${number(x)} ${number(y)}`;
    run += 1;
  }
  return data === "" || !data.includes("L") ? "" : `${data}${closed && run > 2 ? "Z" : ""}`;
}

/**
 * Path data of an outline on the screen, in straight lines, with a number of decimals.
 * @param {Points} points @param {boolean} closed @param {Placement} placement
 */
export function placedData(points, closed, { scale, x, y }, decimals = 1) {
  let data = "";
  for (let k = 0; k < points.length; k += 2)
    data += `${k ? "L" : "M"}${(x + scale * points[k]).toFixed(decimals)} ${(y - scale * points[k + 1]).toFixed(decimals)}`;
  return closed ? `${data}Z` : data;
}

/**
 * Path data of the smooth curve through the points of an outline, in cubic Bézier curves. Points closer than `grain` to
 * the one before are left out, except the last.
 * @param {Points} points @param {boolean} closed @param {Placement} placement
 */
export function smoothData(points, closed, { scale, x, y }, decimals = 1, grain = 0.1) {
  /** @type {Point[]} */ const kept = [];
  for (let k = 0; k < points.length; k += 2) {
    const [atX, atY] = [x + scale * points[k], y - scale * points[k + 1]];
    const [lastX, lastY] = kept.at(-1) ?? [Infinity, Infinity];
    const isNear = Math.abs(atX - lastX) < grain && Math.abs(atY - lastY) < grain;
    if (!isNear || (k + 2 === points.length && !closed)) kept.push([atX, atY]);
  }
  const { length } = kept;
  /** @param {number} k */
  const at = (k) => kept[closed ? (k + length) % length : Math.min(Math.max(k, 0), length - 1)];
  /** @param {number[]} point */ const pair = ([px, py]) => `${px.toFixed(decimals)} ${py.toFixed(decimals)}`;
  if (length < 2) return "";
  const handles = kept.map((_, k) => handlesAt(at(k - 1), at(k), at(k + 1)));
  let data = `M${pair(kept[0])}`;
  for (let k = 1; k < length + (closed ? 1 : 0); k += 1)
    data += `C${pair(handles[k - 1][1])} ${pair(handles[k % length][0])} ${pair(at(k))}`;
  return closed ? `${data}Z` : data;
}

/** The Bézier handles before and after a point `b`, along the parabola through it and its neighbours, by chord lengths. */
function handlesAt(/** @type {Point} */ a, /** @type {Point} */ b, /** @type {Point} */ c) {
  const [ux, uy, vx, vy] = [b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]];
  let [before, after] = [Math.hypot(ux, uy), Math.hypot(vx, vy)];
  if (before === 0 || after === 0) return [b, b];
  /** @param {number} u @param {number} v */
  const slope = (u, v) => ((u * after) / before + (v * before) / after) / (before + after);
  const [x, y] = [slope(ux, vx), slope(uy, vy)];
  // Where the curve turns sharply, as at a cusp, a long chord says nothing of the end of the other one.
  const cosine = (ux * vx + uy * vy) / (before * after);
  if (cosine < 0.5) before = after = Math.min(before, after) * Math.min(1 + cosine, 1);
  return [-before / 3, after / 3].map((reach) => [b[0] + reach * x, b[1] + reach * y]);
}

/** Path data of a circle. @param {number} x @param {number} y @param {number} radius */
export function circleData(x, y, radius, digits = 7) {
  const [r, from, to] = [radius, x - radius, 2 * radius].map((n) => dataNumber(n, digits));
  return `M${from} ${dataNumber(y, digits)}a${r} ${r} 0 1 0 ${to} 0a${r} ${r} 0 1 0 -${to} 0Z`;
}

/** A number of pixels rounded to 1/100. */
export function pixel(/** @type {number} */ x) {
  return Math.round(x * 100) / 100;
}

/** Path data, or none if it has undefined coordinates: a joint may be undefined where its base vanishes. */
export function definedData(/** @type {string} */ data) {
  return data.includes("NaN") || data.includes("Infinity") ? "" : data;
}
