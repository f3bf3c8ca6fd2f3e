// Tests the exports of the page under node: node tests/gallery/export.mjs ATLAS [PROGRAM]
//
// ATLAS is the folder of a rendered atlas with a gallery. With PROGRAM, the binary, the exports are also
// compared with its exports of the atlas's manifest (MANIFEST, in the environment). Exits with 0 and a line
// of counts, or with 1 if there are differences.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import * as zlib from "node:zlib";

import { extraCircuitsCommand, exportCommand, shortenCurveNames } from "../../src/gallery/script/export/command.js";
import { columnNames } from "../../src/gallery/script/export/columns.js";
import { csvOfCurve } from "../../src/gallery/script/export/csv.js";
import { shortestDigits } from "../../src/gallery/script/export/digits.js";
import { dxfOfCurve } from "../../src/gallery/script/export/dxf.js";
import { jsonOfCurve } from "../../src/gallery/script/export/json.js";
import { CATALOGUE, manifestOfCurves, curveNamesInManifest } from "../../src/gallery/script/export/manifest.js";
import { movingSvgOfCurve } from "../../src/gallery/script/export/moving-svg.js";
import { svgOfCurve } from "../../src/gallery/script/export/svg.js";
import { fileStem, manifestCase, solveNamedCurve } from "../../src/gallery/script/export/curve.js";
import { crc32OfBytes, zipOfFiles } from "../../src/gallery/script/export/zip.js";
import { curveKey } from "../../src/gallery/script/data/family.js";
import { compareMeasures } from "./compare-measures.mjs";
import { entitiesOf, familyOf, filesOfZip, pointsOf } from "./export-data.mjs";

const [atlas, binary] = process.argv.slice(2);
// The tests may be run from any folder.
const program = binary && resolve(binary);
const here = dirname(fileURLToPath(import.meta.url));
const data = JSON.parse(readFileSync(join(atlas, "index.html"), "utf8").match(/id="atlas">([\s\S]*?)<\/script>/)[1]);
const measures = data.measures.map(({ name }) => name);
// The number of curves tested of each family: the first, the last, and some between.
const CURVES_OF_EACH = 6;
// The tolerance of a position, by the size of the curve, to which the page's solver agrees with the
// program's.
const PLACE = 1e-11;

const seen = { beside: 0, curves: 0, rows: 0, same: 0, columns: 0, polylines: 0, circles: 0, arcs: 0, files: 0, identical: 0 };

const columnsWithNumbers = new Set();

function namesOf(family) {
  const { count } = family.curves;
  const step = Math.max(1, Math.floor(count / CURVES_OF_EACH));
  const places = new Set([count - 1]);
  for (let k = 0; k < count; k += step) places.add(k);
  return [...places].filter((k) => k >= 0).map((k) => `${family.id}:${curveKey(family, k)}`);
}

function distanceTo(p, a, b) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.min(Math.max(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0), 1) : 0;
  return Math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

function comparedTable(name, exported, { header, rows }) {
  // Further columns have a separate test.
  const [own, ...lines] = csvOfCurve({ ...exported, family: { ...exported.family, columns: [] } }).trimEnd().split("\n");
  const recorded = rows.get(name.split(":")[1]);
  assert.ok(header.startsWith(own), `${name}: ${own}`);
  assert.equal(lines.length, recorded.length, name);
  const width = own.split(",").length;
  const numbers = (line) => line.split(",").slice(0, width).map(Number);
  const size = Math.max(...recorded.flatMap((line) => numbers(line).slice(-2).filter(Number.isFinite).map(Math.abs)));
  const places = lines.map((line, k) => {
    const [mine, theirs] = [numbers(line), numbers(recorded[k])];
    mine.forEach((value, column) => {
      const isPlace = column >= width - 3;
      const most = isPlace ? PLACE * Math.max(size, Math.abs(theirs[column])) : 0;
      assert.ok(value === theirs[column] || Math.abs(value - theirs[column]) <= most, `${name}: ${line} is not ${recorded[k]}`);
    });
    seen.same += line === recorded[k].split(",").slice(0, width).join(",") ? 1 : 0;
    return mine.slice(-2);
  });
  seen.rows += lines.length;
  return places.filter(([x, y]) => Number.isFinite(x + y));
}

