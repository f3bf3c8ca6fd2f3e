// Tests the parts of a plate without a browser: node tests/gallery/plate-parts.mjs FOLDER
//
// FOLDER is that of the atlas of atlas.toml. Prints a line for each test; exits with 1 if one fails.

import assert from "node:assert/strict";
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { Series } from "../../src/gallery/script/data/series.js";
import { circuitPortion } from "../../src/gallery/script/draw/circuit-portion.js";
import { clippedData, segmentInBox } from "../../src/gallery/script/draw/clipping.js";
import { dashData, dashPattern } from "../../src/gallery/script/draw/dashes.js";
import { fittedView, planePoint, roundBelow, zoomedView } from "../../src/gallery/script/draw/plane-view.js";
import { changedValues } from "../../src/gallery/script/kinematics/parameter-changes.js";
import { poseAt } from "../../src/gallery/script/kinematics/poses.js";
import {
  timelineOf,
  followInput,
  nearestPart,
  partOfInput,
  placeAtPart,
  turningParts,
} from "../../src/gallery/script/view/plate/timeline.js";
import { straightSummary } from "../../src/gallery/script/view/plate/paths.js";
import { summaryOfStudy } from "../../src/gallery/script/view/plate/summary.js";
import { changeableParameters, roundedToGrain } from "../../src/gallery/script/view/plate/parameters.js";
import { plateCurveName } from "../../src/gallery/script/view/plate/plate-query.js";
import { PoseSolver } from "../../src/gallery/script/view/plate/pose-solver.js";
import { studyOf } from "../../src/gallery/script/view/plate/study.js";
import { familyOf } from "./export-data.mjs";

const [folder] = process.argv.slice(2);
const ids = readdirSync(folder).filter((id) => existsSync(join(folder, id, "gallery.js")));

/** Polylines [[x, y], …] of path data in M and L. */
const linesOf = (data) =>
  data
    .split("M")
    .filter(Boolean)
    .map((line) => line.split("L").map((pair) => pair.split(" ").map(Number)));

const lengthOf = (line) =>
  line.slice(1).reduce((sum, [x, y], k) => sum + Math.hypot(x - line[k][0], y - line[k][1]), 0);

/** A path along the x-axis, as long as its input, over inputs in turn. */
const straightPath = (...ends) => {
  const inputs = [];
  const points = [];
  const starts = [];
  for (let k = 0; k + 1 < ends.length; k += 1) {
    starts.push(Math.max(inputs.length - 1, 0));
    for (let i = k === 0 ? 0 : 1; i <= 50; i += 1) inputs.push(ends[k] + ((ends[k + 1] - ends[k]) * i) / 50);
  }
  inputs.forEach((at) => points.push(at, 0));
  return { inputs: Float64Array.from(inputs), points: Float64Array.from(points), starts };
};

const pass = (from, to, flats = [0, 0]) => ({
  from,
  to,
  signs: 0,
  begin: { at: from, flat: flats[0] },
  end: { at: to, flat: flats[1] },
});

