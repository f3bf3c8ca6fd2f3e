// Tests that thumbnails, which are drawn through few stored points, are the curves: node tests/gallery/thumbnails.mjs FOLDER
//
// FOLDER is that of the atlas of atlas.toml. The curves are solved by the kernel.

import assert from "node:assert/strict";

import { curveBox, curveKey, curveOutline } from "../../src/gallery/script/data/family.js";
import { placedData, smoothData } from "../../src/gallery/script/draw/path-data.js";
import { fittedView, pointPairs, screenPoint } from "../../src/gallery/script/draw/plane-view.js";
import { atlasOf } from "./atlas-data.mjs";
import { kernelOf } from "./kernel.mjs";

const [folder] = process.argv.slice(2);
// The size of a thumbnail, and what is seen, in pixels.
const SIZE = { width: 150, height: 120, margin: 3 };
const SEEN = 0.25;

/** The points of path data in M, L, C and Z, twelve for each Bézier curve. */
function pointsOf(data) {
  const points = [];
  for (const [, kind, text] of data.matchAll(/([MLCZ])([^MLCZ]*)/g)) {
    const n = text.trim().split(" ").map(Number);
    if (kind === "Z") points.push(points[0]);
    else if (kind !== "C") points.push(n);
    else {
      const start = points.at(-1);
      for (let k = 1; k <= 12; k += 1) {
        const [t, u] = [k / 12, 1 - k / 12];
        const at = (i) =>
          u ** 3 * start[i] + 3 * u * u * t * n[i] + 3 * u * t * t * n[2 + i] + t ** 3 * n[4 + i];
        points.push([at(0), at(1)]);
      }
    }
  }
  return points;
}

/** The distance of a point from a polyline. */
function distance([x, y], line) {
  let least = Infinity;
  for (let k = 0; k + 1 < line.length; k += 1) {
    const [[x0, y0], [x1, y1]] = [line[k], line[k + 1]];
    const [dx, dy] = [x1 - x0, y1 - y0];
    const part = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy) || 0;
    const t = Math.min(Math.max(part, 0), 1);
    least = Math.min(least, Math.hypot(x0 + t * dx - x, y0 + t * dy - y));
  }
  return least;
}

/** The greatest distance of either of two polylines from the other one. */
const between = (a, b) =>
  Math.max(...a.map((point) => distance(point, b)), ...b.map((point) => distance(point, a)));

const kernel = await kernelOf(folder);
const found = atlasOf(folder).families.flatMap((family) =>
  Array.from({ length: family.curves.count }, (_, curve) => {
    const view = fittedView(curveBox(family, curve), SIZE);
    const { points, closed } = curveOutline(family, curve);
    const study = kernel.study(kernel.curve(family, curve), { shown: null });
    const exact = pointPairs(study.path(0.05 / view.scale).lead).filter(([x, y]) => Number.isFinite(x + y));
    study.close();
    const truth = exact.map((point) => screenPoint(view, point));
    const [smooth, straight] = [smoothData, placedData].map((draw) =>
      between(truth, pointsOf(draw(points, closed, view))),
    );
    return { name: `${family.id}:${curveKey(family, curve)}`, smooth, straight };
  }),
);
const seen = (drawn) => found.filter((curve) => curve[drawn] > SEEN).length;
const worst = found.reduce((a, b) => (a.smooth > b.smooth ? a : b));
console.log(
  `${found.length} thumbnails: ${seen("smooth")} differ by more than ${SEEN} px, of polygons ${seen("straight")}`,
);
console.log(`the greatest difference is ${worst.smooth.toFixed(2)} px, of ${worst.name}`);
assert.ok(seen("smooth") <= 0.02 * found.length && worst.smooth < 1.5);
// Otherwise the points are so many that this tests nothing.
assert.ok(seen("straight") > 0.1 * found.length);
// An end of an open curve, and a curve of a single point.
assert.equal(smoothData([0, 0, 3, 0], false, { scale: 1, x: 0, y: 0 }), "M0.0 0.0C0.0 0.0 3.0 0.0 3.0 0.0");
assert.equal(smoothData([], true, { scale: 1, x: 0, y: 0 }), "");
