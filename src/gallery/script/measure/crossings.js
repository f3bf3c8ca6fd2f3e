// Finds the crunodes of a curve, by the chords between its samples.

import { chordLengthAfter, neighbourSample } from "./sampled-curve.js";

/** The points where a curve crosses itself, [[x, y], …], in the order of the first pass through each. */
export function findCrunodes(curve) {
  const { intervals: n, x } = curve;
  const next = Array.from({ length: n }, (_, i) => neighbourSample(curve, i, 1));
  const low = next.map((to, i) => Math.min(x[i], x[to]));
  const high = next.map((to, i) => Math.max(x[i], x[to]));
  const order = next.map((_, i) => i).sort((a, b) => low[a] - low[b]);
  const found = [];
  for (let k = 0; k < n; k++) {
    const i = order[k];
    for (let m = k + 1; m < n && low[order[m]] <= high[i]; m++) {
      const j = order[m];
      if (next[i] === j || next[j] === i) continue;
      const crossing = chordCrossing(curve, i, next[i], j, next[j]);
      if (crossing && isCrossing(curve, [i, j], next, crossing.parts))
        found.push([Math.min(i, j), crossing.at]);
    }
  }
  found.sort((a, b) => a[0] - b[0]);
  let size = 0;
  for (let i = 0; i < n; i++) size = Math.max(size, chordLengthAfter(curve, i));
  const places = [];
  for (const [, at] of found) {
    // A sample that the curve goes through twice is the end of four chords.
    if (places.every((other) => Math.hypot(other[0] - at[0], other[1] - at[1]) > 1e-9 * size))
      places.push(at);
  }
  return places;
}

// Where two chords cross, and what part of each is before that. One that ends on the other counts as to its
// left, so that a crossing at a sample counts once.
function chordCrossing({ x, y }, a, b, c, d) {
  const [ux, uy, vx, vy] = [x[b] - x[a], y[b] - y[a], x[d] - x[c], y[d] - y[c]];
  const isLeftOfFirst = (p) => ux * (y[p] - y[a]) - uy * (x[p] - x[a]) >= 0;
  if (isLeftOfFirst(c) === isLeftOfFirst(d)) return null;
  const isLeftOfSecond = (p) => vx * (y[p] - y[c]) - vy * (x[p] - x[c]) >= 0;
  if (isLeftOfSecond(a) === isLeftOfSecond(b)) return null;
  const [wx, wy] = [x[c] - x[a], y[c] - y[a]];
  const area = ux * vy - uy * vx;
  const parts = [(wx * vy - wy * vx) / area, (wx * uy - wy * ux) / area];
  return Number.isFinite(parts[0]) ? { at: [x[a] + ux * parts[0], y[a] + uy * parts[0]], parts } : null;
}

// Whether the curve goes through the crossing of two chords in two directions. Where it goes forth and back
// on one path, as a rocker's pin does, chords of that path cross too.
function isCrossing({ x, y, curvatures }, chords, next, parts) {
  const [a, b] = chords.map((i, k) => {
    const [dx, dy] = [x[next[i]] - x[i], y[next[i]] - y[i]];
    const turned =
      ((curvatures[i] + curvatures[next[i]]) / 2) * Math.sqrt(dx * dx + dy * dy) * (parts[k] - 0.5);
    const [cos, sin] = [Math.cos(turned), Math.sin(turned)];
    return [cos * dx - sin * dy, cos * dy + sin * dx];
  });
  return Math.abs(a[0] * b[1] - a[1] * b[0]) > 1e-3 * Math.hypot(...a) * Math.hypot(...b);
}
