// The convex hull of some points and its greatest extent.

/**
 * The corners of the convex hull of the points `first` up to, not with, `last` of a row, counter-clockwise:
 * { x, y, count } in arrays of numbers.
 */
export function convexHull(px, py, first, last) {
  const order = [];
  for (let i = first; i < last; i++) order.push(i);
  // Points of a nearly straight portion are in order along x or y already, and sorting them again costs
  // little.
  const [ex, ey] = [px[last - 1] - px[first], py[last - 1] - py[first]];
  if (Math.abs(ex) >= Math.abs(ey)) order.sort((a, b) => px[a] - px[b] || py[a] - py[b]);
  else order.sort((a, b) => py[a] - py[b] || px[b] - px[a]);
  const [x, y] = [[], []];
  const half = () => {
    const start = x.length;
    for (const i of order) {
      let n = x.length;
      while (n >= start + 2) {
        const [ax, ay, bx, by] = [x[n - 2], y[n - 2], x[n - 1], y[n - 1]];
        if ((bx - ax) * (py[i] - by) - (by - ay) * (px[i] - bx) > 0) break;
        x.pop();
        y.pop();
        n -= 1;
      }
      x.push(px[i]);
      y.push(py[i]);
    }
    x.pop();
    y.pop();
  };
  half();
  order.reverse();
  half();
  if (x.length === 0 && order.length > 0) return { x: [px[order[0]]], y: [py[order[0]]], count: 1 };
  return { x, y, count: x.length };
}

/** The greatest distance between two corners of a convex polygon. */
export function hullDiameter({ x, y, count }) {
  const next = (i) => (i + 1 < count ? i + 1 : 0);
  const square = (i, j) => (x[i] - x[j]) * (x[i] - x[j]) + (y[i] - y[j]) * (y[i] - y[j]);
  let [far, most] = [next(0), 0];
  for (let k = 0; k < count; k++) {
    const to = next(k);
    const [sx, sy] = [x[to] - x[k], y[to] - y[k]];
    // The corners that are furthest from a side are those that may be furthest from its ends.
    for (let round = 0; round < count; round++) {
      most = Math.max(most, square(far, k), square(far, to));
      const on = next(far);
      if (sx * (y[on] - y[far]) - sy * (x[on] - x[far]) <= 0) break;
      far = on;
    }
  }
  return Math.sqrt(most);
}
