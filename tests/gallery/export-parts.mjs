// Tests the page's own parts of exports without a browser: node tests/gallery/export-parts.mjs ATLAS
//
// ATLAS is the folder of the atlas of atlas.toml. Exits with 1 if a test fails.

import assert from "node:assert/strict";
import * as zlib from "node:zlib";

import { exportCommand, shortenCurveNames } from "../../src/gallery/script/export/command.js";
import { crc32OfBytes, zipOfFiles } from "../../src/gallery/script/export/zip.js";
import { parseCurveName } from "../../src/gallery/script/data/address.js";
import { curveKey } from "../../src/gallery/script/data/family.js";
import { exportFile, exportManifest, EXPORT_FORMATS } from "../../src/gallery/script/view/export/files.js";
import { familyOf, filesOfZip, pointsOf } from "./export-data.mjs";
import { kernelOf } from "./kernel.mjs";

const [atlas] = process.argv.slice(2);
const text = (bytes) => new TextDecoder().decode(bytes);
const evans = familyOf(atlas, "evans");
const all = Array.from({ length: evans.curves.count }, (_, k) => `evans:${curveKey(evans, k)}`);

const archive = zipOfFiles([
  { name: "a.txt", bytes: new TextEncoder().encode("one") },
  { name: "b", bytes: new Uint8Array() },
]);
assert.deepEqual(
  filesOfZip(archive).map(({ name, bytes }) => [name, text(bytes)]),
  [
    ["a.txt", "one"],
    ["b", ""],
  ],
);
if (zlib.crc32) assert.equal(crc32OfBytes(archive), zlib.crc32(archive));
assert.equal(crc32OfBytes(new TextEncoder().encode("123456789")), 0xcbf43926);

const byId = new Map([["evans", evans]]);
assert.deepEqual(shortenCurveNames(all, byId), ["evans"]);
assert.deepEqual(shortenCurveNames([all[0], all[1], `${all[0]}?p=3`], byId), [
  all[0],
  all[1],
  `${all[0]}?p=3`,
]);
assert.match(exportCommand([`${all[0]}?p=3`], 1), /^coupler-atlas export atlas\.toml 'evans:1\.1\.1\?p=3' /);

const { changes, ...parsed } = parseCurveName("evans:12.1.2?p=2.5&M.along=-1");
assert.deepEqual(parsed, { family: "evans", key: "12.1.2" });
assert.deepEqual(
  [...changes],
  [
    ["p", 2.5],
    ["M.along", -1],
  ],
);
assert.equal(parseCurveName("evans"), null);

// An export of the page's, with the kernel.
const kernel = await kernelOf(atlas);
const app = { atlas: { family: async () => evans }, kernel: { load: async () => kernel } };
const csv = EXPORT_FORMATS.find((format) => format.kernel === "csv");
const { name, bytes } = await exportFile(app, [all[0]], csv);
const { header, rows } = pointsOf(atlas, "evans");
// The curve is closed.
const closed = rows.get("1.1.1").map((row) => `${row},1\n`);
assert.deepEqual([name, text(bytes)], ["evans-1-1-1.csv", `${header},closed\n${closed.join("")}`]);
const several = await exportFile(app, all.slice(0, 2), csv);
assert.deepEqual(
  filesOfZip(several.bytes).map((file) => file.name),
  ["evans-1-1-1.csv", "evans-2-1-1.csv"],
);
assert.match(await exportManifest(app, [`${all[0]}?p=3&M.along=1`]), /M\.along/);
const failing = (word, expected) => assert.rejects(exportFile(app, [word], csv), expected);
await failing("evans:99.1.1", /there is no curve/);
await failing("evans:1.1.1?p=-1", /must be more than 0/);
await failing("evans:1.1.1?circuit=9", /^Error: evans:1\.1\.1\?circuit=9: /);
console.log("exports: as they should be");