const tests = [
  [
    "a dash is the first 3 of every 5 degrees, from input 0",
    () => {
      const lines = linesOf(dashData(straightPath(0, 360), dashPattern(5)));
      assert.equal(lines.length, 72);
      lines.forEach((line, k) => {
        // Numbers are written in seven digits.
        assert.ok(Math.abs(line[0][0] - 5 * k) < 1e-4, `dash ${k} begins at ${line[0][0]}`);
        assert.ok(Math.abs(lengthOf(line) - 3) < 2e-4, `dash ${k} is ${lengthOf(line)} long`);
      });
    },
  ],
  [
    "dashes are at the same inputs when the input falls",
    () => {
      const spans = (data) =>
        linesOf(data).map((line) =>
          [line[0][0], line[line.length - 1][0]]
            .map(Math.round)
            .sort((a, b) => a - b)
            .join(),
        );
      const there = spans(dashData(straightPath(-40, 40), dashPattern(5)));
      const back = spans(dashData(straightPath(40, -40), dashPattern(5)));
      assert.deepEqual([...back].sort(), [...there].sort());
      assert.deepEqual(spans(dashData(straightPath(-40, 40, -40), dashPattern(5))), [...there, ...back]);
    },
  ],
  [
    "a polyline is cut at the edges of a box",
    () => {
      assert.deepEqual(segmentInBox(-2, 0, 2, 0, [-1, -1, 1, 1]), [-1, 0, 1, 0]);
      assert.equal(segmentInBox(-2, 2, 2, 2, [-1, -1, 1, 1]), null);
      assert.equal(segmentInBox(0, NaN, 2, 2, [-1, -1, 1, 1]), null);
      assert.equal(clippedData([0, 0, 1e9, 1e9, 0, 0.5], [-1, -1, 1, 1]), "M0 0L1 1M0.5 1L0 0.5");
    },
  ],
  [
    "a view fits a box, keeps the point it zooms about, and can be inverted",
    () => {
      const view = fittedView([-1, 2, 3, 4], { width: 400, height: 400, margin: 40 });
      assert.equal(view.scale, 80);
      assert.deepEqual(planePoint(view, [200, 200]), [1, 3]);
      const near = zoomedView(view, 2.5, [90, 120]);
      planePoint(near, [90, 120]).forEach((x, k) =>
        assert.ok(Math.abs(x - planePoint(view, [90, 120])[k]) < 1e-12),
      );
      assert.deepEqual([0.99, 1, 4.9, 73, 0.0021].map(roundBelow), [0.5, 1, 2, 50, 0.002]);
    },
  ],
  [
    "a crank continues from turn to turn, and the input with it",
    () => {
      const timeline = timelineOf({ passes: [pass(0, 360)], closed: true });
      const place = { pass: 0, input: 350 };
      assert.equal(followInput(timeline, place, 370, 3), 10);
      assert.equal(place.input, 10);
      assert.equal(followInput(timeline, place, -725, 3), 355);
      assert.deepEqual(turningParts(timeline), []);
    },
  ],
  [
    "a crank stays at a limit, and comes back on the other branch when it was pushed",
    () => {
      const timeline = timelineOf({ passes: [pass(-40, 40, [1, 1]), pass(40, -40, [1, 1])], closed: true });
      const place = { pass: 0, input: 30 };
      followInput(timeline, place, 42, 3);
      assert.deepEqual([place.pass, place.input], [0, 40]);
      followInput(timeline, place, 35, 3);
      assert.deepEqual([place.pass, place.input], [0, 35]);
      followInput(timeline, place, 50, 3);
      followInput(timeline, place, 60, 3);
      assert.deepEqual([place.pass, place.input], [1, 40]);
      followInput(timeline, place, 30, 3);
      assert.deepEqual([place.pass, place.input], [1, 30]);
      followInput(timeline, place, -60, 3);
      followInput(timeline, place, -30, 3);
      assert.deepEqual([place.pass, place.input], [0, -30]);
      assert.deepEqual(turningParts(timeline), [0, 0.5]);
    },
  ],
  [
    "the ends of an open timeline are kept",
    () => {
      const timeline = timelineOf({ passes: [pass(10, 80)], closed: false });
      const place = { pass: 0, input: 30 };
      followInput(timeline, place, 100, 3);
      assert.deepEqual([place.pass, place.input], [0, 80]);
      assert.deepEqual(turningParts(timeline), [0, 1]);
      const nearest = nearestPart(timeline, 0.9, (part) => Math.abs(part - 0.97), 0.15);
      assert.ok(Math.abs(nearest - 0.97) < 1e-6);
    },
  ],
  [
    "positions by fraction and by input agree on every linkage, and so do poses",
    () => {
      for (const id of ids) {
        const study = studyOf(familyOf(folder, id), 0, new Map());
        assert.equal(study.reason, undefined, `${id}: ${study.reason}`);
        const poser = new PoseSolver(study.linkage);
        const place = {};
        for (let k = 0; k <= 64; k += 1) {
          placeAtPart(study.timeline, k / 64, place);
          const part = partOfInput(study.timeline, place.pass, place.input);
          assert.ok(Math.abs(part - k / 64) < 1e-7, `${id}: part ${k / 64} became ${part}`);
          const on = study.timeline.passes[place.pass];
          assert.deepEqual(
            [...poser.solve(on, place.input)],
            [...poseAt(study.linkage, on, place.input)],
            id,
          );
        }
      }
    },
  ],
  [
    "a rough study shows the circuit that a fine one does",
    () => {
      for (const id of ids) {
        const family = familyOf(folder, id);
        const fine = studyOf(family, 0, new Map());
        const rough = studyOf(family, 0, new Map(), null, true);
        assert.deepEqual(
          rough.routes[rough.shown].passes.map(({ from, to, signs }) => [from, to, signs]),
          fine.routes[fine.shown].passes.map(({ from, to, signs }) => [from, to, signs]),
          id,
        );
      }
    },
  ],
  [
    "a derived value follows its expression",
    () => {
      const family = familyOf(folder, "evans-straight");
      const slots = family.derived.filter(([, expression]) => typeof expression !== "number");
      assert.ok(slots.length > 0);
      const recorded = changedValues(family, 3, new Map());
      // With a parameter changed to its own value, all values stay the same.
      const name = family.names[family.free[0]];
      const same = changedValues(family, 3, new Map([[name, recorded[family.free[0]]]]));
      recorded.forEach((value, slot) =>
        assert.ok(Math.abs(same[slot] - value) <= 1e-14 * Math.abs(value), family.names[slot]),
      );
      const kinds = new Map(
        changeableParameters(family, 3, 1, new Map()).map((parameter) => [parameter.name, parameter.kind]),
      );
      for (const [slot] of slots) assert.equal(kinds.get(family.names[slot]), "derived");
    },
  ],
  [
    "an export is of the circuit that is shown, by its number if the atlas does not have it",
    () => {
      const one = familyOf(folder, "evans");
      // The first cell, with two circuits.
      const table = new Series("evans", "table", [{ bytes: 0, cells: 1, curves: 2, numbers: [1, 1] }]);
      table.pieces[0].data = {};
      const curves = { ...one.curves, cell: [0, 0], trace: [1, 1], circuit: [1, 2] };
      const all = { ...one, template: { ...one.template, circuits: "all" }, table, curves };
      const changes = new Map([["p", 2.5]]);
      const named = (family, shown) =>
        plateCurveName({ family, curve: 0, changes, study: { home: 0, shown } });
      assert.equal(named(all, 0), "evans:1.1.1?p=2.5");
      assert.equal(named(all, 1), "evans:1.1.2?p=2.5");
      assert.equal(named(all, 2), "evans:1.1.1?p=2.5&circuit=3", "a curve that is not there");
      assert.equal(named(one, 1), "evans:1.1.1?p=2.5&circuit=2", "the atlas takes one circuit alone");
      assert.equal(plateCurveName({ family: all, curve: 0, changes: new Map(), study: null }), "evans:1.1.1");
    },
  ],
  [
    "a family that is measured only in part is described without the other measures",
    () => {
      const whole = familyOf(folder, "evans");
      const measured = (...names) => {
        const measures = Object.fromEntries(names.map((name) => [name, whole.curves.measures[name]]));
        return { ...whole, curves: { ...whole.curves, measures } };
      };
      const study = studyOf(whole, 0, new Map());
      const summary = (family) => summaryOfStudy(family, 0, study, true);
      assert.match(summary(whole), /straightest portion .* Transmission angle from /);
      assert.doesNotMatch(summary(measured("mu_min_deg", "straight_length")), /straightest|Transmission/);
      assert.match(summary(measured("mu_min_deg", "mu_max_deg")), /Transmission angle from /);
      assert.notEqual(straightSummary(study, whole, 0, null), "");
      assert.equal(straightSummary(study, measured("straight_length"), 0, null), "");
    },
  ],
  [
    "ranges contain the values of the atlas, and no value out of bounds",
    () => {
      for (const id of ids) {
        const family = familyOf(folder, id);
        for (const { name, low, high, recorded, min, max, grain } of changeableParameters(
          family,
          0,
          1,
          new Map(),
        )) {
          assert.ok(
            low <= recorded && recorded <= high && low < high && grain > 0,
            `${id}: ${name} from ${low} to ${high}`,
          );
          assert.ok(min === null || (min === 0 ? low > 0 : low >= min), `${id}: ${name} from ${low}`);
          assert.ok(max === null || high <= max, `${id}: ${name} to ${high}`);
        }
      }
      assert.equal(roundedToGrain(2.4999999, 0.01), 2.5);
      assert.equal(roundedToGrain(-0.123456, 0.002), -0.124);
    },
  ],
  [
    "the straight portion of Peaucellier's inversor is the whole of its line",
    () => {
      const family = familyOf(folder, "peaucellier-lipkin");
      const { linkage, circuit, joint, timeline } = studyOf(family, 0, new Map());
      const { from, to } = timeline.passes[0];
      const { points } = circuitPortion(linkage, circuit, joint, {
        start: from,
        span: to - from,
        length: family.curves.measures.straight_length[0],
      });
      const long = Math.hypot(points[points.length - 2] - points[0], points[points.length - 1] - points[1]);
      assert.ok(Math.abs(long - family.curves.measures.straight_length[0]) < 1e-9 * long);
    },
  ],
];

let failed = 0;
for (const [sentence, test] of tests) {
  try {
    test();
    console.log(`ok ${sentence}`);
  } catch (error) {
    failed += 1;
    console.log(
      `FAILED ${sentence}\n  ${String(error.stack ?? error)
        .split("\n")
        .slice(0, 8)
        .join("\n  ")}`,
    );
  }
}
process.exitCode = failed ? 1 : 0;
