// Tests which files and pieces the page takes its data from: node tests/gallery/data.mjs

import assert from "node:assert/strict";

import { pageFile } from "../../src/gallery/script/data/atlas.js";
import { outlineCache } from "../../src/gallery/script/data/atlas.js";
import { ANGLE_UNITS, parseNumber } from "../../src/gallery/script/data/number.js";
import { holdPieces, needPieces } from "../../src/gallery/script/data/needs.js";
import {
  bytesOfComment,
  placesOfCurves,
  unpackColumn,
  unpackInto,
  unpackPoints,
} from "../../src/gallery/script/data/packed.js";
import { Series } from "../../src/gallery/script/data/series.js";
import { MAX_HEIGHT, scrollScale } from "../../src/gallery/script/view/long-list.js";
import { searchedParts } from "../../src/gallery/script/view/shape/indexes.js";

// The files of pages: more than a thousand are in subfolders of a thousand.

{
  const atlas = {
    families: [
      { id: "few", pages: 1000, page_format: "svg" },
      { id: "many", pages: 2500, page_format: "png" },
      { id: "most", pages: 123456, page_format: "svg" },
      { id: "none", pages: 3, page_format: null },
    ],
  };
  const file = (id, page) => pageFile(atlas, id, page);
  assert.equal(file("few", 7), "few/few-007.svg");
  assert.equal(file("few", 1000), "few/few-1000.svg");
  assert.equal(file("few", 1001), null);
  assert.equal(file("many", 1), "many/0001-1000/many-001.png");
  assert.equal(file("many", 1000), "many/0001-1000/many-1000.png");
  assert.equal(file("many", 1001), "many/1001-2000/many-1001.png");
  assert.equal(file("many", 2500), "many/2001-2500/many-2500.png");
  assert.equal(file("most", 999), "most/000001-001000/most-999.svg");
  assert.equal(file("most", 123456), "most/123001-123456/most-123456.svg");
  assert.equal(file("none", 1), null);
}

// Numbers as they are typed: with a point or a comma, and what could be two numbers is none.

{
  const value = (text, units) => parseNumber(text, units).value;
  const right = {
    "3,5": 3.5,
    3.5: 3.5,
    "−2": -2,
    "1e-3": 0.001,
    ",5": 0.5,
    "0,125": 0.125,
    "+4": 4,
    "-2,": -2,
  };
  for (const [text, number] of Object.entries(right)) assert.equal(value(text), number, text);
  const grouped = { "1,234.5": 1234.5, "1.234,5": 1234.5, "1,234,567": 1234567, "12 345,6": 12345.6 };
  for (const [text, number] of Object.entries(grouped)) assert.equal(value(text), number, text);
  for (const text of ["", "abc", "3,5,6", "1.2.3", "--3", ".", "0x10", "Infinity", "1e999", "3 mm"])
    assert.ok(parseNumber(text).reason?.includes(text), text);
  assert.match(parseNumber("1,234").reason, /could be 1\.234 or 1234/);
  const { deg, rad } = ANGLE_UNITS;
  for (const text of ["45", "45°", "45 deg", "45,0 °"]) assert.equal(value(text, deg), 45, text);
  assert.equal(value("0.5 rad", rad), 0.5);
  assert.equal(value("0,5", rad), 0.5);
  assert.equal(value("180°", rad), Math.PI);
  assert.equal(value("-90 deg", rad), -Math.PI / 2);
  assert.ok(Math.abs(value("0.5 rad", deg) - 28.64788975654116) < 1e-13);
  for (const text of ["30 grad", "30 mm", "rad", "30'"])
    assert.match(parseNumber(text, deg).reason, /is not a number \(in °, deg, rad\)/, text);
  assert.match(parseNumber("30°").reason, /has a unit: write a number alone/);
}

// Columns.

