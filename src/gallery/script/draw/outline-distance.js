// The distance of a point from an outline.

/** The square of the distance of a point from an outline; infinite if it has no points. @param {number} x @param {number} y */
export function squaredDistance(/** @type {Outline} */ { points, closed }, x, y) {
  const n = points.length;
  let least = n === 2 ? (x - points[0]) ** 2 + (y - points[1]) ** 2 : Infinity;
  for (let b = closed ? 0 : 2; b < n; b += 2) {
    const a = b === 0 ? n - 2 : b - 2;
    const [dx, dy] = [points[b] - points[a], points[b + 1] - points[a + 1]];
    const [u, v] = [x - points[a], y - points[a + 1]];
    const size = dx * dx + dy * dy;
    const t = size > 0 ? Math.min(Math.max((u * dx + v * dy) / size, 0), 1) : 0;
    least = Math.min(least, (u - t * dx) ** 2 + (v - t * dy) ** 2);
  }
  return least;
}
