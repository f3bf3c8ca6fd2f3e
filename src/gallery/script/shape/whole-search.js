// Finds the whole curves like a shape, by the spectra of the index.

import { resampledShape, thereAndBack } from "./query-shape.js";
import { SPECTRUM } from "./shape-index.js";
import { fourier, normalised } from "./fourier.js";

// The orientations of a curve: as given, reversed, and the mirror images of both.
const ORIENTATIONS = [
  { mirror: false, reversed: false },
  { mirror: false, reversed: true },
  { mirror: true, reversed: false },
  { mirror: true, reversed: true },
];

/**
 * Finds, step by step, the `most` curves of an index that are most like a shape, `value` up to 1 for a similar
 * curve. All rotations, scales and starts are tried at once, by the cyclic correlation with the curve.
 * @param {ShapeIndex} index @param {Shape} shape @returns {Generator<void, Candidate[]>}
 */
export function* candidateCurves(index, shape, { mirror, most }) {
  const orientations = mirror ? ORIENTATIONS : ORIENTATIONS.slice(0, 2);
  const list = new Shortlist(most);
  yield* candidatesAmongClosed(index, shape.closed ? shape : thereAndBack(shape), orientations, list);
  if (!shape.closed) yield* candidatesAmongOpen(index, shape, orientations, list);
  return list.best();
}

/** @param {ShapeIndex} index @param {Shape} shape */
function* candidatesAmongClosed(index, shape, orientations, list) {
  const transform = fourier(SPECTRUM);
  const own = parts(resampledShape(shape, SPECTRUM).points);
  if (!normalised(own.re, own.im)) return;
  transform.forward(own.re, own.im);
  const size = own.re.map((value, k) => Math.hypot(value, own.im[k]));
  const order = [];
  const [straight, turned] = [new Float64Array(index.count), new Float64Array(index.count)];
  for (let curve = 0; curve < index.count; curve += 1) {
    if (!index.closed[curve]) continue;
    correlationBounds(index, curve, size, straight, turned);
    order.push(curve);
    if (curve % 1024 === 1023) yield;
  }
  const most = straight.map((value, curve) => Math.max(value, turned[curve]));
  order.sort((a, b) => most[b] - most[a]);
  const work = {
    re: new Float64Array(SPECTRUM),
    im: new Float64Array(SPECTRUM),
    square: new Float64Array(SPECTRUM),
  };
  for (let k = 0; k < order.length; k += 1) {
    const curve = order[k];
    // No curve further on in this order can be more like the shape than its bound.
    if (most[curve] <= list.least()) break;
    const seeds = orientations.flatMap((orientation) => {
      const bound = orientation.mirror === orientation.reversed ? straight[curve] : turned[curve];
      return bound > list.least() ? correlationPeaks(index, curve, own, orientation, transform, work) : [];
    });
    seeds.sort((a, b) => b.value - a.value);
    if (seeds.length) list.offer({ index, curve, value: seeds[0].value, seeds: seeds.slice(0, 3) });
    if (k % 64 === 63) yield;
  }
}

/** Bounds of the correlation: that of the amplitudes, which rotations and starts do not change. */
function correlationBounds(/** @type {ShapeIndex} */ index, curve, size, straight, turned) {
  const base = SPECTRUM * curve;
  let [along, against] = [0, 0];
  for (let k = 0; k < SPECTRUM; k += 1) {
    along += size[k] * index.size[base + k];
    against += size[k] * index.size[base + ((SPECTRUM - k) & (SPECTRUM - 1))];
  }
  straight[curve] = along / SPECTRUM;
  turned[curve] = against / SPECTRUM;
}

/** The two best starts of a curve in one orientation. @param {ShapeIndex} index @param {Complex} own */
function correlationPeaks(index, curve, own, orientation, transform, { re, im, square }) {
  const base = SPECTRUM * curve;
  // Reversing a curve reverses its spectrum; mirroring reverses and conjugates it.
  const turned = orientation.mirror !== orientation.reversed;
  const sign = orientation.mirror ? 1 : -1;
  for (let k = 0; k < SPECTRUM; k += 1) {
    const at = base + (turned ? (SPECTRUM - k) & (SPECTRUM - 1) : k);
    const [x, y] = [index.re[at], sign * index.im[at]];
    re[k] = own.re[k] * x - own.im[k] * y;
    im[k] = own.re[k] * y + own.im[k] * x;
  }
  transform.forward(re, im);
  for (let k = 0; k < SPECTRUM; k += 1) square[k] = re[k] * re[k] + im[k] * im[k];
  const found = [];
  for (let k = 0; k < SPECTRUM; k += 1) {
    const before = square[(k + SPECTRUM - 1) & (SPECTRUM - 1)];
    const after = square[(k + 1) & (SPECTRUM - 1)];
    if (square[k] < before || square[k] <= after) continue;
    const bend = before + after - 2 * square[k];
    const beside = bend < 0 ? (before - after) / (2 * bend) : 0;
    found.push({ ...orientation, start: (k + beside) / SPECTRUM, value: Math.sqrt(square[k]) / SPECTRUM });
  }
  return found.sort((a, b) => b.value - a.value).slice(0, 2);
}

/** @param {ShapeIndex} index @param {Shape} shape */
function* candidatesAmongOpen(index, shape, orientations, list) {
  const own = parts(resampledShape(shape, SPECTRUM).points);
  if (!normalised(own.re, own.im)) return;
  for (let curve = 0; curve < index.count; curve += 1) {
    if (index.closed[curve]) continue;
    const seeds = orientations.map((orientation) => ({
      ...orientation,
      start: 0,
      value: openCorrelation(index, curve, own, orientation),
    }));
    seeds.sort((a, b) => b.value - a.value);
    list.offer({ index, curve, value: seeds[0].value, seeds: seeds.slice(0, 2) });
    if (curve % 256 === 255) yield;
  }
}

/** @param {ShapeIndex} index @param {Complex} own */
function openCorrelation(index, curve, own, { mirror, reversed }) {
  const base = SPECTRUM * curve;
  let [x, y] = [0, 0];
  for (let k = 0; k < SPECTRUM; k += 1) {
    const at = base + (reversed ? SPECTRUM - 1 - k : k);
    const [u, v] = [index.re[at], mirror ? index.im[at] : -index.im[at]];
    x += own.re[k] * u - own.im[k] * v;
    y += own.re[k] * v + own.im[k] * u;
  }
  return Math.hypot(x, y);
}

function parts(points) {
  const count = points.length / 2;
  return {
    re: Float64Array.from({ length: count }, (_, k) => points[2 * k]),
    im: Float64Array.from({ length: count }, (_, k) => points[2 * k + 1]),
  };
}

/** The `most` offers with the greatest `value`. */
export class Shortlist {
  constructor(most) {
    this.most = most;
    this.kept = [];
  }

  /** The value that an offer must exceed to be kept. */
  least() {
    return this.kept.length < this.most ? -Infinity : this.kept[this.kept.length - 1].value;
  }

  offer(one) {
    if (!(one.value > this.least())) return;
    let at = this.kept.length;
    while (at > 0 && this.kept[at - 1].value < one.value) at -= 1;
    this.kept.splice(at, 0, one);
    if (this.kept.length > this.most) this.kept.pop();
  }

  /** The kept offers, the best first. */
  best() {
    return this.kept;
  }
}
