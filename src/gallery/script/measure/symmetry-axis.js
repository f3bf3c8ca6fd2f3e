// Fits the symmetry axis of a curve, a line { through: [x, y], along: [x, y] of length 1 }, and computes the
// residual.

import { cosSinOfDegrees, degreesOf, remainderOf } from "../kinematics/angles.js";
import { distanceToChord } from "../kinematics/path.js";
import { signedDistance } from "./interpolation.js";
import { chordLengthAfter, neighbourSample } from "./sampled-curve.js";

/** The line through a point in a direction; null for a zero direction. */
export function axisThrough(through, [dx, dy]) {
  const size = Math.sqrt(dx * dx + dy * dy);
  const along = [dx / size, dy / size];
  return along.every(Number.isFinite) ? { through, along } : null;
}

/** Its direction from the x-axis, in degrees, from 0 up to 180. */
export function axisDirectionDeg({ along: [x, y] }) {
  const deg = remainderOf(degreesOf(Math.atan2(y, x)), 180);
  return deg === 180 ? 0 : deg;
}

/** The mirror image of a point. */
export function mirroredPoint({ through, along }, x, y) {
  const [bx, by] = [x - through[0], y - through[1]];
  const twice = 2 * (along[0] * bx + along[1] * by);
  return [through[0] + along[0] * twice - bx, through[1] + along[1] * twice - by];
}

/**
 * The only possible symmetry axis of a curve, by the moments of its length; null if moments of up to the
 * third order do not determine it, as for a circle. An axis is a principal axis of the second moments, and
 * moments of an odd order across it vanish; if the second are the same in every direction, those of the third
 * order decide.
 */
export function axisByMoments(curve) {
  // A moment that is less than this part of its greatest possible value counts as zero.
  const NONE = 1e-3;
  const { centre, all, cubes, second, third, threefold } = curveMoments(curve);
  const axis = (deg) => axisThrough(centre, cosSinOfDegrees(deg));
  const direction = ([x, y], fold) => degreesOf(Math.atan2(y, x)) / fold;
  const across = ([x, y], deg) => {
    const [cos, sin] = cosSinOfDegrees(deg);
    return Math.abs(y * cos - x * sin);
  };
  // How far the odd moments are from vanishing across a line.
  const oddness = (deg) => across(third, deg) + across(threefold, 3 * deg);
  if (Math.hypot(...second) > NONE * all) {
    const long = direction(second, 2);
    return axis(oddness(long) <= oddness(long + 90) + 1e-9 * cubes ? long : long + 90);
  }
  if (Math.hypot(...third) > NONE * cubes) return axis(direction(third, 1));
  return Math.hypot(...threefold) > NONE * cubes ? axis(direction(threefold, 3)) : null;
}

// Moments about the centre, each sample weighted by half the distance to either neighbour.
function curveMoments(curve) {
  const { x, y, count } = curve;
  const weight = (_, i) => {
    const before = neighbourSample(curve, i, -1);
    return ((before < 0 ? 0 : chordLengthAfter(curve, before)) + chordLengthAfter(curve, i)) / 2;
  };
  const weights = Float64Array.from({ length: count }, weight);
  let [total, cx, cy] = [0, 0, 0];
  for (let i = 0; i < count; i++) {
    total += weights[i];
    cx += x[i] * weights[i];
    cy += y[i] * weights[i];
  }
  const centre = [cx / total, cy / total];
  const moments = { centre, all: 0, cubes: 0, second: [0, 0], third: [0, 0], threefold: [0, 0] };
  for (let i = 0; i < count; i++) {
    const [zx, zy, w] = [x[i] - centre[0], y[i] - centre[1], weights[i]];
    const [sx, sy, norm2] = [zx * zx - zy * zy, 2 * zx * zy, zx * zx + zy * zy];
    moments.all += w * norm2;
    moments.cubes += w * norm2 * Math.sqrt(norm2);
    moments.second[0] += sx * w;
    moments.second[1] += sy * w;
    moments.third[0] += zx * w * norm2;
    moments.third[1] += zy * w * norm2;
    moments.threefold[0] += (sx * zx - sy * zy) * w;
    moments.threefold[1] += (sx * zy + sy * zx) * w;
  }
  return moments;
}

/**
 * The approximate residual of an axis: the greatest distance of mirrored samples, at least ninety of them if
 * there are so many, from the chords between all samples.
 */
