// Makes an atlas with unusual families from a rendered one: cases that the gallery must handle although they
// are rare.

import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** A title that looks like markup. */
export const MARKED_TITLE = '<b>Evans</b> & <img src=x onerror="throw 1">';

/** Why the third linkage of the family "evans" could not be assembled. */
export const ODD_REASON = "the links p and a do not reach <one> another";

// The smallest PNG: a white dot.
const WHITE_DOT =
  "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mP8/x8AAwMCAO+ip1sAAAAASUVORK5CYII=";

/**
 * Copies the atlas of a folder to a temporary one: "evans" with a title in markup, no pictures of its pages,
 * and its third linkage not assembled; "watt" with a PNG on dark paper; and one more, with the name
 * "find" of a view and the data of "roberts". Returns { folder, remove() }.
 */
export function oddAtlas(from) {
  const folder = mkdtempSync(join(tmpdir(), "coupler-atlas-odd-"));
  cpSync(from, folder, { recursive: true, dereference: true });
  rewrite(join(folder, "index.html"), (page) =>
    page.replace(
      /(<script type="application\/json" id="atlas">)([\s\S]*?)(<\/script>)/,
      (_, before, data, after) =>
        before + JSON.stringify(withOddFamilies(JSON.parse(data))).replaceAll("<", "\\u003c") + after,
    ),
  );
  rewrite(join(folder, "evans/gallery.js"), (script) => script.split("\n").map(oddStatement).join("\n"));
  writeFileSync(join(folder, "watt/watt-001.png"), Buffer.from(WHITE_DOT, "base64"));
  rewrite(join(folder, "watt/gallery.js"), (script) => script.replace('"is_dark":false', '"is_dark":true'));
  mkdirSync(join(folder, "find"));
  const roberts = readFileSync(join(folder, "roberts/gallery.js"), "utf8");
  writeFileSync(join(folder, "find/gallery.js"), roberts.replace('"id":"roberts"', '"id":"find"'));
  return { folder, remove: () => rmSync(folder, { recursive: true }) };
}

function rewrite(file, change) {
  const text = readFileSync(file, "utf8");
  rmSync(file);
  writeFileSync(file, change(text));
}

function withOddFamilies(atlas) {
  const families = atlas.families.map((family) => {
    if (family.id === "evans") return { ...family, title: MARKED_TITLE, page_format: null, not_assembled: 1 };
    return family.id === "watt" ? { ...family, page_format: "png" } : family;
  });
  const roberts = families.find(({ id }) => id === "roberts");
  families.push({ ...roberts, id: "find", title: "Find me", page_format: null, script: "find/gallery.js" });
  return { ...atlas, families, book: ["atlas.pdf"] };
}

/** A statement of a family's script, with the oddities of "evans". */
function oddStatement(line) {
  // The points are in a comment after what they belong to.
  const [, name, json, points = ""] = line.match(/^couplerAtlas\.(\w+)\((.*?)(,\(\)=>\{.*)?\);$/) ?? [];
  if (!name) return line;
  const value = JSON.parse(json);
  if (name === "begin") value.title = MARKED_TITLE;
  if (name === "page") value.views = value.views.filter(({ cell }) => cell !== 3);
  if (name === "cells") {
    // The column is a number if all cells have the same status.
    const status = Buffer.alloc(value.count, typeof value.status === "number" ? value.status : 0);
    if (typeof value.status === "string") status.set(Buffer.from(value.status, "base64"));
    status[2] = 2;
    value.status = status.toString("base64");
  }
  if (name === "curves") {
    value.reason = Array.from({ length: value.cells }, (_, k) => value.reason[k] ?? "");
    value.reason[2] = ODD_REASON;
  }
  return `couplerAtlas.${name}(${JSON.stringify(value)}${points});`;
}
