// Tests the page's solver against closed forms and independent computations: node
// tests/gallery/kinematics.mjs

import assert from "node:assert/strict";
import { test } from "node:test";

import { cosSinOfDegrees, radiansOf } from "../../src/gallery/script/kinematics/angles.js";
import { LinkageError } from "../../src/gallery/script/kinematics/linkage-builder.js";
import { cognatePins, cognatesOf } from "../../src/gallery/script/kinematics/cognates.js";
import { evaluateExpression } from "../../src/gallery/script/kinematics/expression.js";
import { fourBarOf, transmissionAt } from "../../src/gallery/script/kinematics/four-bar.js";
import {
  fixedCentrode,
  movingCentrode,
  poleAt,
} from "../../src/gallery/script/kinematics/instantaneous-motion.js";
import { motionOf } from "../../src/gallery/script/kinematics/motion.js";
import { finePath } from "../../src/gallery/script/kinematics/path.js";
import { poseAt, ratesAt } from "../../src/gallery/script/kinematics/poses.js";
import { multiplesOf } from "../../src/gallery/script/kinematics/sampling.js";
import { linkageOf } from "../../src/gallery/script/kinematics/template.js";

const fourBar = ([frame, crank, coupler, rocker], travel = {}) => ({
  parameters: [],
  joints: [
    { name: "O", fixed: [0, 0] },
    { name: "C", fixed: [frame, 0] },
    { name: "A", crank: 0, length: crank },
    { name: "B", dyad: [2, 1], lengths: [coupler, rocker], side: 1 },
    { name: "M", point: [2, 3], along: coupler / 3, across: coupler / 4 },
  ],
  trace: [4],
  circuits: "all",
  ...travel,
});

// A six-bar: a second dyad on the coupler point, which does not connect crank and frame.
const sixBar = () => {
  const template = fourBar([4, 1, 3, 3.5]);
  template.joints.push(
    { name: "Q", fixed: [-1, 2] },
    { name: "E", dyad: [4, 5], lengths: [2.2, 2.4], side: -1 },
    { name: "N", point: [4, 6], distances: [1.5, 1], side: 1 },
  );
  return { ...template, trace: [7] };
};

