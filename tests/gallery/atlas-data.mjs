// Reads the families of a rendered atlas under node, as the page reads them.

import { readFileSync } from "node:fs";
import { join } from "node:path";

import { headReader, PieceReader } from "../../src/gallery/script/data/reader.js";

/** The data in the page of an atlas, and all its families: { data, families }. */
export function atlasOf(folder) {
  const page = readFileSync(join(folder, "index.html"), "utf8");
  const data = JSON.parse(page.match(/<script type="application\/json" id="atlas">([\s\S]*?)<\/script>/)[1]);
  return {
    data,
    families: data.families.filter(({ script }) => script).map(({ script }) => familyOf(folder, script)),
  };
}

/** The family with a script in the folder of an atlas, with all its pieces. */
export function familyOf(folder, script) {
  let reader = null;
  let family = null;
  const couplerAtlas = {
    begin: (head) => {
      reader = headReader(head);
    },
    piece: ({ series, number }) => {
      const { pieces } = series === "table" ? family.table : family.outlines;
      reader = new PieceReader(family, [pieces[number - 1]]);
    },
    cells: (rows) => reader.cells(rows),
    curves: (outlines, comment) => reader.curves(outlines, comment),
    page: (page) => reader.page(page),
    end: () => {
      family = reader.finish() ?? family;
    },
  };
  const run = (file) => new Function("couplerAtlas", readFileSync(join(folder, file), "utf8"))(couplerAtlas);
  run(script);
  for (const piece of [...family.table.pieces, ...family.outlines.pieces]) if (!piece.data) run(piece.file);
  return family;
}

/** Pseudorandom numbers from 0 to 1 from a seed (a linear congruential generator of Numerical Recipes). */
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}
