// Writes SVG path data.

/** A number rounded to significant digits, in its shortest form; 0 if it is not finite. */
export function dataNumber(x, digits = 7) {
  return Number.isFinite(x) ? String(Number(x.toPrecision(digits))) : "0";
}

/**
 * The number of grid steps per unit, a power of ten, for coordinates exact to 1e-4 of a size.
 */
export function roundingGrid(size) {
  return 10 ** Math.min(Math.max(Math.ceil(4 - Math.log10(size)), -12), 12);
}

/**
 * Path data of a polyline [x0, y0, x1, y1, …], from point `first` up to, not with, `last`, interrupted at
 * points that are not finite; empty for fewer than two points. Numbers are rounded to 1 / `grid` if it is
 * given, else to `digits`.
 * @param {Points} points
 */
export function polylineData(
  points,
  { first = 0, last = points.length / 2, closed = false, digits = 7, grid = 0 } = {},
) {
  // Rounding to a grid is many times quicker than to digits.
  const number = grid > 0 ? (x) => Math.round(x * grid) / grid : (x) => dataNumber(x, digits);
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
 * Path data of an outline on the screen, with a number of decimals; points closer than `grain` to the one before
 * are left out, except the first and the last.
 * @param {Points} points @param {boolean} closed @param {Placement} placement
 */
export function placedData(points, closed, { scale, x, y }, decimals = 1, grain = 0) {
  let [lastX, lastY] = [Infinity, Infinity];
  let data = "";
  for (let k = 0; k < points.length; k += 2) {
    const [atX, atY] = [x + scale * points[k], y - scale * points[k + 1]];
    if (Math.abs(atX - lastX) < grain && Math.abs(atY - lastY) < grain && k + 2 < points.length) continue;
    data += `${data ? "L" : "M"}${atX.toFixed(decimals)} ${atY.toFixed(decimals)}`;
    [lastX, lastY] = [atX, atY];
  }
  return closed ? `${data}Z` : data;
}

/** Path data of a circle. */
export function circleData(x, y, radius, digits = 7) {
  const [r, from, to] = [radius, x - radius, 2 * radius].map((n) => dataNumber(n, digits));
  return `M${from} ${dataNumber(y, digits)}a${r} ${r} 0 1 0 ${to} 0a${r} ${r} 0 1 0 -${to} 0Z`;
}

/** A number of pixels rounded to 1/100. */
export function pixel(x) {
  return Math.round(x * 100) / 100;
}

/** Path data, or none if it has undefined coordinates: a joint may be undefined where its base vanishes. */
export function definedData(data) {
  return data.includes("NaN") || data.includes("Infinity") ? "" : data;
}
