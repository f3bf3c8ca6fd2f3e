// Similarities of the plane: an optional reflection, then a rotation, a scaling and a translation.

/** The identity. @returns {Similarity} */
export function identity() {
  return { mirror: false, re: 1, im: 0, x: 0, y: 0 };
}

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

/** The composition of two similarities: `first`, then `second`. */
export function composed(/** @type {Similarity} */ second, /** @type {Similarity} */ first) {
  const [u, v] = [first.re, second.mirror ? -first.im : first.im];
  const [s, t] = [first.x, second.mirror ? -first.y : first.y];
  return {
    mirror: first.mirror !== second.mirror,
    re: second.re * u - second.im * v,
    im: second.re * v + second.im * u,
    x: second.re * s - second.im * t + second.x,
    y: second.re * t + second.im * s + second.y,
  };
}

/**
 * The similarity without reflection that best maps points to others, one by one, by least squares. Points that
 * all coincide are only translated.
 * @returns {Similarity}
 */
export function fitted(from, to) {
  const count = from.length / 2;
  let [fx, fy, tx, ty] = [0, 0, 0, 0];
  for (let k = 0; k < from.length; k += 2) {
    fx += from[k] / count;
    fy += from[k + 1] / count;
    tx += to[k] / count;
    ty += to[k + 1] / count;
  }
  let [re, im, energy] = [0, 0, 0];
  for (let k = 0; k < from.length; k += 2) {
    const [u, v, p, q] = [from[k] - fx, from[k + 1] - fy, to[k] - tx, to[k + 1] - ty];
    re += p * u + q * v;
    im += q * u - p * v;
    energy += u * u + v * v;
  }
  [re, im] = energy > 0 ? [re / energy, im / energy] : [1, 0];
  return { mirror: false, re, im, x: tx - re * fx + im * fy, y: ty - im * fx - re * fy };
}

/**
 * The similarity without reflection that best maps points to lines through others, by least squares of the
 * distances `from`-`to` across the line of direction `along` (unit vectors), and of those along it weighted
 * with `slip`: a displacement along a curve is not a deviation from it. Null if the points do not determine
 * it.
 */
export function fittedToLines(from, to, along, slip) {
  const rows = new Float64Array(20);
  const add = (a, b, x, y, value, weight) => {
    const row = [a, b, x, y];
    for (let i = 0; i < 4; i += 1) {
      for (let k = 0; k < 4; k += 1) rows[5 * i + k] += weight * row[i] * row[k];
      rows[5 * i + 4] += weight * row[i] * value;
    }
  };
  for (let k = 0; k < from.length; k += 2) {
    const [u, v, p, q, ex, ey] = [from[k], from[k + 1], to[k], to[k + 1], along[k], along[k + 1]];
    add(-ey * u + ex * v, ey * v + ex * u, -ey, ex, -ey * p + ex * q, 1);
    add(ex * u + ey * v, -ex * v + ey * u, ex, ey, ex * p + ey * q, slip);
  }
  const solution = solveFour(rows);
  return solution && { mirror: false, re: solution[0], im: solution[1], x: solution[2], y: solution[3] };
}

/**
 * Solves four equations, each of four coefficients and a right side, in place; null where they are singular.
 */
function solveFour(rows) {
  for (let i = 0; i < 4; i += 1) {
    let pivot = i;
    for (let k = i + 1; k < 4; k += 1)
      if (Math.abs(rows[5 * k + i]) > Math.abs(rows[5 * pivot + i])) pivot = k;
    if (!(Math.abs(rows[5 * pivot + i]) > 1e-12)) return null;
    for (let c = 0; c < 5; c += 1)
      [rows[5 * i + c], rows[5 * pivot + c]] = [rows[5 * pivot + c], rows[5 * i + c]];
    for (let k = 0; k < 4; k += 1) {
      if (k === i) continue;
      const factor = rows[5 * k + i] / rows[5 * i + i];
      for (let c = i; c < 5; c += 1) rows[5 * k + c] -= factor * rows[5 * i + c];
    }
  }
  return [0, 1, 2, 3].map((i) => rows[5 * i + 4] / rows[5 * i + i]);
}
