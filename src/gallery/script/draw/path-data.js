// Path data of SVG, made from numbers.

/** A number in so many significant digits, as short as it can be written; 0 where it is not finite. */
export function dataNumber(x, digits = 7) {
  return Number.isFinite(x) ? String(Number(x.toPrecision(digits))) : "0";
}

/**
 * The power of ten by which numbers of a size are multiplied to be whole where they are good to 1e-4 of it.
 */
export function gridOfSize(size) {
  return 10 ** Math.min(Math.max(Math.ceil(4 - Math.log10(size)), -12), 12);
}

/**
 * Path data of a polyline [x0, y0, x1, y1, …], from point `first` up to, not with, `last`; points that are
 * not finite part it. Empty of fewer than two points. With a `grid` numbers are rounded to one part of it,
 * else to `digits`.
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

/** Path data of a circle. */
export function circleData(x, y, radius, digits = 7) {
  const [r, from, to] = [radius, x - radius, 2 * radius].map((n) => dataNumber(n, digits));
  return `M${from} ${dataNumber(y, digits)}a${r} ${r} 0 1 0 ${to} 0a${r} ${r} 0 1 0 -${to} 0Z`;
}

/** A number in 1/100 pixel, as short as it can be written. */
export function pixel(x) {
  return Math.round(x * 100) / 100;
}

/** Path data, or none of what has no place: a joint may be undefined where its base vanishes. */
export function placedData(data) {
  return data.includes("NaN") || data.includes("Infinity") ? "" : data;
}
