// Fits one outline to another by a similarity, and computes the deviation that remains.

import { fitted, fittedToLines, transformed } from "./similarity.js";

// The weight of a distance along the curve relative to one across it.
const SLIP = 0.02;

/**
 * Fits `curve` to `query`, an outline of the same direction and about the same extent, 1, both evenly spaced.
 * `start` and `span` give the positions on `curve`, counted in its points, between which `query` approximately
 * lies. With `whole`, all of `curve` is compared, not only the part between the ends of `query`. `rounds` is the
 * number of rounds of pairing and fitting; `reach` is how far from its expected position the nearest point is
 * searched, by the length of the other outline: far enough for the uneven speed of a drawing hand, and not so far
 * that one arm of a figure is mistaken for another.
 *
 * Returns the deviations of both outlines from each other in the units of `query`, the similarity from `curve` to
 * `query`, the positions of the ends of `query` on `curve`, and its start estimated from all of its points.
 * @param {Outline} query @param {Outline} curve @returns {Fit & { start: number }}
 */
export function closestFit(query, curve, { start, span, whole, rounds, reach }) {
  const match = new OutlinePairing(query, curve, { start, span, whole, reach });
  let similarity = fitted(match.expected(), query.points);
  for (let round = 0; round < rounds; round += 1) {
    match.pair(transformed(similarity, curve.points));
    const next = fittedToLines(match.from.subarray(0, match.used), match.to, match.along, SLIP);
    if (!next) break;
    const moved =
      Math.abs(next.re - similarity.re) +
      Math.abs(next.im - similarity.im) +
      Math.abs(next.x - similarity.x) +
      Math.abs(next.y - similarity.y);
    similarity = next;
    if (moved < 1e-5) break;
  }
  match.pair(transformed(similarity, curve.points));
  return { ...match.deviation(), similarity, ...match.where() };
}

/** Pairs the points of each of two outlines with the nearest positions on the other. */
class OutlinePairing {
  used = 0;
  // The means and the greatest of the squares of the distances, both ways.
  forth = 0;
  back = 0;
  forthGreatest = 0;
  backGreatest = 0;

  constructor(/** @type {Outline} */ query, /** @type {Outline} */ curve, { start, span, whole, reach }) {
    this.query = query;
    this.curve = curve;
    this.start = start;
    this.span = span;
    this.whole = whole;
    this.reach = reach;
    this.count = query.points.length / 2;
    this.steps = query.closed ? this.count : this.count - 1;
    this.places = curve.points.length / 2;
    this.place = Float64Array.from({ length: this.count }, (_, n) => start + (span * n) / this.steps);
    const capacity = 2 * (this.count + Math.ceil(2 * this.places) + 2);
    this.from = new Float64Array(capacity);
    this.to = new Float64Array(capacity);
    this.along = new Float64Array(capacity);
    this.foot = { place: 0, square: 0, x: 0, y: 0, ex: 0, ey: 0 };
  }

  /** The points of the curve at the expected positions of the points of `query`. */
  expected() {
    const out = new Float64Array(2 * this.count);
    for (let n = 0; n < this.count; n += 1) this.pointAt(this.place[n], out, 2 * n);
    return out;
  }

  pointAt(place, out, at) {
    const { points, closed } = this.curve;
    const within = closed ? place : Math.min(Math.max(place, 0), this.places - 1.000001);
    const k = Math.floor(within);
    const t = within - k;
    const a = 2 * (((k % this.places) + this.places) % this.places);
    const b = 2 * ((a / 2 + 1) % this.places);
    out[at] = points[a] + t * (points[b] - points[a]);
    out[at + 1] = points[a + 1] + t * (points[b + 1] - points[a + 1]);
  }

