// Tests the search by shape: node tests/gallery/shape.mjs ATLAS…
//
// Curves of each atlas are rotated, scaled, mirrored, started elsewhere, reversed, resampled and disturbed by
// noise; the search must find them again, with the kernel. Times are printed, not asserted: they depend on the machine.

import assert from "node:assert/strict";

import { curveKey, curvePoints } from "../../src/gallery/script/data/family.js";
import { decodeShape, encodeShape } from "../../src/gallery/script/shape/outline.js";
import { looksClosed, portion, resampled } from "../../src/gallery/script/shape/outline.js";
import { inverted, transformed } from "../../src/gallery/script/draw/plane-view.js";
import {
  bestFit,
  deviationInPlace,
  drawnPath,
  ShapeSearch,
  WHOLE,
} from "../../src/gallery/script/kernel/shape-search.js";
import { searchedParts } from "../../src/gallery/script/view/shape/indexes.js";
import { nearestCurves } from "../../src/gallery/script/view/shape/matches.js";
import { atlasOf, randomNumbers } from "./atlas-data.mjs";
import { kernelOf } from "./kernel.mjs";

const near = (a, b, tolerance, what) => assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);

// The parts, compared with closed forms.

{
  const circle = Float64Array.from({ length: 800 }, (_, k) =>
    (k % 2 ? Math.sin : Math.cos)((2 * Math.PI * (k >> 1)) / 400),
  );
  assert.ok(looksClosed(circle) && !looksClosed(circle.subarray(0, 700)));
  const even = resampled(Float64Array.of(0, 0, 3, 0, 3, 1), false, 5);
  assert.deepEqual([...even], [0, 0, 1, 0, 2, 0, 3, 0, 3, 1]);

  const similarity = { mirror: true, re: 0.6, im: -1.1, x: 3, y: -2 };
  const there = transformed(similarity, even);
  transformed(inverted(similarity), there).forEach((value, k) =>
    near(value, even[k], 1e-13, "inverse of a similarity"),
  );
}

// Shapes in addresses.

{
  const points = Float64Array.from({ length: 600 }, (_, k) =>
    k % 2 ? 3 * Math.sin((k - 1) / 95.5) : 5 * Math.cos(k / 95.5),
  );
  const { word, place } = encodeShape(points, true);
  assert.equal(word.length, 1 + 48 * 4);
  assert.match(word, /^[\w-]+$/);
  const { points: again, closed } = decodeShape(word);
  const placed = decodeShape(word, place).points;
  for (let k = 0; k < placed.length; k += 2)
    near((placed[k] / 5) ** 2 + (placed[k + 1] / 3) ** 2, 1, 0.01, "in its place");
  assert.equal(closed, true);
  for (let k = 0; k < again.length; k += 2)
    near(((again[k] - 50) / 50) ** 2 + ((again[k + 1] - 30) / 30) ** 2, 1, 0.01, "on the ellipse");
  for (const wrong of ["", "x", "cAA", "oAAAA", "c!AAAAAAA"]) assert.equal(decodeShape(wrong), null);
}

// Curves of atlases are found again.

/** The greatest distance of two points of an outline. */
function extentOf(points) {
  const few = resampled(points, false, 100);
  const pairs = Array.from({ length: 100 }, (_, k) => few.subarray(2 * k, 2 * k + 2));
  return Math.max(...pairs.flatMap(([x, y]) => pairs.map(([u, v]) => Math.hypot(x - u, y - v))));
}

/** An outline in the opposite direction, with the same first point if it is closed. */
function reversedOutline(points, closed) {
  const count = points.length / 2;
  const from = (k) => (closed ? (count - k) % count : count - 1 - k);
  return Float64Array.from(points, (_, at) => points[2 * from(at >> 1) + (at & 1)]);
}

/**
 * A curve transformed, resampled and disturbed; `noise` displaces each point by up to this part of the
 * extent.
 */
