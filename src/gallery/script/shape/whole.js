// Which whole curves are like a shape, by the spectra of the index.

import { evenShape, thereAndBack } from "./asked.js";
import { SPECTRUM } from "./indexing.js";
import { fourier, normalised } from "./spectrum.js";
import { Shortlist } from "./shortlist.js";

// The ways in which a curve may be passed: as it is, the other way round, and the mirror images of both.
const WAYS = [
  { mirror: false, reversed: false },
  { mirror: false, reversed: true },
  { mirror: true, reversed: false },
  { mirror: true, reversed: true },
];

/**
 * Finds, step by step, the `most` curves of an index that are most like a shape: the generator's value is [{
 * index, curve, value, seeds: [{ mirror, reversed, start }] }], `value` up to 1 for a similar curve, `start`
 * the fraction of the curve's length, in the way it is passed, at which the shape begins.
 *
 * All turns, scales and beginnings are tried at once: they are the cyclic correlation with the curve, and its
 * size.
 */
export function* likelyWhole(index, shape, { mirror, most }) {
  const ways = mirror ? WAYS : WAYS.slice(0, 2);
  const list = new Shortlist(most);
  yield* likelyClosed(index, shape.closed ? shape : thereAndBack(shape), ways, list);
  if (!shape.closed) yield* likelyOpen(index, shape, ways, list);
  return list.best();
}

function* likelyClosed(index, shape, ways, list) {
  const transform = fourier(SPECTRUM);
  const own = parts(evenShape(shape, SPECTRUM).points);
  if (!normalised(own.re, own.im)) return;
  transform.forward(own.re, own.im);
  const size = own.re.map((value, k) => Math.hypot(value, own.im[k]));
  const order = [];
  const [straight, turned] = [new Float64Array(index.count), new Float64Array(index.count)];
  for (let curve = 0; curve < index.count; curve += 1) {
    if (!index.closed[curve]) continue;
    bounds(index, curve, size, straight, turned);
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
    const seeds = ways.flatMap((way) => {
      const bound = way.mirror === way.reversed ? straight[curve] : turned[curve];
      return bound > list.least() ? peaks(index, curve, own, way, transform, work) : [];
    });
    seeds.sort((a, b) => b.value - a.value);
    if (seeds.length) list.offer({ index, curve, value: seeds[0].value, seeds: seeds.slice(0, 3) });
    if (k % 64 === 63) yield;
  }
}

/** Bounds of the correlation: that of the sizes of the waves, which no turn and no beginning changes. */
function bounds(index, curve, size, straight, turned) {
  const base = SPECTRUM * curve;
  let [along, against] = [0, 0];
  for (let k = 0; k < SPECTRUM; k += 1) {
    along += size[k] * index.size[base + k];
    against += size[k] * index.size[base + ((SPECTRUM - k) & (SPECTRUM - 1))];
  }
  straight[curve] = along / SPECTRUM;
  turned[curve] = against / SPECTRUM;
}

/** The two best beginnings of a curve passed in one way. */
function peaks(index, curve, own, way, transform, { re, im, square }) {
  const base = SPECTRUM * curve;
  // The other direction of a curve turns its spectrum round; so does its mirror image, which conjugates it as
  // well.
  const turned = way.mirror !== way.reversed;
  const sign = way.mirror ? 1 : -1;
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
    found.push({ ...way, start: (k + beside) / SPECTRUM, value: Math.sqrt(square[k]) / SPECTRUM });
  }
  return found.sort((a, b) => b.value - a.value).slice(0, 2);
}

function* likelyOpen(index, shape, ways, list) {
  const own = parts(evenShape(shape, SPECTRUM).points);
  if (!normalised(own.re, own.im)) return;
  for (let curve = 0; curve < index.count; curve += 1) {
    if (index.closed[curve]) continue;
    const seeds = ways.map((way) => ({ ...way, start: 0, value: likeness(index, curve, own, way) }));
    seeds.sort((a, b) => b.value - a.value);
    list.offer({ index, curve, value: seeds[0].value, seeds: seeds.slice(0, 2) });
    if (curve % 256 === 255) yield;
  }
}

function likeness(index, curve, own, { mirror, reversed }) {
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
