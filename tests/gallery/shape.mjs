// Tests the search by shape: node tests/gallery/shape.mjs ATLAS…
//
// Curves of each atlas are rotated, scaled, mirrored, started elsewhere, reversed, resampled and disturbed by
// noise; the search must find them again, with the kernel. Times are printed, not asserted: they depend on the machine.

import assert from "node:assert/strict";

import { curveKey, curvePoints } from "../../src/gallery/script/data/family.js";
import { queryShape, searchedPath } from "../../src/gallery/script/shape/query-shape.js";
import { decodeShape, encodeShape } from "../../src/gallery/script/shape/encode.js";
import { extentOf, lengthsAlong, portion, resampled } from "../../src/gallery/script/shape/outline.js";
import { smoothed } from "../../src/gallery/script/shape/query-shape.js";
import { parseShape } from "../../src/gallery/script/shape/parse.js";
import { inverted, transformed } from "../../src/gallery/script/draw/similarity.js";
import {
  bestFit,
  deviationInPlace,
  ShapeSearch,
  WHOLE,
} from "../../src/gallery/script/kernel/shape-search.js";
import { searchedParts } from "../../src/gallery/script/view/shape/indexes.js";
import { nearestCurves } from "../../src/gallery/script/view/shape/matches.js";
import { Slices } from "../../src/gallery/script/view/slices.js";
import { atlasOf, randomNumbers } from "./atlas-data.mjs";
import { kernelOf } from "./kernel.mjs";

const near = (a, b, tolerance, what) => assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);

// The parts, compared with closed forms.

{
  const circle = Float64Array.from({ length: 800 }, (_, k) =>
    (k % 2 ? Math.sin : Math.cos)((2 * Math.PI * (k >> 1)) / 400),
  );
  near(extentOf(circle), 2, 1e-4, "extent of a circle");
  const even = resampled(Float64Array.of(0, 0, 3, 0, 3, 1), false, 5);
  assert.deepEqual([...even], [0, 0, 1, 0, 2, 0, 3, 0, 3, 1]);

  const similarity = { mirror: true, re: 0.6, im: -1.1, x: 3, y: -2 };
  const there = transformed(similarity, even);
  transformed(inverted(similarity), there).forEach((value, k) =>
    near(value, even[k], 1e-13, "inverse of a similarity"),
  );
}

// Noisy outlines are smoothed, others are not changed.

{
  const random = randomNumbers(3);
  const circle = (count, noise) =>
    Float64Array.from(
      { length: 2 * count },
      (_, k) => (k % 2 ? Math.sin : Math.cos)((2 * Math.PI * (k >> 1)) / count) + noise * (2 * random() - 1),
    );
  for (const points of [circle(300, 0), circle(12, 0), Float64Array.of(0, 0, 3, 0, 3, 2, 0, 2)])
    assert.equal(smoothed(points, true), points);
  const line = Float64Array.of(0, 0, 1, 0, 5, 1);
  assert.equal(smoothed(line, false), line);
  const length = (points) => lengthsAlong(points, true).at(-1) / (2 * Math.PI);
  for (const count of [100, 200, 400]) {
    const given = circle(count, 0.02);
    assert.ok(length(given) > 1.02, "noise adds to the length");
    near(length(smoothed(given, true)), 1, 0.02, "the length of a quiet circle");
  }
}

// Pasted text.