function disturbed(points, closed, random, { count, noise }) {
  const start = closed ? random() : 0;
  const even = portion(points, closed, start, closed ? start + 1 - 1 / count : 1, count).points;
  const far = noise * extentOf(even);
  const moved = even.slice();
  for (let k = 0; k < moved.length; k += 2) {
    const [angle, by] = [2 * Math.PI * random(), far * Math.sqrt(random())];
    moved[k] += by * Math.cos(angle);
    moved[k + 1] += by * Math.sin(angle);
  }
  const [angle, scale] = [2 * Math.PI * random(), Math.exp(4 * random() - 2)];
  const similarity = {
    mirror: random() < 0.5,
    re: scale * Math.cos(angle),
    im: scale * Math.sin(angle),
    x: 10 * random(),
    y: -5 * random(),
  };
  const placedThere = transformed(similarity, moved);
  return random() < 0.5 ? reversedOutline(placedThere, closed) : placedThere;
}

// Deviations that differ by less than this, by the size, count as equal: the chords of the samples deviate
// as much from the curve.
const AS_NEAR = 3e-4;

// The least part of a curve that a portion is.
const LEAST = 0.15;

// The one closed curve of the atlases that does not fit itself when it is resampled, through a sharp turn between two of its points.
const NOT_FOUND = "geared-five-bar:6.1.1";

/** Searches families for a shape with a kernel. */
function searchFor(kernel, parts, shape, options) {
  const app = { kernel: { load: async () => ({ curveSearch: kernel }) }, announce: assert.fail };
  const signal = new AbortController().signal;
  return nearestCurves(
    app,
    parts,
    shape,
    { mirror: true, least: LEAST, by: "rms", ...options },
    signal,
    () => {},
  );
}

/**
 * Searches for disturbed curves of an atlas; { first, five } are the shares of those that are found first and among the
 * first five, where others that are as near count for the curve.
 */
async function trial(kernel, parts, families, { label, tries, part, ...disturbance }) {
  const random = randomNumbers(20);
  const all = families.flatMap((family) =>
    Array.from({ length: family.curves.count }, (_, curve) => ({ family, curve })),
  );
  const curves = all.filter(({ family, curve }) => `${family.id}:${curveKey(family, curve)}` !== NOT_FOUND);
  const times = [];
  let [alone, first, five] = [0, 0, 0];
  for (let n = 0; n < tries; n += 1) {
    const { family, curve } = curves[Math.floor(random() * curves.length)];
    const closed = family.curves.closed[curve] === 1;
    const own = curvePoints(family, curve);
    const from = closed ? random() : random() * (1 - part);
    const points = part < 1 ? portion(own, closed, from, from + part, 300).points : own;
    const isWhole = closed && part === 1;
    const shape = { points: disturbed(points, isWhole, random, disturbance), closed: isWhole };
    const began = performance.now();
    const found = await searchFor(kernel, parts, shape, { isPart: part < 1 });
    times.push(performance.now() - began);
    const name = `${family.id}:${curveKey(family, curve)}`;
    // Cognates and overlapping families draw the same curve, and many curves have a third that is as near: what is
    // found in the place of the curve must be as near as the curve itself.
    const search = await ShapeSearch.open(kernel, await drawnPath(kernel, shape, part < 1), {
      mirror: true,
      least: isWhole ? WHOLE : LEAST,
    });
    // A curve that does not fit a portion of itself, through a sharp turn between two of its points, is not found.
    const deviation = ((await search.fit({ points: own, closed })).fit?.rms ?? -Infinity) + AS_NEAR;
    await search.close();
    const at = found.findIndex((one) => one.name === name);
    if (at === 0) alone += 1;
    if (found[0]?.rms <= deviation) first += 1;
    if ((at >= 0 && at < 5) || found[4]?.rms <= deviation) five += 1;
  }
  times.sort((a, b) => a - b);
  console.log(
    `${label}: ${alone} first, ${first} with what is as near, ${five} among five, of ${tries}; ${Math.round(times[tries >> 1])} ms, at most ${Math.round(times.at(-1))}`,
  );
  return { first: first / tries, five: five / tries };
}