// Compares rates to 1e-9 of their size and of the table's: near a limit rates and their rounding errors grow
// without bounds.
function comparedColumns(name, exported, { header, rows }) {
  const family = { ...exported.family, columns: header.split(",").slice(header.split(",").indexOf("y") + 1) };
  const [own, ...lines] = csvOfCurve({ ...exported, family }).trimEnd().split("\n").map((line) => line.split(","));
  const recorded = rows.get(name.split(":")[1]).map((line) => line.split(","));
  for (const column of family.columns) {
    const [mine, theirs] = [own.indexOf(column), header.split(",").indexOf(column)];
    lines.forEach((line, k) => {
      const [a, b] = [line[mine], recorded[k][theirs]];
      const isNumber = a !== "" && b !== "";
      const off = Math.abs(Number(a) - Number(b));
      assert.ok(a === b || (isNumber && off <= 1e-9 * Math.max(1, Math.abs(Number(b)))), `${name}, ${column}, sample ${k}: ${a} is not ${b}`);
      seen.columns += 1;
      if (a !== "") columnsWithNumbers.add(column);
    });
  }
}

function comparedDrawing(name, exported, places) {
  const entities = entitiesOf(dxfOfCurve(exported, data.program));
  const on = (layer) => entities.filter(({ groups }) => groups.get(8) === layer);
  const [curve, ...more] = on("CURVE");
  assert.equal(more.length, 0, name);
  const value = (code) => Number(curve.groups.get(code));
  const extent = Math.max(...[0, 1].map((k) => Math.max(...places.map((p) => p[k])) - Math.min(...places.map((p) => p[k]))));
  if (curve.kind === "POLYLINE") {
    seen.polylines += 1;
    const vertices = curve.vertices.map(({ groups }) => [Number(groups.get(10)), Number(groups.get(20))]);
    if (value(70) === 1) vertices.push(vertices[0]);
    for (const p of places) {
      let off = Infinity;
      for (let k = 1; k < vertices.length; k++) off = Math.min(off, distanceTo(p, vertices[k - 1], vertices[k]));
      assert.ok(off <= 1e-4 * extent, `${name}: a sample is ${off} off`);
    }
  } else {
    seen[curve.kind === "ARC" ? "arcs" : "circles"] += 1;
    for (const [x, y] of places) {
      assert.ok(Math.abs(Math.hypot(x - value(10), y - value(20)) - value(40)) <= 2e-9 * value(40), name);
    }
  }
  assert.ok(on("PIVOTS").length > 0 && on("LINKAGE").length > 1, name);
}

// Tags open and close in their order, and attributes are quoted.
function assertWellFormed(name, svg) {
  const open = [];
  const rest = svg.replace(/<(\/?)([a-z]+)((?:\s[\w:-]+="[^"<]*")*)(\/?)>/gi, (_, closes, tag, attributes, empty) => {
    if (closes) assert.equal(open.pop(), tag, name);
    else if (!empty) open.push(tag);
    return "";
  });
  assert.equal(open.length, 0, name);
  assert.ok(!rest.includes("<") && !svg.includes("NaN") && !svg.includes("undefined") && !/\bInfinity/.test(svg), name);
}

function comparedFamily({ id }) {
  const family = familyOf(atlas, id);
  const table = pointsOf(atlas, id);
  for (const name of namesOf(family)) {
    const exported = solveNamedCurve(family, name);
    const places = comparedTable(name, exported, table);
    comparedColumns(name, exported, table);
    comparedDrawing(name, exported, places);
    const json = JSON.parse(jsonOfCurve(exported, measures));
    const [x, y] = ["x", "y"].map((column) => json.columns.indexOf(column));
    assert.deepEqual(json.points.map((row) => [row[x], row[y]]).filter(([x]) => x !== null), places, name);
    assert.deepEqual(Object.keys(json.measures), measures, name);
    assertWellFormed(name, svgOfCurve(exported));
    assert.ok(!svgOfCurve(exported).includes("<animate"), name);
    const moving = movingSvgOfCurve(exported);
    assertWellFormed(name, moving);
    assert.ok(moving.includes("<animate") && !moving.includes("<script"), name);
    seen.curves += 1;
  }
  return family;
}