export function roughResidual(curve, axis) {
  const ENOUGH = 90;
  const { x, y, count } = curve;
  const stride = Math.max(Math.floor(count / ENOUGH), 1);
  const nearest = sampleIndex(curve);
  let [near, most] = [0, 0];
  for (let i = 0; i < count; i += stride) {
    const [px, py] = mirroredPoint(axis, x[i], y[i]);
    near = nearest(px, py, near);
    // No line to a neighbour is further than the sample itself.
    const [dx, dy] = [x[near] - px, y[near] - py];
    if (dx * dx + dy * dy > most * most) most = Math.max(most, distanceToNeighbours(curve, px, py, near));
  }
  return most;
}

// How far a point is from the lines to the neighbours of a sample.
function distanceToNeighbours(curve, px, py, i) {
  const at = (k) => ({ x: curve.x[k], y: curve.y[k] });
  const to = (way) => {
    const next = neighbourSample(curve, i, way);
    return distanceToChord({ x: px, y: py }, at(i), at(next < 0 ? i : next));
  };
  return Math.min(to(-1), to(1));
}

/**
 * The axis of a nearly symmetrical curve refined by least squares, and the greatest distance of the mirror
 * image from the curve, { axis, most }; for a given axis only the latter.
 */
export function refineAxis(curve, begun, isGiven) {
  const [ROUNDS, STRIDE] = [3, 4];
  const nearest = sampleIndex(curve);
  let [axis, near] = [begun, 0];
  for (let round = 0; ; round++) {
    const isLast = isGiven || round === ROUNDS;
    const across = [-axis.along[1], axis.along[0]];
    // The normal equations of an offset and a turn.
    let [most, a, b, c, u, v] = [0, 0, 0, 0, 0, 0];
    for (let i = 0; i < curve.count; i += isLast ? 1 : STRIDE) {
      const [px, py] = mirroredPoint(axis, curve.x[i], curve.y[i]);
      near = nearest(px, py, near);
      const found = signedDistance(curve, px, py, near);
      if (!found) continue;
      const [off, nx, ny] = found;
      most = Math.max(most, Math.abs(off));
      const [bx, by] = [px - axis.through[0], py - axis.through[1]];
      const [shift, turn] = [2 * (nx * across[0] + ny * across[1]), 2 * (bx * ny - by * nx)];
      a += shift * shift;
      b += shift * turn;
      c += turn * turn;
      u += shift * off;
      v += turn * off;
    }
    if (isLast) return { axis, most };
    const det = a * c - b * b;
    if (det <= 1e-12 * a * c) continue;
    const [shift, turn] = [(b * v - c * u) / det, (b * u - a * v) / det];
    const through = [0, 1].map((k) => axis.through[k] + across[k] * shift);
    axis =
      axisThrough(
        through,
        [0, 1].map((k) => axis.along[k] + across[k] * turn),
      ) ?? axis;
  }
}

// A function of a point and a guess that returns the nearest sample: along the curve from the guess, and then
// by boxes round samples that follow one another, by which most are seen not to be nearer.
function sampleIndex({ x, y, count }) {
  const IN_BOX = 16;
  const boxes = [];
  for (let first = 0; first < count; first += IN_BOX) {
    const box = [Infinity, -Infinity, Infinity, -Infinity];
    for (let i = first; i < Math.min(first + IN_BOX, count); i++) {
      box[0] = Math.min(box[0], x[i]);
      box[1] = Math.max(box[1], x[i]);
      box[2] = Math.min(box[2], y[i]);
      box[3] = Math.max(box[3], y[i]);
    }
    boxes.push(box);
  }
  return (px, py, guess) => {
    const square = (k) => (x[k] - px) * (x[k] - px) + (y[k] - py) * (y[k] - py);
    let [near, best] = [guess, square(guess)];
    for (const way of [1, count - 1]) {
      for (let next = (near + way) % count; square(next) < best; next = (near + way) % count) {
        [best, near] = [square(next), next];
      }
    }
    boxes.forEach(([x0, x1, y0, y1], k) => {
      const dx = Math.max(x0 - px, px - x1, 0);
      const dy = Math.max(y0 - py, py - y1, 0);
      if (dx * dx + dy * dy >= best) return;
      for (let i = k * IN_BOX; i < Math.min((k + 1) * IN_BOX, count); i++) {
        if (square(i) < best) [best, near] = [square(i), i];
      }
    });
    return near;
  };
}