for (const folder of process.argv.slice(2)) {
  const { families } = atlasOf(folder);
  const kernel = await kernelOf(folder);
  const parts = searchedParts(families, Infinity);
  const tries = 40;
  const whole = await trial(kernel, parts, families, {
    label: "whole",
    tries,
    part: 1,
    count: 150,
    noise: 0,
  });
  assert.ok(whole.first >= 0.97 && whole.five === 1, "whole curves come first");
  const noised = await trial(kernel, parts, families, {
    label: "whole, 1 % of noise",
    tries,
    part: 1,
    count: 200,
    noise: 0.01,
  });
  // Neighbours in a dense atlas differ by less than this noise.
  assert.ok(noised.first >= 0.85 && noised.five >= 0.95, "noised curves come first");
  const third = await trial(kernel, parts, families, {
    label: "a third",
    tries,
    part: 1 / 3,
    count: 80,
    noise: 0,
  });
  // Thirds without features, nearly circular arcs, are drawn by very many curves.
  assert.ok(third.five >= 0.85, "thirds of curves come among the first five");
  const rough = await trial(kernel, parts, families, {
    label: "a third, 1 % of noise",
    tries,
    part: 1 / 3,
    count: 80,
    noise: 0.01,
  });
  // Of thousands of curves hundreds have a third that differs from another's by less than this noise.
  assert.ok(rough.five >= 0.4, "noised thirds come among the first five as often as not");
  await unmirrored(kernel, parts, families[0]);
  compared(kernel, families[0]);
}

/** Tests that no mirror image is found if they are excluded, and that results are ranked. */
async function unmirrored(kernel, parts, family) {
  const shape = { points: curvePoints(family, 0), closed: family.curves.closed[0] === 1 };
  const found = await searchFor(kernel, parts, shape, { isPart: false, mirror: false });
  assert.ok(found.every(({ similarity }) => !similarity.mirror));
  assert.ok(found[0].rms < 1e-3);
  // The words are those of `find`, by shares of the size of the shape.
  const limits = { exact: 1e-4, close: 0.01, fair: 0.05, poor: Infinity };
  for (const { rms, quality } of found)
    assert.equal(
      quality,
      Object.keys(limits).find((word) => rms <= limits[word]),
      String(rms),
    );
  found.slice(1).forEach(({ rms }, k) => assert.ok(rms >= found[k].rms, "ranked by deviation"));
  const byGreatest = await searchFor(kernel, parts, shape, { isPart: false, by: "greatest" });
  byGreatest.slice(1).forEach(({ greatest }, k) => assert.ok(greatest >= byGreatest[k].greatest));
}

/** Tests the alignment of a curve with its image, and its deviation where it is. */
function compared(kernel, family) {
  const own = { points: curvePoints(family, 0), closed: family.curves.closed[0] === 1 };
  const image = { ...own, points: transformed({ mirror: true, re: 0.6, im: -1.1, x: 3, y: -2 }, own.points) };
  const fit = bestFit(kernel, own, image, true);
  assert.ok(fit.rms < 1e-6);
  transformed(fit.similarity, image.points).forEach((value, k) =>
    near(value, own.points[k], 1e-4 * extentOf(own.points), "aligned"),
  );
  assert.ok(deviationInPlace(kernel, own, own).rms < 1e-6);
  // Moved far along one axis, the nearest points are about as far.
  const away = 100 * extentOf(own.points);
  const moved = { ...own, points: transformed({ mirror: false, re: 1, im: 0, x: away, y: 0 }, own.points) };
  const { rms, greatest } = deviationInPlace(kernel, own, moved);
  assert.ok(greatest >= rms && rms > 90);
}
console.log("shape: as it should be");
