// Similarities of the plane: an optional reflection, then a rotation, a scaling and a translation.

/** A flat array of points transformed by a similarity. @param {Similarity} _ */
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
