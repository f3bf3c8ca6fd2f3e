// A window of a curve moved to where it is most like a shape.

import { WINDOW, windowAt } from "./indexing.js";

const ROUNDS = 6;

/**
 * Moves the ends of a window, { start, span } by the curve's length, by Gauss and Newton's rounds to where it is most like a
 * shape of unit energy { re, im }: { start, span, value }, the square of their correlation, 1 for a similar portion.
 */
export function settled(index, curve, own, { start, span }, least) {
  const window = new Window(index, curve, own);
  let [from, to] = [start, start + Math.min(span, 1)];
  let best = window.valueAt(from, to);
  let trust = 1;
  for (let round = 0; round < ROUNDS && trust > 0.05; round += 1) {
    const [first, last] = window.stepFrom(from, to);
    const most = 0.2 * (to - from);
    const limit = (move) => Math.min(Math.max(trust * move, -most), most);
    const [nextFrom, nextTo] = window.allowed(from + limit(first), to + limit(last), least);
    const value = window.valueAt(nextFrom, nextTo);
    const done = value - best < 1e-9;
    if (value > best) [best, from, to] = [value, nextFrom, nextTo];
    else trust /= 4;
    if (done && trust === 1) break;
  }
  return { start: from, span: to - from, value: best };
}

class Window {
  constructor(index, curve, own) {
    Object.assign(this, { index, curve, own });
    this.parts = [0, 1, 2].map(() => ({ re: new Float64Array(WINDOW), im: new Float64Array(WINDOW) }));
  }

  valueAt(from, to) {
    const [{ re, im }] = this.parts;
    windowAt(this.index, this.curve, from, to - from, re, im);
    return correlation(this.own, re, im);
  }

  /** Ends that the curve has: of an open one none beyond its own, and an extent from the least to the whole. */
  allowed(from, to, least) {
    let [a, b] = this.index.closed[this.curve] ? [from, to] : [Math.max(from, 0), Math.min(to, 1)];
    const span = Math.min(Math.max(b - a, least), 1);
    const middle = (a + b) / 2;
    if (span !== b - a) [a, b] = [middle - span / 2, middle + span / 2];
    return [a, b];
  }

  /** How far to move both ends by the derivatives of the window, apart from what a similarity can do. */
  stepFrom(from, to) {
    const { own, parts: [w, u, v] } = this;
    const h = 0.01 * (to - from);
    centredWindow(this, from, to, w);
    centredWindow(this, from + h, to, u);
    centredWindow(this, from, to + h, v);
    const energy = product(w, w)[0];
    if (!(energy > 1e-12)) return [0, 0];
    const [x, y] = product(own, w).map((value) => value / energy);
    for (const moved of [u, v]) {
      for (let n = 0; n < WINDOW; n += 1) {
        const [p, q] = [(moved.re[n] - w.re[n]) / h, (moved.im[n] - w.im[n]) / h];
        moved.re[n] = x * p - y * q;
        moved.im[n] = x * q + y * p;
      }
      withoutPart(moved, w, energy);
    }
    const residue = { re: own.re.map((value, n) => value - x * w.re[n] + y * w.im[n]), im: own.im.map((value, n) => value - x * w.im[n] - y * w.re[n]) };
    const [uu, vv, uv] = [product(u, u)[0], product(v, v)[0], product(u, v)[0]];
    const [ur, vr] = [product(u, residue)[0], product(v, residue)[0]];
    const damped = 1e-3 * (uu + vv) + 1e-12;
    const [a, b] = [uu + damped, vv + damped];
    const whole = a * b - uv * uv;
    return [(b * ur - uv * vr) / whole, (a * vr - uv * ur) / whole];
  }
}

function centredWindow({ index, curve }, from, to, { re, im }) {
  windowAt(index, curve, from, to - from, re, im);
  let [x, y] = [0, 0];
  for (let n = 0; n < WINDOW; n += 1) {
    x += re[n] / WINDOW;
    y += im[n] / WINDOW;
  }
  for (let n = 0; n < WINDOW; n += 1) {
    re[n] -= x;
    im[n] -= y;
  }
}

/** The complex product of one with the other's conjugate: [real, imaginary]. */
function product(one, other) {
  let [x, y] = [0, 0];
  for (let n = 0; n < WINDOW; n += 1) {
    x += one.re[n] * other.re[n] + one.im[n] * other.im[n];
    y += one.im[n] * other.re[n] - one.re[n] * other.im[n];
  }
  return [x, y];
}

/** Takes from a vector, in place, the part of it that is a multiple of another. */
function withoutPart(one, other, energy) {
  const [x, y] = product(one, other).map((value) => value / energy);
  for (let n = 0; n < WINDOW; n += 1) {
    one.re[n] -= x * other.re[n] - y * other.im[n];
    one.im[n] -= x * other.im[n] + y * other.re[n];
  }
}

/** The square of the correlation of a window, about its own mean, with a shape of unit energy. */
export function correlation(own, re, im) {
  let [x, y, u, v, energy] = [0, 0, 0, 0, 0];
  for (let n = 0; n < WINDOW; n += 1) {
    x += own.re[n] * re[n] + own.im[n] * im[n];
    y += own.im[n] * re[n] - own.re[n] * im[n];
    u += re[n];
    v += im[n];
    energy += re[n] * re[n] + im[n] * im[n];
  }
  const spread = energy - (u * u + v * v) / WINDOW;
  return spread > 1e-12 ? (x * x + y * y) / spread : 0;
}
