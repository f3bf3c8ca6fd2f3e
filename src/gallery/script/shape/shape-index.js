// Builds the index of curves of a family by shape, in steps.

import { curvePoints } from "../data/family.js";
import { withoutDuplicates, resampled } from "./outline.js";
import { fourier, normalised } from "./fourier.js";

/** The number of points of a spectrum, and of a curve stored in the index. */
export const SPECTRUM = 64;
export const INDEX_POINTS = 128;
/**
 * The number of chords of a window, whose directions describe it, and of points in a closer comparison.
 */
export const CHORDS = 8;
export const WINDOW = 16;
/** The spans of windows, by the length of the curve: from all of it down to less than a twentieth. */
export const SPANS = Array.from({ length: 23 }, (_, k) => Math.pow(1.15, -k));
// Windows begin about a sixteenth of their length apart, and at no more places of a curve than this.
const STARTS = 16;
const MOST_STARTS = 320;

/** The number of windows of a span on a curve. */
export function windowCount(span) {
  return Math.min(Math.ceil(STARTS / span), MOST_STARTS);
}

/**
 * Builds the index of `count` curves of a family, from the curve `first` on, step by step; their pieces must be
 * loaded. `kept` has each curve even, centred and 1 in its root of mean squares; `re` and `im` of closed curves
 * the spectrum, of open ones the points themselves, of unit energy; `size` that of the spectrum's numbers.
 * @param {Family} family @returns {Generator<number, ShapeIndex>}
 */
export function* buildIndex(/** @type {Family} */ family, first = 0, count = family.curves.count) {
  const transform = fourier(SPECTRUM);
  const index = {
    family,
    first,
    count,
    closed: family.curves.closed.slice(first, first + count),
    kept: new Float32Array(2 * INDEX_POINTS * count),
    re: new Float32Array(SPECTRUM * count),
    im: new Float32Array(SPECTRUM * count),
    size: new Float32Array(SPECTRUM * count),
    windows: null,
    points: null,
  };
  const [re, im] = [new Float64Array(SPECTRUM), new Float64Array(SPECTRUM)];
  for (let curve = 0; curve < count; curve += 1) {
    indexCurve(index, curve, transform, re, im);
    if (curve % 16 === 15) yield curve / count;
  }
  return index;
}

function indexCurve(/** @type {ShapeIndex} */ index, curve, transform, re, im) {
  const closed = index.closed[curve] === 1;
  const outline = withoutDuplicates(pointsOf(index, curve), closed);
  if (outline.length < 4) return;
  const even = resampled(outline, closed, INDEX_POINTS);
  storePoints(index, curve, even);
  const few = closed ? even : resampled(outline, false, SPECTRUM);
  const stride = few.length / 2 / SPECTRUM;
  for (let k = 0; k < SPECTRUM; k += 1) {
    re[k] = few[2 * k * stride];
    im[k] = few[2 * k * stride + 1];
  }
  normalised(re, im);
  if (closed) transform.forward(re, im);
  for (let k = 0; k < SPECTRUM; k += 1) {
    const at = SPECTRUM * curve + k;
    index.re[at] = re[k];
    index.im[at] = im[k];
    index.size[at] = Math.sqrt(re[k] * re[k] + im[k] * im[k]);
  }
}

/** The points of a curve of an index. @param {ShapeIndex} _ */
export function pointsOf({ family, first, points }, curve) {
  return points ?? curvePoints(family, first + curve);
}

/**
 * An index of one curve of another one, with its points, which needs neither that index nor the curve's
 * piece.
 */
export function singleCurveIndex(/** @type {ShapeIndex} */ index, curve) {
  const part = (array, each) => array.slice(each * curve, each * (curve + 1));
  return {
    family: index.family,
    first: index.first + curve,
    count: 1,
    closed: part(index.closed, 1),
    kept: part(index.kept, 2 * INDEX_POINTS),
    re: part(index.re, SPECTRUM),
    im: part(index.im, SPECTRUM),
    size: part(index.size, SPECTRUM),
    windows: null,
    points: pointsOf(index, curve),
  };
}

function storePoints(/** @type {ShapeIndex} */ index, curve, even) {
  let [x, y, square] = [0, 0, 0];
  for (let k = 0; k < even.length; k += 2) {
    x += even[k] / INDEX_POINTS;
    y += even[k + 1] / INDEX_POINTS;
  }
  for (let k = 0; k < even.length; k += 2)
    square += ((even[k] - x) ** 2 + (even[k + 1] - y) ** 2) / INDEX_POINTS;
  const scale = square > 0 ? 1 / Math.sqrt(square) : 0;
  const at = 2 * INDEX_POINTS * curve;
  for (let k = 0; k < even.length; k += 2) {
    index.kept[at + k] = scale * (even[k] - x);
    index.kept[at + k + 1] = scale * (even[k + 1] - y);
  }
}

/**
 * Adds to an index, step by step, the windows for a search for parts of curves no shorter than `least` of a
 * curve: windows[k] u8[count × windowCount(SPANS[k])], the direction of the first chord of each window in
 * 256ths of a turn. The other chords are the first ones of later windows.
 */
export function* addWindows(/** @type {ShapeIndex} */ index, least) {
  index.windows ??= [];
  for (let s = 0; s < SPANS.length && (s === 0 || SPANS[s - 1] > least); s += 1) {
    if (index.windows[s]) continue;
    const each = windowCount(SPANS[s]);
    const out = new Uint8Array(index.count * each);
    const [re, im] = [new Float64Array(2), new Float64Array(2)];
    for (let curve = 0; curve < index.count; curve += 1) {
      for (let w = 0; w < each; w += 1) {
        windowAt(index, curve, w / each, SPANS[s] / CHORDS, re, im);
        out[curve * each + w] = directionOf(re[1] - re[0], im[1] - im[0]);
      }
      if (curve % 32 === 31) yield curve / index.count;
    }
    index.windows[s] = out;
  }
}

/** The direction of a vector in 256ths of a turn. */
export function directionOf(x, y) {
  return Math.round((Math.atan2(y, x) * 128) / Math.PI) & 255;
}

/**
 * The points of a window of a curve, `start` and `span` by its length, into re and im; of a closed one on
 * round its end.
 */
export function windowAt(/** @type {ShapeIndex} */ index, curve, start, span, re, im) {
  const base = 2 * INDEX_POINTS * curve;
  const { kept } = index;
  const points = re.length;
  const closed = index.closed[curve];
  const whole = closed ? INDEX_POINTS : INDEX_POINTS - 1;
  const step = (span * whole) / (points - 1);
  let at = start * whole;
  for (let n = 0; n < points; n += 1, at += step) {
    let k = Math.floor(at);
    let t = at - k;
    if (!closed && k >= INDEX_POINTS - 1) [k, t] = [INDEX_POINTS - 2, 1];
    if (!closed && k < 0) [k, t] = [0, 0];
    const a = base + 2 * (k & (INDEX_POINTS - 1));
    const b = base + 2 * ((k + 1) & (INDEX_POINTS - 1));
    re[n] = kept[a] + t * (kept[b] - kept[a]);
    im[n] = kept[a + 1] + t * (kept[b + 1] - kept[a + 1]);
  }
}