{
  const base64 = (array) => Buffer.from(array.buffer).toString("base64");
  assert.deepEqual([...unpackColumn(Uint16Array, 3, 7)], [7, 7, 7]);
  assert.deepEqual([...unpackColumn(Float64Array, 2, null)], [NaN, NaN]);
  assert.deepEqual([...unpackColumn(Float64Array, 2, base64(Float64Array.of(0.1, -0)))], [0.1, -0]);
  const array = new Uint32Array(5);
  unpackInto(array, 2, 2, base64(Uint32Array.of(70000, 8)));
  unpackInto(array, 4, 1, 9);
  assert.deepEqual([...array], [0, 0, 70000, 8, 9]);
  assert.equal(unpackColumn(Uint16Array, 0, "").length, 0);
  // Points as differences: of 65535, 0 from 65535, and so on; those of a second curve begin anew.
  const bytes = [254, 255, 7, 253, 255, 7, 0, 4, 4, 2];
  const packed = bytesOfComment(new Function(`return ()=>{/*${base64(Uint8Array.from(bytes))}*/}`)());
  assert.deepEqual([...packed], bytes);
  const places = placesOfCurves(packed, [2, 1]);
  assert.deepEqual([...places], [0, 8]);
  assert.deepEqual([...unpackPoints(packed, 0, 2).subarray(0, 4)], [65535, 0, 0, 2]);
  assert.deepEqual([...unpackPoints(packed, places[1], 1).subarray(0, 2)], [2, 1]);
}

// The pieces with a cell, a curve, a page; some pieces have none of one kind.

const SERIES = new Series("evans", "curves", [
  { bytes: 10, cells: 3, curves: 5, pages: 1, numbers: [1, 4] },
  { bytes: 10, cells: 2, curves: 0, pages: 0, numbers: [6, 7] },
  { bytes: 10, cells: 1, curves: 2, pages: 2, numbers: [9, 9] },
  { bytes: 10, cells: 0, curves: 0, pages: 4, numbers: null },
]);

{
  const numberOf = (piece) => piece?.number;
  assert.deepEqual(
    [0, 2, 3, 4, 5, 6].map((cell) => numberOf(SERIES.ofCell(cell))),
    [1, 1, 2, 2, 3, undefined],
  );
  assert.deepEqual(
    [0, 4, 5, 6, 7].map((curve) => numberOf(SERIES.ofCurve(curve))),
    [1, 1, 3, 3, undefined],
  );
  assert.deepEqual(
    [0, 1, 2, 3, 4, 7, 8].map((page) => numberOf(SERIES.ofPage(page))),
    [undefined, 1, 3, 3, 4, 4, undefined],
  );
  assert.deepEqual(
    [0, 1, 3, 5, 6, 8, 9, 10].map((number) => numberOf(SERIES.ofNumber(number))),
    [undefined, 1, 1, undefined, 2, undefined, 3, undefined],
  );
  assert.equal(SERIES.pieces[2].file, "evans/gallery-curves-0003.js");
  assert.equal(SERIES.loadedPieces, 0);
}

// Pieces that were not used for long are dropped, unless they are held.

{
  const cache = outlineCache(30);
  const family = {
    used: cache.use,
    load: async (piece) => {
      piece.data = {};
      cache.use(piece);
    },
  };
  const [a, b, c, d] = SERIES.pieces;
  await needPieces(family, [a, undefined, b, a]);
  assert.equal(needPieces(family, [a, b]), null, "both are loaded");
  const release = holdPieces([a]);
  await needPieces(family, [c]);
  needPieces(family, [b]);
  await needPieces(family, [d]);
  assert.deepEqual(
    [a, b, c, d].map(({ data }) => data !== null),
    [true, true, false, true],
  );
  release();
  await needPieces(family, [c]);
  assert.deepEqual(
    [a, b, c, d].map(({ data }) => data !== null),
    [false, true, true, true],
  );
}

// A large family is searched by shape in parts, and only so much of it as is allowed.

{
  const entries = Array.from({ length: 50 }, (_, k) => ({
    bytes: 4e6,
    cells: 7000,
    curves: 7000,
    numbers: [7000 * k + 1, 7000 * k + 7000],
  }));
  const family = { outlines: new Series("large", "curves", entries) };
  const all = searchedParts([family], Infinity);
  assert.equal(
    all.reduce((sum, { count }) => sum + count, 0),
    350000,
  );
  let next = 0;
  for (const { first, count } of all) {
    assert.ok(first === next && count <= 20000);
    next += count;
  }
  assert.ok(all[0].isKept && !all.at(-1).isKept);
  const some = searchedParts([family], 48e6);
  assert.equal(
    some.reduce((sum, { count }) => sum + count, 0),
    12 * 7000,
  );
  assert.equal(searchedParts([family], 1).length, 1, "at least one part");
}

// Lists that are too high scroll faster, to their ends.

{
  assert.equal(scrollScale(MAX_HEIGHT, 900), 1);
  const scale = scrollScale(4 * MAX_HEIGHT, 900);
  assert.ok(Math.abs((MAX_HEIGHT - 900) * scale - (4 * MAX_HEIGHT - 900)) < 1e-6);
}

console.log("data: as it should be");
