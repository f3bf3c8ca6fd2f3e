// Maps the plane to the screen by a view: X = x + scale * px, Y = y - scale * py, in CSS pixels, y down.

/** Extends a box to the finite points of an array, and returns it. */
export function widenedBox(/** @type {number[]} */ box, /** @type {Points} */ points) {
  for (let k = 0; k + 1 < points.length; k += 2) {
    const [x, y] = [points[k], points[k + 1]];
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    if (x < box[0]) box[0] = x;
    if (y < box[1]) box[1] = y;
    if (x > box[2]) box[2] = x;
    if (y > box[3]) box[3] = y;
  }
  return box;
}

/** The bounding box of the finite points of arrays. @param {Points[]} outlines */
export function boxOfPoints(...outlines) {
  const empty = [Infinity, Infinity, -Infinity, -Infinity];
  return outlines.reduce((/** @type {number[]} */ box, points) => widenedBox(box, points), empty);
}

/**
 * The placement that fits a box of the plane into the middle of a frame, `margin` pixels from its edges.
 * @param {Box} _ @param {Size & { margin?: number }} _1
 */
export function fittedView([x0, y0, x1, y1], { width, height, margin = 0 }) {
  const [w, h] = [Math.max(width - 2 * margin, 1), Math.max(height - 2 * margin, 1)];
  const size = Math.max(x1 - x0, y1 - y0);
  if (!Number.isFinite(size)) return { scale: 1, x: width / 2, y: height / 2 };
  // A path that is a single point is centred too.
  const least = size > 0 ? 1e-9 * size : 1;
  const scale = Math.min(w / Math.max(x1 - x0, least), h / Math.max(y1 - y0, least));
  return { scale, x: width / 2 - (scale * (x0 + x1)) / 2, y: height / 2 + (scale * (y0 + y1)) / 2 };
}

/** A view zoomed by a factor about a point on the screen. @param {Placement} _ @param {number} factor @param {Point} _1 */
export function zoomedView({ scale, x, y }, factor, [atX, atY]) {
  return { scale: scale * factor, x: atX + (x - atX) * factor, y: atY + (y - atY) * factor };
}

/** The view between two others at a fraction (0 to 1). @param {Placement} from @param {Placement} to */
export function interpolatedView(from, to, /** @type {number} */ part) {
  const between = (/** @type {number} */ a, /** @type {number} */ b) => a + (b - a) * part;
  return {
    scale: from.scale * (to.scale / from.scale) ** part,
    x: between(from.x, to.x),
    y: between(from.y, to.y),
  };
}

/** The point of the plane at a point on the screen. @param {Placement} _ @param {Point} _1 @returns {Point} */
export function planePoint({ scale, x, y }, [atX, atY]) {
  return [(atX - x) / scale, (y - atY) / scale];
}

/** The greatest round number, 1, 2 or 5 times a power of ten, that is at most `x`. */
export function roundBelow(/** @type {number} */ x) {
  const power = 10 ** Math.floor(Math.log10(x));
  const part = x / power;
  return (part >= 5 ? 5 : part >= 2 ? 2 : 1) * power;
}

/** The point on the screen of a point of the plane. @returns {Point} */
export function screenPoint(/** @type {Placement} */ { scale, x, y }, /** @type {Point} */ [px, py]) {
  return [x + scale * px, y - scale * py];
}

/** The points of a flat array. @param {Points} points @returns {Point[]} */
export function pointPairs(points) {
  return Array.from({ length: points.length / 2 }, (_, k) => [points[2 * k], points[2 * k + 1]]);
}

/** A flat array of points transformed by a similarity: an optional reflection, then a rotation, a scaling and a translation. @param {Similarity} _ */
export function transformed({ mirror, re, im, x, y }, /** @type {Points} */ points) {
  const out = new Float64Array(points.length);
  for (let k = 0; k < points.length; k += 2) {
    const [u, v] = [points[k], mirror ? -points[k + 1] : points[k + 1]];
    out[k] = re * u - im * v + x;
    out[k + 1] = im * u + re * v + y;
  }
  return out;
}

/** The inverse of a similarity. @param {Similarity} _ */
export function inverted({ mirror, re, im, x, y }) {
  const size = re * re + im * im;
  // w = f z̃ + t gives z = conj((w − t) / f) if mirrored, (w − t) / f if not.
  const [a, b] = [re / size, -im / size];
  const [c, d] = [-(a * x - b * y), -(a * y + b * x)];
  return mirror ? { mirror, re: a, im: -b, x: c, y: -d } : { mirror, re: a, im: b, x: c, y: d };
}