{
  const read = (text) => parseShape(text);
  assert.deepEqual([...read("x,y\n0,0\n1,0\n1,2").points], [0, 0, 1, 0, 1, 2]);
  assert.deepEqual([...read("# mm\n0 0\n1\t0\n2  3\n").points].slice(-2), [2, 3]);
  assert.deepEqual([...read("1,5;2,5\n3;4,25").points], [1.5, 2.5, 3, 4.25]);
  assert.deepEqual([...read('{"a": {"points": [{"x": 1, "y": 2}, {"x": 3, "y": 4}]}}').points], [1, 2, 3, 4]);
  assert.deepEqual([...read("[[0,0],[1,1],[2,0]]").points], [0, 0, 1, 1, 2, 0]);
  const own = read(
    "cell,trace,circuit,branch,sample,input_deg,x,y\n1,1,1,1,0,0,5,6\n1,1,1,1,1,5,7,8\n2,1,1,1,0,0,9,9",
  );
  assert.deepEqual([...own.points], [5, 6, 7, 8]);
  assert.match(own.said, /first of 2 curves/);
  // y points down in SVG, up here.
  const square = read("M0 0l10 0v10h-10z");
  assert.deepEqual(
    [...square.points].map((value) => value + 0),
    [0, 0, 10, 0, 10, -10, 0, -10].map((value) => value + 0),
  );
  assert.equal(square.closed, true);
  const arc = read("M-1,0A1 1 0 0 1 1 0").points;
  for (let k = 0; k < arc.length; k += 2) near(Math.hypot(arc[k], arc[k + 1]), 1, 1e-12, "arc of a circle");
  assert.ok(
    arc.some((value, k) => k % 2 && value > 0.99),
    "swept in the direction of SVG",
  );
  assert.deepEqual(
    [...read("M10 10a5 5 0 1110 0").points.slice(-2)],
    [20, -10],
    "flags of arcs need no blanks",
  );
  const smooth = read("M0,0C0 10 10 10 10 0S20-10 20 0").points;
  assert.deepEqual([smooth.at(-2), smooth.at(-1) + 0], [20, 0]);
  near(Math.max(...smooth.filter((_, k) => k % 2)), 7.5, 1e-9, "the reflected control point");
  assert.match(
    read("<svg><path class='a' d='M0 0Q5 5 10 0T20 0'/><polygon points='0,0 30,0 30,30'/></svg>").said,
    /longest of 2 outlines/,
  );
  for (const wrong of ["", "hello", "[1, 2]", "{", "<svg></svg>", "M0 0", "1 2"])
    assert.throws(() => read(wrong), Error, wrong);
}

// Outlines of SVG with transforms.

{
  const near2 = (svg, expected, what) => {
    const { points } = parseShape(svg);
    assert.equal(points.length, expected.length, what);
    // y points down in SVG.
    expected.forEach((value, k) => near(points[k], k % 2 ? -value : value, 1e-12, what));
  };
  const line = '<path d="M1 0L3 0L3 1"/>';
  const moved = (transform, expected) =>
    near2(`<g transform="${transform}">${line}</g>`, expected, transform);
  moved("translate(5)", [6, 0, 8, 0, 8, 1]);
  moved("translate(5,-2)", [6, -2, 8, -2, 8, -1]);
  moved("scale(2)", [2, 0, 6, 0, 6, 2]);
  moved("scale(2 -1)", [2, 0, 6, 0, 6, -1]);
  moved("rotate(90)", [0, 1, 0, 3, -1, 3]);
  moved("rotate(90 1 0)", [1, 0, 1, 2, 0, 2]);
  moved("skewX(45)", [1, 0, 3, 0, 4, 1]);
  moved("skewY(45)", [1, 1, 3, 3, 3, 4]);
  moved("matrix(1 2 3 4 5 6)", [6, 8, 8, 12, 11, 16]);
  // The last transform of a list is applied first, and inner ones before outer ones.
  moved("translate(5,0) , scale(2)rotate(90)", [5, 2, 5, 6, 3, 6]);
  moved("none", [1, 0, 3, 0, 3, 1]);
  near2(
    `<svg:svg xmlns:svg="x" viewBox="0 0 9 9"><!-- <path d="M0 0L99 99"/> --><g transform="translate(5)">
      <svg:path transform='scale(2)' d="M1 0&#10;L3 0 L3 1"><title>a &gt; b</title></svg:path></g></svg:svg>`,
    [7, 0, 11, 0, 11, 2],
    "nested",
  );
  // A transform ends with its element, and the longest outline is the longest after transforms.
  near2(`<g transform="scale(2)"/>${line}`, [1, 0, 3, 0, 3, 1], "a sibling");
  near2(`<g transform="scale(9)"><path d="M0 0H1V1"/></g>${line}`, [0, 0, 9, 0, 9, 9], "drawn larger");
  near2('<path d="M0 0H99" display="none"/><path d="M0 0H1"/>', [0, 0, 1, 0], "hidden");
  near2(`<defs><path id="a" d="M0 0H99"/></defs>${line}`, [1, 0, 3, 0, 3, 1], "in defs alone");
  const use = '<use xlink:href="#a" x="1" y="1" transform="scale(2)"/>';
  near2(`<symbol><path id="a" d="M0 0H9"/></symbol>${use}`, [2, 2, 20, 2], "used");
  near2('<line x1="1" y1="2" x2="1in" y2="2"/>', [1, 2, 96, 2], "line");
  near2('<polyline points="0,0 1-1 2,0"/>', [0, 0, 1, -1, 2, 0], "polyline");
  near2('<rect x="1" y="2" width="3" height="4"/>', [1, 2, 4, 2, 4, 6, 1, 6], "rectangle");
  for (const [round, what] of [
    ['<circle cx="2" cy="1" r="3" transform="scale(2 1)"/>', "circle"],
    ['<g transform="scale(2,1) translate(2 1)"><ellipse rx="3" ry="3"/></g>', "ellipse"],
    ['<rect x="-1" y="-2" width="6" height="6" rx="3" transform="scale(2 1)"/>', "rounded rectangle"],
  ]) {
    const { points, closed } = parseShape(round);
    assert.equal(closed, true, what);
    for (let k = 0; k < points.length; k += 2)
      near(((points[k] - 4) / 6) ** 2 + ((points[k + 1] + 1) / 3) ** 2, 1, 1e-12, what);
  }
  for (const [wrong, sentence] of [
    [`<g transform="turn(3)">${line}</g>`, /The transform “turn\(3\)” cannot be read/],
    [`<g transform="rotate(30deg)">${line}</g>`, /transform/],
    [`<g transform="scale(1 2 3)">${line}</g>`, /transform/],
    [`<g transform="constructor(1)">${line}</g>`, /transform/],
    [`<g style="fill: none; transform: scale(2)">${line}</g>`, /style/],
    [`<style>path { transform: scale(2) }</style>${line}`, /sheet of styles/],
    [`<g transform="scale(2)" transform-origin="1 1">${line}</g>`, /transform-origin/],
    ['<circle r="50%"/>', /r = “50%” of a circle/],
    ['<polygon points="a b"/>', /points of a polygon/],
    ['<g id="a"><use href="#a"/></g>', /uses itself/],
    ['<use href="other.svg#a"/>', /not in the drawing/],
    ["<svg><text>M0 0L9 9</text></svg>", /draws no path/],
    [`<g transform="scale(0)">${line}</g>`, /Fewer than two/],
  ])
    assert.throws(() => parseShape(wrong), { message: sentence }, wrong);
}

