// Helpers of the tests of exports: read families from the scripts of an atlas, tables and archives.

import { readFileSync } from "node:fs";
import { join } from "node:path";

import { familyOf as familyOfScript } from "./atlas-data.mjs";

/** A family of the atlas in a folder. */
export function familyOf(folder, id) {
  return familyOfScript(folder, `${id}/gallery.js`);
}

/** The table points.csv of a family: { header, rows: Map of "cell.trace.circuit" to lines }. */
export function pointsOf(folder, id) {
  const [header, ...lines] = readFileSync(join(folder, id, "points.csv"), "utf8")
    .trimEnd()
    .split("\n");
  const rows = new Map();
  for (const line of lines) {
    const key = line.split(",", 3).join(".");
    if (!rows.has(key)) rows.set(key, []);
    rows.get(key).push(line);
  }
  return { header, rows };
}

/** The entities of a DXF document, [{ kind, groups: Map, vertices }], read by pairs of lines. */
export function entitiesOf(dxf) {
  const lines = dxf.trimEnd().split("\n");
  const pairs = [];
  for (let k = 0; k + 1 < lines.length; k += 2) pairs.push([Number(lines[k]), lines[k + 1]]);
  const begin = pairs.findIndex(
    ([code, value], k) => code === 2 && value === "ENTITIES" && pairs[k - 1][1] === "SECTION",
  );
  const entities = [];
  let last = null;
  for (const [code, value] of pairs.slice(begin + 1)) {
    if (code === 0 && (value === "ENDSEC" || value === "EOF")) continue;
    if (code === 0) {
      last = { kind: value, groups: new Map(), vertices: [] };
      if (value === "VERTEX") entities[entities.length - 1].vertices.push(last);
      else if (value !== "SEQEND") entities.push(last);
    } else last.groups.set(code, value);
  }
  return entities;
}

/** The files of an archive that is stored without compression, [{ name, bytes }]. */
export function filesOfZip(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const files = [];
  let at = 0;
  while (view.getUint32(at, true) === 0x04034b50) {
    const [size, name] = [view.getUint32(at + 18, true), view.getUint16(at + 26, true)];
    const from = at + 30 + name + view.getUint16(at + 28, true);
    files.push({
      name: new TextDecoder().decode(bytes.subarray(at + 30, at + 30 + name)),
      bytes: bytes.subarray(from, from + size),
    });
    at = from + size;
  }
  return files;
}
