// Curves laid over the first of them.

import { curvePoints } from "../../data/family.js";
import { queryShape } from "../../shape/query-shape.js";
import { buildIndex } from "../../shape/shape-index.js";
import { deviationBetween } from "../../shape/deviation.js";
import { searchByShape } from "../../shape/search.js";
import { identity, transformed } from "../../shape/similarity.js";

/**
 * Lays a curve, { family, curve }, over the first by an alignment's name: { points, closed, similarity, rms,
 * greatest }, deviations by the extent of the first. The best similarity is that of the search by shape.
 */
export function laidOver(first, one, align) {
  const closed = one.family.curves.closed[one.curve] === 1;
  const own = curvePoints(one.family, one.curve);
  const base = curvePoints(first.family, first.curve);
  const baseClosed = first.family.curves.closed[first.curve] === 1;
  if (align === "similar" || align === "mirrored") {
    const shape = queryShape(base, baseClosed);
    const found = shape && searched(shape, one, align === "mirrored");
    if (found) {
      const { similarity, rms, greatest } = found;
      return { points: transformed(similarity, own), closed, similarity, rms, greatest };
    }
  }
  const similarity = boxed(base, own, align);
  const points = transformed(similarity, own);
  const deviation = deviationBetween({ points: base, closed: baseClosed }, { points, closed });
  return { points, closed, similarity, ...deviation };
}

/** The one curve, compared with a shape as the search by shape compares them. */
function searched(shape, { family, curve }, mirror) {
  const alone = { ...family, curves: { ...family.curves, count: 1, ...onlyCurve(family.curves, curve) } };
  const index = finished(buildIndex(alone));
  return finished(searchByShape([index], shape, { mirror }))[0];
}

function onlyCurve(curves, curve) {
  const { cell, trace, circuit, closed, box, start, points } = curves;
  return {
    cell: cell.subarray(curve, curve + 1),
    trace: trace.subarray(curve, curve + 1),
    circuit: circuit.subarray(curve, curve + 1),
    closed: closed.subarray(curve, curve + 1),
    box: box.subarray(4 * curve, 4 * curve + 4),
    start: Uint32Array.of(0, start[curve + 1] - start[curve]),
    points: points.subarray(2 * start[curve], 2 * start[curve + 1]),
  };
}

function finished(generator) {
  for (;;) {
    const { value, done } = generator.next();
    if (done) return value;
  }
}

/** What brings the middle of one's box, and its diagonal if asked, to the other's. */
function boxed(base, own, align) {
  if (align === "none") return identity();
  const [a, b] = [middleAndSize(base), middleAndSize(own)];
  const scale = align === "size" && b.size > 0 ? a.size / b.size : 1;
  return { mirror: false, re: scale, im: 0, x: a.x - scale * b.x, y: a.y - scale * b.y };
}

function middleAndSize(points) {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < points.length; k += 2) {
    [x0, x1] = [Math.min(x0, points[k]), Math.max(x1, points[k])];
    [y0, y1] = [Math.min(y0, points[k + 1]), Math.max(y1, points[k + 1])];
  }
  return { x: (x0 + x1) / 2, y: (y0 + y1) / 2, size: Math.hypot(x1 - x0, y1 - y0) };
}
