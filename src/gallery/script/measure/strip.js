// Computes the narrowest strip between two parallel lines that encloses points: { width, length, along }, its
// width, the length of the points' projection on it, and its direction. Rows of points are arrays x and y,
// from `first` up to, not with, `last`.

import { exchangePoint } from "./remez.js";
import { convexHull } from "./hull.js";

/** The strip of at least one point. */
export function enclosingStrip(x, y, first, last) {
  return stripOfHull(convexHull(x, y, first, last));
}

/**
 * The strip of a row of points in roughly one direction; may be null if it is wider than `most`. One edge
 * goes through two of three points, and the other through the one between: three are exchanged for others
 * until no point is outside. Begun with `three`, which are those of the strip afterwards.
 */
export function stripByExchange(x, y, first, last, three, most) {
  // Of wider strips, by their length, the narrowest may go through other points.
  const [ROUNDS, THIN] = [12, 1 / 300];
  for (let round = 0; round < ROUNDS; round++) {
    const [a, b, c] = three;
    const least = triangleHeight(x, y, a, b, c);
    if (least > most) return null;
    const [sx, sy, ax, ay] = [x[c] - x[a], y[c] - y[a], x[a], y[a]];
    const length = Math.sqrt(sx * sx + sy * sy);
    let [low, high, lowest, highest] = [Infinity, -Infinity, first, first];
    for (let i = first; i < last; i++) {
      const area = sx * (y[i] - ay) - sy * (x[i] - ax);
      if (area < low) [low, lowest] = [area, i];
      if (area > high) [high, highest] = [area, i];
    }
    const width = (high - low) / length;
    if (width <= least * (1 + 1e-12) || (Number.isFinite(most) && width <= most)) {
      const along = [sx / length, sy / length];
      const reach = lengthAlong(x, y, first, last, along);
      if (width > THIN * reach) break;
      return { width, length: reach, along };
    }
    // The one that is furthest outside.
    const own = sx * (y[b] - ay) - sy * (x[b] - ax);
    const isHigh = high - Math.max(own, 0) > Math.min(own, 0) - low;
    const added = isHigh ? highest : lowest;
    const outside = isHigh ? high : low;
    const next = exchangePoint(three, added, (k) => (k === 1) === (outside > 0 === own > 0));
    for (let k = 0; k < 3; k++) three[k] = next[k];
  }
  const strip = enclosingStrip(x, y, first, last);
  return strip.width <= most ? strip : null;
}

function lengthAlong(x, y, first, last, [ux, uy]) {
  let [low, high] = [Infinity, -Infinity];
  for (let i = first; i < last; i++) {
    const at = ux * (x[i] - x[first]) + uy * (y[i] - y[first]);
    if (at < low) low = at;
    if (at > high) high = at;
  }
  return high - low;
}

// Of a convex polygon: one of its sides lies on an edge of the strip.
function stripOfHull({ x, y, count }) {
  const [ex, ey] = [x[count - 1] - x[0], y[count - 1] - y[0]];
  if (count <= 2) {
    // A line, or a point.
    const length = Math.sqrt(ex * ex + ey * ey);
    return { width: 0, length, along: length > 0 ? [ex / length, ey / length] : [1, 0] };
  }
  const next = (i) => (i + 1 < count ? i + 1 : 0);
  let best = { width: Infinity, along: [1, 0] };
  let far = 1;
  for (let k = 0; k < count; k++) {
    const to = next(k);
    const [sx, sy] = [x[to] - x[k], y[to] - y[k]];
    const height = (i) => sx * (y[i] - y[k]) - sy * (x[i] - x[k]);
    if (far === k) far = to;
    while (height(next(far)) > height(far)) far = next(far);
    const length = Math.sqrt(sx * sx + sy * sy);
    const width = Math.max(height(far), 0) / length;
    // Sides of a hull have a length.
    if (width < best.width) best = { width, along: [sx / length, sy / length] };
  }
  return { ...best, length: lengthAlong(x, y, 0, count, best.along) };
}

/** The least height of a triangle of three points of a row. */
export function triangleHeight(x, y, a, b, c) {
  const [ux, uy, vx, vy] = [x[b] - x[a], y[b] - y[a], x[c] - x[a], y[c] - y[a]];
  const [wx, wy] = [x[c] - x[b], y[c] - y[b]];
  const longest = Math.max(ux * ux + uy * uy, wx * wx + wy * wy, vx * vx + vy * vy);
  return longest > 0 ? Math.abs(ux * vy - uy * vx) / Math.sqrt(longest) : 0;
}
