// Makes an atlas that is larger than a page loads without a request, from a rendered one of one family.

import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/**
 * Copies the atlas of a folder, of one family with one piece of each series, and repeats its cells: the
 * copies have the same values and curves, with further numbers of cells and pages. Returns { folder, id,
 * copies, curves (of each copy), pages, cells (the last number of each copy), remove() }.
 */
export function largeAtlas(from, copies) {
  const folder = mkdtempSync(join(tmpdir(), "coupler-atlas-large-"));
  const page = readFileSync(join(from, "index.html"), "utf8");
  const pattern = /(<script type="application\/json" id="atlas">)([\s\S]*?)(<\/script>)/;
  const atlas = JSON.parse(page.match(pattern)[2]);
  const [family] = atlas.families;
  const { id } = family;
  mkdirSync(join(folder, id));
  const script = (name) => readFileSync(join(from, id, name), "utf8");
  const head = parsed(script("gallery.js").split("\n")[0]).value;
  const [tables, curves] = [head.pieces.table, head.pieces.curves];
  if (tables.length !== 1 || curves.length !== 1) throw new Error(`${from} has other pieces`);
  const pages = curves[0].pages;
  const cells = tables[0].numbers[1];
  let bytes = { table: 0, curves: 0 };
  for (const series of ["table", "curves"]) {
    const statements = script(`gallery-${series}-0001.js`).trimEnd().split("\n").map(parsed);
    for (let copy = 0; copy < copies; copy += 1) {
      const text = statements.map((one) => shifted(one, copy, cells, pages)).join("\n");
      writeFileSync(
        join(folder, id, `gallery-${series}-${String(copy + 1).padStart(4, "0")}.js`),
        `${text}\n`,
      );
      bytes = { ...bytes, [series]: bytes[series] + text.length };
    }
  }
  const repeated = ([entry]) =>
    Array.from({ length: copies }, (_, copy) => ({
      ...entry,
      numbers: entry.numbers.map((number) => number + copy * cells),
    }));
  head.pieces = { table: repeated(tables), curves: repeated(curves) };
  const end = script("gallery.js").trimEnd().split("\n").at(-1);
  writeFileSync(join(folder, id, "gallery.js"), `couplerAtlas.begin(${JSON.stringify(head)});\n${end}\n`);
  const listed = {
    ...family,
    cells: family.cells * copies,
    kept: family.kept * copies,
    curves: family.curves * copies,
    pages: pages * copies,
    bytes: bytes.table + bytes.curves,
    table_bytes: bytes.table,
    // Its pages are drawn from the data.
    page_format: null,
  };
  const data = JSON.stringify({ ...atlas, families: [listed] }).replaceAll("<", "\\u003c");
  writeFileSync(
    join(folder, "index.html"),
    page.replace(pattern, (_, before, __, after) => before + data + after),
  );
  for (const file of ["kernel.js", `${id}/${id}-001.svg`]) cpSync(join(from, file), join(folder, file));
  const remove = () => rmSync(folder, { recursive: true });
  return { folder, id, copies, curves: family.curves, pages, cells, remove };
}

function parsed(line) {
  // The points are in a comment after what they belong to.
  const [, name, json, comment] = line.match(/^couplerAtlas\.(\w+)\((.*?)(,\(\)=>\{.*)?\);$/);
  return { name, value: JSON.parse(json), comment };
}

/** A statement of a piece, with its numbers moved to those of a copy. */
function shifted({ name, value, comment = "" }, copy, cells, pages) {
  const changed = { ...value };
  if (name === "piece") changed.number = copy + 1;
  const run = (number) => {
    if (typeof number !== "number") throw new Error("the cells of a statement are no run");
    return number + copy * cells;
  };
  if (name === "cells") changed.number = run(value.number);
  if (name === "curves") changed.rows = { ...value.rows, number: run(value.rows.number) };
  if (name === "page") {
    changed.page = value.page + copy * pages;
    changed.views = value.views.map((view) => ({ ...view, cell: view.cell + copy * cells }));
  }
  return `couplerAtlas.${name}(${JSON.stringify(changed)}${comment});`;
}
