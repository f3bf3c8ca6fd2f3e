// Tests the parts of a plate without a browser: node tests/gallery/plate-parts.mjs FOLDER
//
// FOLDER is that of the atlas of atlas.toml. Prints a line for each test; exits with 1 if one fails.

import assert from "node:assert/strict";
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { Series } from "../../src/gallery/script/data/series.js";
import { clippedData, segmentInBox } from "../../src/gallery/script/draw/clipping.js";
import { fittedView, planePoint, roundBelow, zoomedView } from "../../src/gallery/script/draw/plane-view.js";
import {
  timelineOf,
  followInput,
  nearestPart,
  partOfInput,
  placeAtPart,
  turningParts,
} from "../../src/gallery/script/view/plate/timeline.js";
import { pathsOfStudy, straightSummary } from "../../src/gallery/script/view/plate/paths.js";
import { summaryOfStudy } from "../../src/gallery/script/view/plate/study.js";
import { changeableParameters, roundedToGrain } from "../../src/gallery/script/view/plate/parameters.js";
import {
  plateAddress,
  plateCurveName,
  readPlateQuery,
} from "../../src/gallery/script/view/plate/plate-query.js";
import { fourBarAddress } from "../../src/gallery/script/view/new-view.js";
import { parseAddress } from "../../src/gallery/script/data/address.js";
import { withLinkages } from "../../src/gallery/script/kernel/linkages.js";
import { Pose, recordedValues, studyOf, velocityArrow } from "../../src/gallery/script/view/plate/study.js";
import { familyOf } from "./export-data.mjs";
import { kernelOf } from "./kernel.mjs";

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

const pass = (from, to, isFlat = false) => ({
  from,
  to,
  from_is_flat: isFlat,
  to_is_flat: isFlat,
  sides: [],
});

const kernel = await kernelOf(folder);

/** The study of the first curve of a family with changes, [[name, value], …]. */
const firstStudy = (family, changes = [], ...more) =>
  studyOf(kernel, kernel.curve(family, 0, changes), ...more);

/** The parameters of a family's first curve that can be changed. */
const firstParameters = (family, changes = new Map()) => {
  const recorded = recordedValues(kernel, family, 0);
  const { names } = kernel.family(family).description;
  return changeableParameters(family, names, recorded, firstStudy(family, changes), changes);
};

const linkages = withLinkages({ families: [] }, { load: async () => kernel });
const newFourBar = await linkages.family("new/four-bar");