// Shapes in addresses.

{
  const points = Float64Array.from({ length: 600 }, (_, k) =>
    k % 2 ? 3 * Math.sin((k - 1) / 95.5) : 5 * Math.cos(k / 95.5),
  );
  const word = encodeShape(points, true);
  assert.equal(word.length, 1 + 48 * 4);
  assert.match(word, /^[\w-]+$/);
  const { points: again, closed } = decodeShape(word);
  assert.equal(closed, true);
  for (let k = 0; k < again.length; k += 2)
    near(((again[k] - 50) / 50) ** 2 + ((again[k + 1] - 30) / 30) ** 2, 1, 0.01, "on the ellipse");
  for (const wrong of ["", "x", "cAA", "oAAAA", "c!AAAAAAA"]) assert.equal(decodeShape(wrong), null);
}

// Curves of atlases are found again.

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
  const slices = new Slices(() => false);
  return nearestCurves(
    app,
    parts,
    shape,
    { mirror: true, least: LEAST, by: "rms", ...options },
    slices,
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
    const shape = queryShape(disturbed(points, isWhole, random, disturbance), isWhole);
    const began = performance.now();
    const found = await searchFor(kernel, parts, shape, { isPart: part < 1 });
    times.push(performance.now() - began);
    const name = `${family.id}:${curveKey(family, curve)}`;
    // Cognates and overlapping families draw the same curve, and many curves have a third that is as near: what is
    // found in the place of the curve must be as near as the curve itself.
    const search = await ShapeSearch.open(kernel, searchedPath(shape, part < 1), {
      mirror: true,
      least: isWhole ? WHOLE : LEAST,
    });
    // A curve that does not fit a portion of itself, through a sharp turn between two of its points, is not found.
    const deviation = ((await search.fit({ points: own, closed }))?.rms ?? -Infinity) + AS_NEAR;
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
  const shape = queryShape(curvePoints(family, 0), family.curves.closed[0] === 1);
  const found = await searchFor(kernel, parts, shape, { isPart: false, mirror: false });
  assert.ok(found.every(({ similarity }) => !similarity.mirror));
  assert.ok(found[0].rms < 1e-3);
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