function testNumbersAndWords(families) {
  const digits = [[2, "2"], [-0, "0"], [0.1 + 0.2, "0.30000000000000004"], [1e-7, "1e-7"], [1e-5, "0.00001"], [1e300, "1e300"], [9e-6, "9e-6"], [Infinity, "inf"], [NaN, ""]];
  for (const [value, expected] of digits) assert.equal(shortestDigits(value), expected);
  const catalogue = readdirSync(join(here, "../../crates/coupler-curves/src/catalogue")).filter((name) => name.endsWith(".toml")).map((name) => name.slice(0, -5));
  assert.deepEqual(CATALOGUE, catalogue.sort(), "the catalogue");
  const archive = zipOfFiles([{ name: "a.txt", bytes: new TextEncoder().encode("one") }, { name: "b", bytes: new Uint8Array() }]);
  assert.deepEqual(filesOfZip(archive).map(({ name, bytes }) => [name, new TextDecoder().decode(bytes)]), [["a.txt", "one"], ["b", ""]]);
  if (zlib.crc32) assert.equal(crc32OfBytes(archive), zlib.crc32(archive));
  assert.equal(crc32OfBytes(new TextEncoder().encode("123456789")), 0xcbf43926);
  const byId = new Map(families.map((family) => [family.id, family]));
  const evans = byId.get("evans");
  const all = Array.from({ length: evans.curves.count }, (_, k) => `evans:${curveKey(evans, k)}`);
  assert.deepEqual(shortenCurveNames(all, byId), ["evans"]);
  assert.deepEqual(shortenCurveNames([all[0], all[1], `${all[0]}?p=3`], byId), [all[0], all[1], `${all[0]}?p=3`]);
  assert.match(exportCommand([`${all[0]}?p=3`], 1), /^coupler-atlas export atlas\.toml 'evans:1\.1\.1\?p=3' /);
  assert.throws(() => solveNamedCurve(evans, "evans:99.1.1"), /there is no curve/);
  assert.throws(() => solveNamedCurve(evans, "evans:1.1.1?p=-1"), /must be more than 0/);
  assert.throws(() => solveNamedCurve(evans, "evans:1.1.1?circuit=9"), /this circuit no longer exists/);
  const moved = manifestCase(evans, "evans:1.1.1?M.along=1&circuit=2");
  assert.match(extraCircuitsCommand([moved.name], curveNamesInManifest([moved])), /^# The atlas.*\n# A manifest cannot describe/);
  const changed = solveNamedCurve(evans, "evans:1.1.1?p=3&M.along=1");
  assert.equal(changed.values[0], 3);
  const fragment = manifestOfCurves([manifestCase(evans, changed.name)]);
  assert.match(fragment, /# evans:1\.1\.1\?p=3&M\.along=1: M\.along = 1 needs a \[\[linkage\]\]/);
}

// The program accepts the fragment of every family as part of a manifest.
function testAgainstProgram(families) {
  const folder = mkdtempSync(join(tmpdir(), "taken-"));
  const names = families.filter(({ linkage }) => CATALOGUE.includes(linkage)).flatMap((family) => namesOf(family).map((name) => [family, name]));
  const fragment = manifestOfCurves(names.map(([family, name]) => manifestCase(family, name)));
  writeFileSync(join(folder, "atlas.toml"), `[atlas]\ntitle = "T"\n${fragment}`);
  execFileSync(program, ["validate"], { cwd: folder });
  testEveryColumn(folder, fragment);
  testFurtherCircuits(folder, families);
  const manifest = process.env.MANIFEST;
  if (manifest) comparedExports(folder, manifest, families);
  rmSync(folder, { recursive: true });
}

// Tests every further column of every linkage of the catalogue, over all its circuits, as it is and mirrored.
function testEveryColumn(folder, fragment) {
  const listed = execFileSync(program, ["list", "columns"], { encoding: "utf8" }).trimEnd().split("\n");
  assert.deepEqual(columnNames(), listed.map((line) => line.split(" ")[0]), "the columns");
  const columns = `columns = ${JSON.stringify(columnNames())}`;
  for (const place of ["{ mirror = false }", '{ mirror = true, rotate = "20 deg" }']) {
    const manifest = fragment
      .replace(/^(place|columns) = .*\n/gm, "")
      .replace(/^circuits = .*$/gm, `circuits = "all"\nplace = ${place}\n${columns}\nformats = ["svg"]`);
    writeFileSync(join(folder, "columns.toml"), `[atlas]\ntitle = "T"\n${manifest}`);
    const out = join(folder, "columns");
    execFileSync(program, ["render", join(folder, "columns.toml"), "-o", out, "--force"], { stdio: "ignore" });
    const ids = [...manifest.matchAll(/^id = "(.*)"$/gm)].map(([, id]) => id);
    assert.equal(new Set(manifest.match(/^linkage = .*$/gm)).size, CATALOGUE.length, "every linkage");
    for (const id of ids) {
      const family = familyOf(out, id);
      const table = pointsOf(out, id);
      for (const name of namesOf(family)) comparedColumns(name, solveNamedCurve(family, name), table);
    }
    rmSync(out, { recursive: true });
  }
  assert.deepEqual(columnNames().filter((name) => !columnsWithNumbers.has(name)), [], "columns without a number");
}

// Tests circuits that the atlas does not have: the page and the program, from the exported fragment, give the
// same results except for names.
function testFurtherCircuits(folder, families) {
  const curves = families
    .filter(({ linkage, template, curves: { count } }) => CATALOGUE.includes(linkage) && template.circuits === "start" && count > 0)
    .flatMap((family) => [1, 2, 3].map((k) => manifestCase(family, `${namesOf(family).at(-1)}?circuit=${k}`)))
    .filter(({ family, name }) => isThere(family, name));
  const names = curveNamesInManifest(curves);
  writeFileSync(join(folder, "circuits.toml"), `[atlas]\ntitle = "T"\n${manifestOfCurves(curves)}`);
  const command = extraCircuitsCommand(curves.map(({ name }) => name), names).trimEnd().split("\n").at(-1).replaceAll("'", "");
  assert.equal(command.match(/ export (.*) --format/)[1], ["circuits.toml", ...names].join(" "));
  execFileSync(program, ["export", "circuits.toml", ...names, "--format", "csv,json", "-o", "curves"], { cwd: folder, stdio: "ignore" });
  const further = curves.filter(({ name }) => !name.endsWith("circuit=1"));
  assert.ok(further.length >= 10, `${further.length} further circuits`);
  curves.forEach(({ family, name }, k) => {
    const exported = solveNamedCurve(family, name);
    assert.match(fileStem(exported), /-\d+-\d+-circuit-\d$/);
    const [cell, trace, circuit] = names[k].split(":")[1].split(".");
    const theirs = (ending) => readFileSync(join(folder, "curves", `${names[k].replace(/[:.]/g, "-")}.${ending}`), "utf8");
    const [header, ...rows] = csvOfCurve(exported).split("\n");
    const renamed = rows.map((row) => row.replace(/^\d+,\d+,\d+/, `${cell},${trace},${circuit}`));
    assert.ok(isAlike([header, ...renamed].join("\n"), theirs("csv")), `${name}: the table`);
    const apart = ({ helpers, measures, ...rest }) => [JSON.stringify(rest), measures];
    const renamedJson = { curve: names[k], family: names[k].split(":")[0], cell: Number(cell) };
    const [own, ownMeasures] = apart({ ...JSON.parse(jsonOfCurve(exported, measures)), ...renamedJson });
    const [wanted, values] = apart(JSON.parse(theirs("json")));
    assert.ok(isAlike(own, wanted), `${name}: JSON`);
    // Missing and infinite values are null in both.
    for (const word of measures) if (ownMeasures[word] === null && values[word] === null) delete values[word];
    const complain = (where, sentence) => assert.fail(`${name}: ${sentence}`);
    const { linkage, motion, family: { straight } } = exported;
    compareMeasures({ name, measures: [{ trace: Number(trace), circuit: Number(circuit), values }], straight }, linkage, motion, complain);
    seen.beside += 1;
  });
}

function isThere(family, name) {
  try {
    return solveNamedCurve(family, name) !== null;
  } catch {
    return false;
  }
}

function comparedExports(folder, manifest, families) {
  const names = families.flatMap((family) => namesOf(family).map((name) => [family, name]));
  const words = [...names.map(([, name]) => name), "evans:1.1.1?p=2.5&M.along=3"];
  execFileSync(program, ["export", manifest, ...words, "--format", "csv,dxf,json,toml", "-o", join(folder, "taken")], { stdio: "ignore" });
  const off = [];
  for (const [family, name] of [...names, [families.find(({ id }) => id === "evans"), words[words.length - 1]]]) {
    const exported = solveNamedCurve(family, name);
    const stem = name.replace("?", "&").split("&").map((part, k) => (k === 0 ? part.replace(/[:.]/g, "-") : part.replace("=", "-"))).join("-");
    const made = { csv: csvOfCurve(exported), json: jsonOfCurve(exported, measures), dxf: dxfOfCurve(exported, data.program) };
    for (const [ending, mine] of Object.entries(made)) {
      const theirs = readFileSync(join(folder, "taken", `${stem}.${ending}`), "utf8");
      seen.files += 1;
      seen.identical += mine === theirs ? 1 : 0;
      if (!isAlike(mine, theirs)) off.push(`${stem}.${ending}`);
      if (mine !== theirs && process.env.SHOW) console.log(`${stem}.${ending} has other last digits`);
    }
  }
  assert.deepEqual(off, [], "files that are not the program's");
}

// Whether texts are the same except for the last digits of numbers.
function isAlike(mine, theirs) {
  const parts = (text) => text.split(/([-+]?\d+(?:\.\d+)?(?:e-?\d+)?)/);
  const [a, b] = [parts(mine), parts(theirs)];
  const near = (p, q) => Math.abs(p - q) <= 1e-6 * Math.max(1, Math.abs(q));
  return a.length === b.length && a.every((part, k) => part === b[k] || (k % 2 === 1 && near(Number(part), Number(b[k]))));
}

const families = data.families.filter(({ script, curves }) => script && curves > 0).map(comparedFamily);
testNumbersAndWords(families);
if (program) testAgainstProgram(families);
console.log(Object.entries(seen).map(([what, count]) => `${count} ${what}`).join(", "));