const close = (a, b, tolerance, what) =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what ?? ""} ${a} is not ${b}`);
const pointOf = (pose, joint) => [pose[2 * joint], pose[2 * joint + 1]];
const distance = ([ax, ay], [bx, by]) => Math.hypot(bx - ax, by - ay);

test("expressions are programs for a stack machine", () => {
  assert.equal(evaluateExpression([2, 3, 2, "^", "^"], []), 512);
  assert.equal(evaluateExpression([2, 2, "^", "neg"], []), -4);
  assert.equal(evaluateExpression([[1], [0], "-"], [2, 5]), 3);
  assert.equal(evaluateExpression([3, 4, "hypot/2", 6, "max/2"], []), 6);
  assert.equal(evaluateExpression([NaN, 1, "!="], []), 0);
  assert.equal(evaluateExpression([1, 2, "<", 3, 3, "==", "and"], []), 1);
  assert.ok(Number.isNaN(evaluateExpression([NaN, 1, "min/2"], [])));
  assert.equal(evaluateExpression([1, NaN, "^"], []), 1);
});

test("quarter turns are exact, and multiples are correctly rounded decimals", () => {
  assert.deepEqual(
    [0, 90, 180, 270, -90, 810]
      .map(cosSinOfDegrees)
      .flat()
      .map((x) => x + 0),
    [1, 0, 0, 1, -1, 0, 0, -1, 0, -1, 0, 1],
  );
  assert.deepEqual(multiplesOf(0.1, 0, 0.45), [0, 0.1, 0.2, 0.3, 0.4]);
  assert.deepEqual(multiplesOf(2, -3, 3), [-2, 0, 2]);
});

test("circuits of four-bars of every class agree with their limits", () => {
  const passes = (lengths, travel) =>
    motionOf(linkageOf(fourBar(lengths, travel), []), { samples: 12 }).circuits.map(
      ({ passes: all, branch }) => [
        all.map(({ from, to }) => [Math.round(from * 1e3), Math.round(to * 1e3)]),
        branch(1),
      ],
    );
  assert.deepEqual(passes([4, 1, 3, 3.5]), [
    [[[0, 360000]], 1],
    [[[0, 360000]], -1],
  ]);
  // cos = (16 + 9 - (3 -+ 1)^2) / 24
  const [inner, outer] = [21 / 24, 9 / 24].map((c) => Math.round((Math.acos(c) * 180e3) / Math.PI));
  assert.deepEqual(
    passes([4, 3, 1, 3]).map(([all]) => all),
    [
      [
        [-outer, -inner],
        [-inner, -outer],
      ],
      [
        [inner, outer],
        [outer, inner],
      ],
    ],
  );
  // Extended at 180: two turns if continued smoothly, else a turn on each branch.
  assert.deepEqual(
    passes([3, 1, 2, 2]).map(([all]) => all),
    [
      [
        [0, 180000],
        [180000, 540000],
        [540000, 720000],
      ],
    ],
  );
  assert.equal(passes([3, 1, 2, 2], { continuation: "branch" }).length, 2);
  assert.equal(motionOf(linkageOf(fourBar([9, 1, 2, 2]), []), { step: 2 }).circuits.length, 0);
});

test("links keep their lengths at every sample, limits among them", () => {
  for (const template of [fourBar([4, 2, 2, 2]), fourBar([2, 2, 3, 3]), sixBar()]) {
    const linkage = linkageOf(template, []);
    const { circuits } = motionOf(linkage, { samples: 90, spacing: "smooth" });
    assert.ok(circuits.length > 0);
    for (const { x, y, count } of circuits) {
      for (const link of linkage.links) {
        for (let k = 1; k < link.length; k++) {
          const [p, q] = [link[k - 1], link[k]];
          const length = Math.hypot(q.x - p.x, q.y - p.y);
          for (let i = 0; i < count; i++) {
            const found = Math.hypot(x[q.joint][i] - x[p.joint][i], y[q.joint][i] - y[p.joint][i]);
            close(found, length, 1e-12, `sample ${i}`);
          }
        }
      }
    }
  }
});

test("at a limit the dyad lies flat", () => {
  const linkage = linkageOf(fourBar([4, 2, 2, 2]), []);
  const [{ passes }] = motionOf(linkage, { step: 5 }).circuits;
  const pose = poseAt(linkage, passes[0], passes[0].to);
  const [a, b, c] = [2, 3, 1].map((joint) => pointOf(pose, joint));
  // To the rounding of places of the size of the linkage.
  close((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0, 4e-15);
});

test("at a limit found by search the dyad lies flat, and nothing closes beyond it", () => {
  const template = sixBar();
  // The second dyad is too short to follow all the way round.
  template.joints[6].lengths = [1.2, 1.4];
  const linkage = linkageOf(template, []);
  const { circuits } = motionOf(linkage, { step: 3 });
  const passes = circuits.flatMap((circuit) => circuit.passes);
  const limits = passes.flatMap((pass) => [pass.begin, pass.end].map((end) => ({ pass, end })));
  const searched = limits.filter(({ end }) => (end.flat >> 1) & 1);
  assert.ok(searched.length > 0);
  const apart = (pass, input) => {
    const pose = poseAt(linkage, pass, input);
    return distance(pointOf(pose, 4), pointOf(pose, 5));
  };
  for (const { pass, end } of searched) {
    // To the rate of the base, about 1 a radian, times the last bits of some hundred degrees.
    close(apart(pass, end.at), 2.6, 1e-12, "the base of a flat dyad");
    const outwards = end === pass.begin ? pass.from - pass.to : pass.to - pass.from;
    assert.ok(apart(pass, end.at + 1e-6 * Math.sign(outwards)) > 2.6, "beyond the limit");
  }
});

test("at a change point rates are the limits of those next to it", () => {
  let compared = 0;
  for (const lengths of [
    [3, 1, 2, 2],
    [4, 2, 1, 3],
    [3, 1, 3, 1],
  ]) {
    const linkage = linkageOf(fourBar(lengths), []);
    for (const { passes } of motionOf(linkage, { step: 90 }).circuits) {
      for (const pass of passes) {
        if (pass.end.flat === 0 || Math.abs(pass.end.sin) > 1e-9) continue;
        compared += 1;
        const h = 0.03 * Math.sign(pass.from - pass.to);
        const [at, one, two, three] = [0, 1, 2, 3].map((k) => ratesAt(linkage, pass, pass.to + k * h));
        // Extrapolated from three positions next to it; nearer ones would have too large rounding errors.
        const drawnOn = (name, k) => 3 * one[name][k] - 3 * two[name][k] + three[name][k];
        for (let k = 0; k < at.place.length; k++) {
          close(at.velocity[k], drawnOn("velocity", k), 1e-6, "velocity");
          close(at.acceleration[k], drawnOn("acceleration", k), 1e-4, "acceleration");
        }
      }
    }
  }
  assert.ok(compared > 4);
});

test("rates agree with differences", () => {
  const linkage = linkageOf(sixBar(), []);
  const { circuits } = motionOf(linkage, { samples: 40 });
  for (const circuit of circuits) {
    const pass = circuit.passes[0];
    const at = pass.from + 0.37 * (pass.to - pass.from);
    const { place, velocity, acceleration } = ratesAt(linkage, pass, at);
    const h = 0.02;
    const [far, near, here, next, beyond] = [-2, -1, 0, 1, 2].map((k) => poseAt(linkage, pass, at + k * h));
    for (let k = 0; k < place.length; k++) {
      close(place[k], here[k], 1e-14 * 5, "place");
      // Of the fourth order in a step of 0.02 degrees.
      const rate = (8 * (next[k] - near[k]) - (beyond[k] - far[k])) / (12 * radiansOf(h));
      close(velocity[k], rate, 1e-10 * Math.max(1, Math.abs(rate)), "velocity");
      const second =
        (16 * (next[k] + near[k]) - (beyond[k] + far[k]) - 30 * here[k]) / (12 * radiansOf(h) ** 2);
      // The rounding error of second differences: 60 units in the last place of 5, over 12 h^2.
      close(acceleration[k], second, 1e-6 * Math.max(1, Math.abs(second)), "acceleration");
    }
  }
});

test("the coupler's point at the pole is at rest, and its centrodes touch there", () => {
  const linkage = linkageOf(fourBar([4, 1, 3, 3.5]), []);
  const [circuit] = motionOf(linkage, { step: 10 }).circuits;
  const [fixed, { points, frame }] = [
    fixedCentrode(linkage, circuit, 4),
    movingCentrode(linkage, circuit, 4),
  ];
  for (let i = 1; i < circuit.count; i++) {
    const { pole, moving } = poleAt(linkage, circuit.passes[0], circuit.input[i], 4);
    const { place, velocity } = ratesAt(linkage, circuit.passes[0], circuit.input[i]);
    const [a, b] = frame.map((joint) => pointOf(place, joint));
    const [va, vb] = frame.map((joint) => pointOf(velocity, joint));
    const size = distance(a, b);
    const [ux, uy] = [(b[0] - a[0]) / size, (b[1] - a[1]) / size];
    const turning = (ux * (vb[1] - va[1]) - uy * (vb[0] - va[0])) / size;
    // The pole may be far off, and is known to the rounding of what it is divided by.
    const tolerance = 1e-12 * (10 + distance(pole, a) ** 2);
    for (const [x, y] of [moving, points.subarray(2 * i)]) {
      close(a[0] + x * ux - y * uy, pole[0], tolerance, "pole");
      close(a[1] + x * uy + y * ux, pole[1], tolerance, "pole");
    }
    close(fixed[2 * i], pole[0], tolerance, "fixed centrode");
    close(va[0] - turning * (pole[1] - a[1]), 0, tolerance, "velocity at the pole");
    close(va[1] + turning * (pole[0] - a[0]), 0, tolerance, "velocity at the pole");
  }
});

test("points of the inflection circle have no curvature", () => {
  const linkage = linkageOf(fourBar([4, 1, 3, 3.5]), []);
  const [{ passes }] = motionOf(linkage, { step: 90 }).circuits;
  for (const input of [20, 110, 205, 300]) {
    const { pole, inflection } = poleAt(linkage, passes[0], input, 4);
    const { place, velocity, acceleration } = ratesAt(linkage, passes[0], input);
    // A point of the coupler: its coordinates on it, and its rates by those of A and B.
    const rates = ([x, y]) => {
      const [a, b] = [2, 3].map((joint) => pointOf(place, joint));
      const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
      const size2 = dx * dx + dy * dy;
      const along = ((x - a[0]) * dx + (y - a[1]) * dy) / size2;
      const across = ((y - a[1]) * dx - (x - a[0]) * dy) / size2;
      return [velocity, acceleration].map((all) => {
        const [p, q] = [2, 3].map((joint) => pointOf(all, joint));
        const [ex, ey] = [q[0] - p[0], q[1] - p[1]];
        return [p[0] + along * ex - across * ey, p[1] + along * ey + across * ex];
      });
    };
    const radius = distance(pole, inflection) / 2;
    const centre = [0, 1].map((k) => (pole[k] + inflection[k]) / 2);
    for (const turn of [10, 100, 250]) {
      const [c, s] = cosSinOfDegrees(turn);
      const [v, a] = rates([centre[0] + radius * c, centre[1] + radius * s]);
      close((v[0] * a[1] - v[1] * a[0]) / Math.hypot(...v) ** 3, 0, 1e-11, "curvature");
    }
  }
});

test("cognates keep their link lengths and have the same coupler point", () => {
  const template = fourBar([4, 1, 3, 3.5], { placement: { mirror: true, cos: 0.6, sin: 0.8 } });
  const linkage = linkageOf(template, []);
  const { cognates } = cognatesOf(linkage, 4);
  assert.equal(cognates.length, 3);
  const [circuit] = motionOf(linkage, { step: 15 }).circuits;
  for (const cognate of cognates) {
    const { frame, crank, coupler, rocker } = cognate.lengths;
    close(distance(...cognate.pivots), frame, 1e-14 * 10, "frame");
    for (const input of circuit.input) {
      const pose = poseAt(linkage, circuit.passes[0], input);
      const [ax, ay, bx, by] = cognatePins(linkage, cognate, pose);
      close(distance(cognate.pivots[0], [ax, ay]), crank, 1e-13, "crank");
      close(distance([ax, ay], [bx, by]), coupler, 1e-13, "coupler");
      close(distance(cognate.pivots[1], [bx, by]), rocker, 1e-13, "rocker");
      const [ux, uy] = [(bx - ax) / coupler, (by - ay) / coupler];
      const [along, left] = cognate.point;
      close(ax + along * ux - left * uy, pose[8], 1e-12, "point");
      close(ay + along * uy + left * ux, pose[9], 1e-12, "point");
    }
  }
});

test("the transmission angle is that of the law of cosines", () => {
  const linkage = linkageOf(fourBar([4, 1, 3, 3.5]), []);
  const bar = fourBarOf(linkage);
  assert.deepEqual([bar.class, bar.type, bar.shortest], ["crank-rocker", "crank-rocker", "crank"]);
  const [{ passes }] = motionOf(linkage, { step: 90 }).circuits;
  for (const input of [0, 33, 180, 271]) {
    const diagonal2 = 17 - 8 * Math.cos(radiansOf(input));
    const expected = (Math.acos((9 + 12.25 - diagonal2) / 21) * 180) / Math.PI;
    close(transmissionAt(linkage, bar, poseAt(linkage, passes[0], input)).mu, expected, 1e-11);
  }
});

test("a path is within its tolerance of the curve", () => {
  const linkage = linkageOf(fourBar([4, 2, 2, 2]), []);
  const [circuit] = motionOf(linkage, { samples: 60 }).circuits;
  for (const tolerance of [1e-2, 1e-4]) {
    const { points, inputs, starts } = finePath(linkage, circuit, 4, tolerance);
    assert.equal(inputs.length * 2, points.length);
    assert.equal(inputs[starts[1]], circuit.passes[0].to);
    for (let k = 1; k <= starts[1]; k++) {
      for (const part of [0.3, 0.5, 0.7]) {
        const pose = poseAt(linkage, circuit.passes[0], inputs[k - 1] + (inputs[k] - inputs[k - 1]) * part);
        const [ax, ay, bx, by] = points.subarray(2 * k - 2, 2 * k + 2);
        const off = ((bx - ax) * (pose[9] - ay) - (by - ay) * (pose[8] - ax)) / Math.hypot(bx - ax, by - ay);
        // A middle in time is not always the furthest from its chord.
        close(off, 0, 1.5 * tolerance, `part ${part} of chord ${k}`);
      }
    }
  }
});

test("an invalid linkage is reported in a sentence", () => {
  const wrong = (change, sentence) => {
    const template = fourBar([4, 1, 3, 3.5]);
    change(template);
    assert.throws(
      () => linkageOf(template, []),
      (error) => error instanceof LinkageError && sentence.test(error.message),
    );
  };
  wrong((t) => (t.joints[2].length = -1), /the length of `A` must be positive, found -1/);
  wrong((t) => (t.joints[4].point = [2, 1]), /`M` needs a link with both `A` and `C`/);
  wrong((t) => (t.joints[3].dyad = [2, 2]), /`A` and `A`, which are the same joint/);
  wrong((t) => (t.parameters = [{ name: "p", min: 0, max: null }]), /`p` is undefined/);
});
