// Refines a window of a curve to where it is most like a shape.

import { WINDOW, windowAt } from "./shape-index.js";

/** Refines windows of the curves of an index. */
export class WindowRefiner {
  w = newWindow();
  u = newWindow();
  v = newWindow();
  left = newWindow();
  // The last complex product, and the steps of both ends.
  x = 0;
  y = 0;
  first = 0;
  last = 0;

  constructor(/** @type {ShapeIndex} */ index) {
    this.index = index;
  }

  /**
   * Moves the ends of a window by `rounds` of Gauss-Newton steps to where it is most like a shape of unit energy;
   * `value` is the square of their correlation, 1 for a similar portion.
   * @param {number} curve @param {Complex} own @param {Seed} _
   */
  refine(curve, /** @type {Complex} */ own, { start, span = 1 }, least, rounds) {
    let [from, to] = [start, start + Math.min(span, 1)];
    let best = this.valueAt(curve, own, from, to);
    let trust = 1;
    for (let round = 0; round < rounds && trust > 0.05; round += 1) {
      if (trust === 1) this.step(curve, own, from, to);
      const most = 0.2 * (to - from);
      const limit = (move) => Math.min(Math.max(trust * move, -most), most);
      const [nextFrom, nextTo] = this.allowed(curve, from + limit(this.first), to + limit(this.last), least);
      const value = this.valueAt(curve, own, nextFrom, nextTo);
      const gain = value - best;
      if (gain > 0) [best, from, to, trust] = [value, nextFrom, nextTo, 1];
      else trust /= 4;
      if (gain > 0 && gain < 1e-9) break;
    }
    return { start: from, span: to - from, value: best };
  }

  valueAt(curve, /** @type {Complex} */ own, from, to) {
    const { re, im } = this.w;
    windowAt(this.index, curve, from, to - from, re, im);
    return correlation(own, re, im);
  }

  /**
   * Ends in the valid range: of an open curve not beyond its own, and with a span from `least` to the whole.
   */
  allowed(curve, from, to, least) {
    const [a, b] = this.index.closed[curve] ? [from, to] : [Math.max(from, 0), Math.min(to, 1)];
    const span = Math.min(Math.max(b - a, least), 1);
    const middle = (a + b) / 2;
    return span === b - a ? [a, b] : [middle - span / 2, middle + span / 2];
  }

  /** Computes the steps of both ends, from the derivatives of the window orthogonal to similarities. */
  step(curve, /** @type {Complex} */ own, from, to) {
    const { w, u, v, left } = this;
    const h = 0.01 * (to - from);
    this.centred(curve, from, to, w);
    this.centred(curve, from + h, to, u);
    this.centred(curve, from, to + h, v);
    [this.first, this.last] = [0, 0];
    const energy = realProduct(w, w);
    if (!(energy > 1e-12)) return;
    this.product(own, w, energy);
    const [x, y] = [this.x, this.y];
    for (let n = 0; n < WINDOW; n += 1) {
      left.re[n] = own.re[n] - x * w.re[n] + y * w.im[n];
      left.im[n] = own.im[n] - x * w.im[n] - y * w.re[n];
    }
    for (let side = 0; side < 2; side += 1) {
      const moved = side ? v : u;
      for (let n = 0; n < WINDOW; n += 1) {
        const p = (moved.re[n] - w.re[n]) / h;
        const q = (moved.im[n] - w.im[n]) / h;
        moved.re[n] = x * p - y * q;
        moved.im[n] = x * q + y * p;
      }
      this.withoutWindow(moved, energy);
    }
    const uv = realProduct(u, v);
    const [uu, vv] = [realProduct(u, u), realProduct(v, v)];
    const [ur, vr] = [realProduct(u, left), realProduct(v, left)];
    const damped = 1e-3 * (uu + vv) + 1e-12;
    const whole = (uu + damped) * (vv + damped) - uv * uv;
    this.first = ((vv + damped) * ur - uv * vr) / whole;
    this.last = ((uu + damped) * vr - uv * ur) / whole;
  }

  centred(curve, from, to, /** @type {Complex} */ { re, im }) {
    windowAt(this.index, curve, from, to - from, re, im);
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

  /** Computes the complex product of one with the other's conjugate, by the other's energy, in x and y. */
  product(/** @type {Complex} */ one, /** @type {Complex} */ other, energy) {
    let [x, y] = [0, 0];
    for (let n = 0; n < WINDOW; n += 1) {
      x += one.re[n] * other.re[n] + one.im[n] * other.im[n];
      y += one.im[n] * other.re[n] - one.re[n] * other.im[n];
    }
    this.x = x / energy;
    this.y = y / energy;
  }

  /** Subtracts from a vector, in place, its projection on the window. @param {Complex} one */
  withoutWindow(one, energy) {
    const { w } = this;
    this.product(one, w, energy);
    for (let n = 0; n < WINDOW; n += 1) {
      one.re[n] -= this.x * w.re[n] - this.y * w.im[n];
      one.im[n] -= this.x * w.im[n] + this.y * w.re[n];
    }
  }
}

function newWindow() {
  return { re: new Float64Array(WINDOW), im: new Float64Array(WINDOW) };
}

/** The real part of the product of one with the other's conjugate. */
function realProduct(/** @type {Complex} */ one, /** @type {Complex} */ other) {
  let sum = 0;
  for (let n = 0; n < WINDOW; n += 1) sum += one.re[n] * other.re[n] + one.im[n] * other.im[n];
  return sum;
}

/** The square of the correlation of a window, about its own mean, with a shape of unit energy. */
export function correlation(/** @type {Complex} */ own, re, im) {
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
