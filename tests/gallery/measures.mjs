// Tests the page's measures against closed forms: node tests/gallery/measures.mjs

import assert from "node:assert/strict";
import { test } from "node:test";

import { motionOf } from "../../src/gallery/script/kinematics/motion.js";
import { posesAt } from "../../src/gallery/script/kinematics/poses.js";
import { linkageOf } from "../../src/gallery/script/kinematics/template.js";
import { measuresOf } from "../../src/gallery/script/measure/measures.js";

const evans = ([p, r, a, s, k]) => ({
  joints: [
    { name: "O", fixed: [0, 0] },
    { name: "C", fixed: [p, 0] },
    { name: "A", crank: 0, length: r },
    { name: "B", dyad: [2, 1], lengths: [a, s], side: 1 },
    { name: "M", point: [2, 3], along: k * a, across: 0 },
  ],
  trace: [4],
});

function measured(template, joint, sampling = { step: 2 }, options = {}) {
  const linkage = linkageOf(template, []);
  const motion = motionOf(linkage, sampling);
  return { linkage, motion, found: measuresOf(linkage, motion, motion.circuits[0], joint, options) };
}

const close = (a, b, tolerance, what) =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what ?? ""} ${a} is not ${b}`);

test("a circle is measured exactly", () => {
  const { found } = measured(evans([4, 1.5, 4, 4.5, 2]), 2);
  // Over a degree the rounding of a position is a part in 1e14 of the length, and of the curvature a part in
  // 1e12.
  close(found.length, 3 * Math.PI, 1e-12);
  close(found.area, 2.25 * Math.PI, 1e-12);
  close(found.curvature_max, 1 / 1.5, 1e-12);
  close(found.speed_ratio, 1, 1e-12);
  close(found.dwell_radius, 1.5, 1e-10);
  assert.deepEqual([found.dwell_input_deg, found.cusps, found.crunodes, found.inflections], [360, 0, 0, 0]);
  assert.deepEqual(
    [found.symmetry, found.symmetry_deg, found.input_min_deg],
    ["other", undefined, undefined],
  );
  [found.bbox_x_min, found.bbox_x_max, found.bbox_y_min, found.bbox_y_max].forEach((at, k) => {
    close(at, k % 2 === 0 ? -1.5 : 1.5, 1e-12);
  });
});

test("a crank-rocker has the class, the angles and the time ratio of its triangles", () => {
  const { found } = measured(evans([4, 1, 3, 3.5, 0.5]), 4);
  const angle = (d) => (Math.acos((9 + 12.25 - d * d) / 21) * 180) / Math.PI;
  close(found.mu_min_deg, angle(3), 1e-11);
  close(found.mu_max_deg, angle(5), 1e-11);
  const dead = (reach) => (Math.acos((16 + reach * reach - 12.25) / (8 * reach)) * 180) / Math.PI;
  const between = 180 + dead(2) - dead(4);
  close(found.time_ratio, Math.max(between / (360 - between), (360 - between) / between), 1e-12);
  assert.deepEqual([found.class, found.type, found.shortest], ["crank-rocker", "crank-rocker", "crank"]);
});

test("a straight portion fits its tolerance, and no longer one around it does", () => {
  const tolerance = 0.001;
  const { linkage, motion, found } = measured(evans([2, 1, 2.59, 2.59, 2]), 4);
  close((2 * found.straight_deviation) / found.straight_length, tolerance, 1e-6);
  const [pass] = motion.circuits[0].passes;
  const width = (from, to) => {
    const inputs = Array.from({ length: 401 }, (_, k) => from + ((to - from) * k) / 400);
    const { x, y } = posesAt(linkage, pass, inputs);
    return narrowestBand(x[4], y[4]);
  };
  const [from, to] = [found.straight_start_deg, found.straight_start_deg + found.straight_input_deg];
  const own = width(from, to);
  close(own.width / own.length, tolerance, 1e-6);
  for (const more of [0.2, 0.4]) {
    const longer = width(from - more, to + more);
    assert.ok(longer.width > tolerance * longer.length, `${more} deg more at either end`);
  }
});

// The narrowest band of a nearly straight row, by varying its direction: the width is convex in the angle
// there.
function narrowestBand(x, y) {
  const chord = Math.atan2(y[y.length - 1] - y[0], x[x.length - 1] - x[0]);
  const reach = (cos, sin) => {
    const along = x.map((at, k) => at * cos + y[k] * sin);
    return Math.max(...along) - Math.min(...along);
  };
  let [a, b] = [chord - 0.05, chord + 0.05];
  const width = (angle) => reach(-Math.sin(angle), Math.cos(angle));
  for (let round = 0; round < 40; round++) {
    const [c, d] = [a + (b - a) / 3, b - (b - a) / 3];
    if (width(c) < width(d)) b = d;
    else a = c;
  }
  return { width: width(a), length: reach(Math.cos(a), Math.sin(a)) };
}

test("a circular portion fits its annulus", () => {
  const { linkage, motion, found } = measured(evans([4, 1, 3, 3.5, 0.5]), 4);
  const [{ passes, x, y, count }] = motion.circuits;
  let extent = 0;
  for (let i = 0; i < count; i++) {
    for (let j = 0; j < i; j++) extent = Math.max(extent, Math.hypot(x[4][i] - x[4][j], y[4][i] - y[4][j]));
  }
  // The annulus has the greatest allowed width; the extent is exact to second order in the spacing of
  // samples.
  close(found.dwell_deviation / extent, 0.0005, 1e-6);
  const step = found.dwell_input_deg / 500;
  const places = posesAt(
    linkage,
    passes[0],
    Array.from({ length: 501 }, (_, k) => found.dwell_start_deg + k * step),
  );
  places.x[4].forEach((at, k) => {
    const radius = Math.hypot(at - found.dwell_x, places.y[4][k] - found.dwell_y);
    // Between the points used in the search the curve leaves the annulus by a few parts in a thousand at
    // most.
    assert.ok(Math.abs(radius - found.dwell_radius) <= 1.005 * found.dwell_deviation, `part ${k}`);
  });
});

test("a straight portion of a given span or length has it", () => {
  const span = measured(evans([2, 1, 2.59, 2.59, 2]), 4, { step: 2 }, { straight: { input: 90 } }).found;
  close(span.straight_input_deg, 90, 1e-9);
  const length = measured(evans([2, 1, 2.59, 2.59, 2]), 4, { step: 2 }, { straight: { length: 1.5 } }).found;
  close(length.straight_length, 1.5, 1e-6);
});

test("Evans's curve is symmetrical by theorem 2", () => {
  const { found } = measured(evans([2, 1, 2.59, 2.59, 2]), 4);
  assert.equal(found.symmetry, "theorem 2");
  close(found.symmetry_deg, 90, 1e-12);
  close(found.symmetry_residual, 0, 1e-12);
});

test("measures scale with the size of a linkage", () => {
  const one = measured(evans([4, 1, 3, 3.5, 0.5]), 4).found;
  const ten = measured(evans([40, 10, 30, 35, 0.5]), 4).found;
  for (const name of ["length", "bbox_x_max", "straight_length", "dwell_radius"]) {
    close(ten[name] / one[name], 10, 1e-5, name);
  }
  close(ten.area / one.area, 100, 1e-9);
  close(ten.curvature_max / one.curvature_max, 0.1, 1e-12);
});
