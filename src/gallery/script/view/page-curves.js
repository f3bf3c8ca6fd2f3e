// Finds the curve of a page at a position.

import { curvePoints } from "../data/family.js";

/**
 * The curves of a page's views on paper: [{ curve, view, points, box }], with points [x0, y0, …] and box [x0,
 * y0, x1, y1] in millimetres, y down.
 */
export function curvesOnPaper(family, views) {
  return views.flatMap((view) =>
    view.curves.map((curve) => {
      const points = curvePoints(family, curve);
      const box = [Infinity, Infinity, -Infinity, -Infinity];
      for (let k = 0; k < points.length; k += 2) {
        points[k] = view.origin[0] + view.scale * points[k];
        points[k + 1] = view.origin[1] - view.scale * points[k + 1];
        box[0] = Math.min(box[0], points[k]);
        box[1] = Math.min(box[1], points[k + 1]);
        box[2] = Math.max(box[2], points[k]);
        box[3] = Math.max(box[3], points[k + 1]);
      }
      return { curve, view, points, box, closed: family.curves.closed[curve] === 1 };
    }),
  );
}

/** The curve of `drawn` nearest to a position in millimetres, within `reach`; undefined if there is none. */
export function nearestCurve(drawn, [x, y], reach) {
  let nearest;
  let least = reach * reach;
  for (const candidate of drawn) {
    const [x0, y0, x1, y1] = candidate.box;
    if (x < x0 - reach || x > x1 + reach || y < y0 - reach || y > y1 + reach) continue;
    const square = squaredDistanceToPolyline(candidate, x, y);
    if (square <= least) [nearest, least] = [candidate, square];
  }
  return nearest;
}

function squaredDistanceToPolyline({ points, closed }, x, y) {
  const n = points.length;
  if (n === 0) return Infinity;
  let least = n === 2 ? (x - points[0]) ** 2 + (y - points[1]) ** 2 : Infinity;
  for (let k = closed ? 0 : 2; k < n; k += 2) {
    const from = k === 0 ? n - 2 : k - 2;
    const segment = [points[from], points[from + 1], points[k], points[k + 1]];
    least = Math.min(least, squaredDistanceToSegment(x, y, ...segment));
  }
  return least;
}

/** The squared distance of a point from a segment. */
function squaredDistanceToSegment(x, y, x0, y0, x1, y1) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const length = dx * dx + dy * dy;
  const part = length > 0 ? Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / length, 0), 1) : 0;
  return (x - x0 - part * dx) ** 2 + (y - y0 - part * dy) ** 2;
}