const tests = [
  [
    "the address of a four-bar that has been found leads to the circuit that it was found on, also of a crank that does not turn fully",
    async () => {
      const lengths = { coupler: 3, rocker: 3.4, along: 1.7, across: 0.8 };
      for (const dimensions of [
        { frame: 4, crank: 1.2 },
        { frame: 8, crank: 2.5 },
        { frame: 3.5, crank: 4 },
      ]) {
        const parameters = { ...dimensions, ...lengths };
        const all = studyOf(kernel, kernel.curve(newFourBar, 0, Object.entries(parameters)), 0).circuits;
        for (let shown = 0; shown < all.length; shown += 1) {
          const found = studyOf(kernel, kernel.curve(newFourBar, 0, Object.entries(parameters)), shown);
          const pose = new Pose();
          const [{ from, to }] = found.circuits[shown].passes;
          pose.move(found, 0, from + 0.3 * (to - from));
          const joint = (name) => [...pose.joints.slice(2 * found.joints.indexOf(name)).subarray(0, 2)];
          const answer = { record: { parameters }, pose: ["O", "C", "A", "B", "M"].flatMap(joint) };
          const { path, query } = parseAddress(
            await fourBarAddress({ atlas: linkages, kernel: { load: async () => kernel } }, answer),
          );
          assert.deepEqual(path, ["new", "four-bar"]);
          assert.equal(Number(query.get("circuit") ?? 1) - 1, shown, JSON.stringify(parameters));
          for (const [name, value] of Object.entries(parameters)) assert.equal(query.number(name), value);
          found.kernel.close();
        }
      }
    },
  ],
  [
    "parameters with the names of what an address says besides are written apart, and read again",
    () => {
      const family = { ...newFourBar, names: ["at", "circuit", "crank", "load", "show"] };
      const changes = new Map(family.names.map((name, k) => [name, k + 2]));
      const state = { changes, requestedCircuit: 1, on: new Set(["names"]), at: { input: 30, pass: 0 } };
      const motion = { joint: null, graph: "speed", rpm: null, load: "3 on C" };
      const address = plateAddress(
        { family, curve: 0, study: null },
        { ...state, locked: new Set(["at"]), motion },
      );
      const { query } = parseAddress(address);
      const read = readPlateQuery(family, null, query);
      assert.equal(query.ignored, "");
      assert.deepEqual(read.changes, changes);
      assert.deepEqual([read.requestedCircuit, read.at, [...read.on]], [1, state.at, ["names"]]);
      assert.deepEqual([read.motion, [...read.locked]], [motion, ["at"]]);
    },
  ],
  [
    "the arrow of a velocity is as long as the way of a radian, and not longer than three tenths of the frame",
    () => {
      const size = { width: 800, height: 500 };
      assert.deepEqual(velocityArrow([3, 4], { by: -1, scale: 10, size }), [-30, 40]);
      assert.deepEqual(velocityArrow([30, 40], { by: 1, scale: 10, size }), [90, -120]);
      assert.equal(velocityArrow([Infinity, 0], { by: 1, scale: 10, size }), null);
    },
  ],
  [
    "a dash covers 3 of every 5 degrees, and the dashes are on the path",
    () => {
      const study = firstStudy(familyOf(folder, "evans"));
      const path = study.kernel.path(1e-5 * study.size);
      const { dashes, lead } = pathsOfStudy(study, path, null, { on: new Set(), isRough: false });
      assert.equal(linesOf(dashes).length, 72);
      const [whole] = linesOf(lead);
      const part = linesOf(dashes).reduce((sum, line) => sum + lengthOf(line), 0) / lengthOf(whole);
      assert.ok(part > 0.55 && part < 0.65, `${part} of the path`);
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
      const timeline = timelineOf({ passes: [pass(-40, 40, true), pass(40, -40, true)], closed: true });
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
      const pose = new Pose();
      for (const id of ids) {
        const study = firstStudy(familyOf(folder, id));
        assert.equal(study.reason, null, `${id}: ${study.reason}`);
        const place = {};
        for (let k = 0; k <= 64; k += 1) {
          placeAtPart(study.timeline, k / 64, place);
          const part = partOfInput(study.timeline, place.pass, place.input);
          assert.ok(Math.abs(part - k / 64) < 1e-7, `${id}: part ${k / 64} became ${part}`);
          pose.move(study, place.pass, place.input);
          assert.equal(pose.joints.length, 2 * study.joints.length, id);
          const at = [...study.kernel.jointPosition(study.joint, place.pass, place.input)];
          const { place: read } = study.kernel.reading(place.pass, place.input);
          for (const axis of [0, 1]) {
            assert.equal(read[axis], pose.joints[2 * study.joint + axis], id);
            assert.ok(Math.abs(at[axis] - read[axis]) < 1e-9 * study.size, `${id}: ${at} is not ${read}`);
          }
        }
        study.kernel.close();
      }
    },
  ],
  [
    "a rough study shows the circuit that a fine one does",
    () => {
      for (const id of ids) {
        const family = familyOf(folder, id);
        const [fine, rough] = [firstStudy(family), firstStudy(family, [], null, true)];
        assert.deepEqual(rough.circuits[rough.shown], fine.circuits[fine.shown], id);
      }
    },
  ],
  [
    "a derived value follows its expression",
    () => {
      const family = familyOf(folder, "evans-straight");
      const { names } = kernel.family(family).description;
      const derived = names.filter((name) => name.is_derived).map(({ name }) => name);
      assert.ok(derived.length > 0);
      const { values } = firstStudy(family);
      // With a parameter changed to its own value, all values stay the same.
      const name = family.names[family.free[0]];
      assert.deepEqual(firstStudy(family, [[name, values[name]]]).values, values);
      const changed = firstStudy(family, [[name, 1.01 * values[name]]]).values;
      assert.ok(derived.some((other) => changed[other] !== values[other]));
      const kinds = new Map(firstParameters(family).map((parameter) => [parameter.name, parameter.kind]));
      for (const other of derived) assert.equal(kinds.get(other), "derived");
    },
  ],
  [
    "the values of a cell are those of the atlas",
    () => {
      for (const id of ids) {
        const family = familyOf(folder, id);
        const count = family.curves.count;
        for (const curve of new Set([0, Math.floor(count / 2), count - 1])) {
          const { values } = recordedValues(kernel, family, curve);
          family.names.forEach((name, slot) => {
            const own = family.cells.values[family.curves.cell[curve] * family.names.length + slot];
            // A name may have no value in a cell.
            if (!Number.isNaN(own)) assert.equal(values[name], own, `${id}: ${name}`);
          });
        }
      }
    },
  ],
  [
    "the kernel goes on after a failure, with families and studies opened again",
    () => {
      const study = firstStudy(familyOf(folder, "watt"));
      const before = study.kernel.reading(0, study.timeline.passes[0].from);
      const failed = kernel.instance;
      const { kernel_allocate: allocate } = failed.exports;
      failed.exports = { ...failed.exports, kernel_pose: () => allocate(-1) };
      assert.throws(() => study.kernel.pose(0, 0), /^Error: the kernel failed: /);
      assert.notEqual(kernel.instance, failed);
      assert.deepEqual(study.kernel.reading(0, study.timeline.passes[0].from), before);
      assert.throws(() => kernel.call({ method: "nothing" }), /there is no request/);
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
      const all = { ...one, table, curves };
      const changes = new Map([["p", 2.5]]);
      const named = (family, shown) =>
        plateCurveName({
          family,
          curve: 0,
          changes,
          study: { home: 0, shown },
          description: { has_all_circuits: family === all },
        });
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
      const study = firstStudy(whole);
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
        for (const { name, low, high, recorded, min, max, grain } of firstParameters(family)) {
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
      const { straight } = firstStudy(family).kernel.measures();
      const { points } = straight;
      const long = Math.hypot(points[points.length - 2] - points[0], points[points.length - 1] - points[1]);
      assert.ok(Math.abs(long - family.curves.measures.straight_length[0]) < 1e-9 * long);
    },
  ],
];

let failed = 0;
for (const [sentence, test] of tests) {
  try {
    await test();
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