  /**
   * Pairs the points of both outlines with the other's nearest positions; `moved` is the curve transformed
   * onto `query`.
   */
  pair(moved) {
    const { query, curve, foot, start, span, steps } = this;
    this.used = this.forth = this.back = this.forthGreatest = this.backGreatest = 0;
    const near = Math.max(2, Math.ceil(this.reach * span));
    for (let n = 0; n < this.count; n += 1) {
      const [x, y] = [query.points[2 * n], query.points[2 * n + 1]];
      nearestPoint(moved, curve.closed, start + (span * n) / steps, near, x, y, foot);
      this.place[n] = foot.place;
      this.pointAt(foot.place, this.from, this.used);
      this.keep(x, y);
      this.forth += foot.square / this.count;
      this.forthGreatest = Math.max(this.forthGreatest, foot.square);
    }
    const [first, last] = this.compared();
    const around = Math.max(2, Math.ceil(this.reach * steps));
    for (let m = first; m <= last; m += 1) {
      const k = 2 * (((m % this.places) + this.places) % this.places);
      const about = ((m - start) / span) * steps;
      nearestPoint(query.points, query.closed, about, around, moved[k], moved[k + 1], foot);
      this.from[this.used] = curve.points[k];
      this.from[this.used + 1] = curve.points[k + 1];
      this.keep(foot.x, foot.y);
      this.back += foot.square / (last - first + 1);
      this.backGreatest = Math.max(this.backGreatest, foot.square);
    }
  }

  /**
   * The first and the last of the curve's points that are compared; the count continues round a closed curve.
   */
  compared() {
    if (this.whole) return [0, this.places - 1];
    const first = Math.ceil(this.place[0]);
    return [first, Math.min(Math.floor(this.place[this.count - 1]), first + 2 * this.places - 1)];
  }

  keep(x, y) {
    this.to[this.used] = x;
    this.to[this.used + 1] = y;
    this.along[this.used] = this.foot.ex;
    this.along[this.used + 1] = this.foot.ey;
    this.used += 2;
  }

  /** The positions of both ends of `query` on the curve, and its start estimated from all of its points. */
  where() {
    const { place, count, steps, span } = this;
    let start = 0;
    for (let n = 0; n < count; n += 1) start += (place[n] - (span * n) / steps) / count;
    return { from: place[0], to: place[count - 1], start };
  }

  deviation() {
    return {
      rms: Math.sqrt((this.forth + this.back) / 2),
      greatest: Math.sqrt(Math.max(this.forthGreatest, this.backGreatest)),
    };
  }
}

/**
 * Writes the nearest position to (x, y) on the segments of an outline within `reach` of a position to `foot`,
 * { place, square: of the distance, x, y, ex, ey: the direction of the segment }.
 */
function nearestPoint(/** @type {Float64Array} */ points, closed, about, reach, x, y, foot) {
  const count = points.length / 2;
  let [first, last] = [Math.floor(about) - reach, Math.floor(about) + reach];
  if (!closed) {
    first = Math.min(Math.max(first, 0), Math.max(count - 2, 0));
    last = Math.max(Math.min(last, count - 2), first);
  }
  foot.square = Infinity;
  const end = points.length;
  let a = 2 * (((first % count) + count) % count);
  for (let s = first; s <= last; s += 1, a = a + 2 === end ? 0 : a + 2) {
    const b = a + 2 === end ? 0 : a + 2;
    const dx = points[b] - points[a];
    const dy = points[b + 1] - points[a + 1];
    const size = dx * dx + dy * dy;
    const along = size > 0 ? ((x - points[a]) * dx + (y - points[a + 1]) * dy) / size : 0;
    const t = along < 0 ? 0 : along > 1 ? 1 : along;
    const u = points[a] + t * dx - x;
    const v = points[a + 1] + t * dy - y;
    const square = u * u + v * v;
    if (square < foot.square) {
      const norm = size > 0 ? 1 / Math.sqrt(size) : 0;
      foot.square = square;
      foot.place = s + t;
      foot.x = u + x;
      foot.y = v + y;
      foot.ex = dx * norm;
      foot.ey = dy * norm;
    }
  }
}
