// Reads the families of a rendered atlas under node, as the page reads them.

import { readFileSync } from "node:fs";
import { join } from "node:path";

import { FamilyReader } from "../../src/gallery/script/data/family.js";

/** What the page of an atlas says of it, and all its families: { told, families }. */
export function atlasOf(folder) {
  const page = readFileSync(join(folder, "index.html"), "utf8");
  const told = JSON.parse(page.match(/<script type="application\/json" id="atlas">([\s\S]*?)<\/script>/)[1]);
  return {
    told,
    families: told.families
      .filter(({ script }) => script)
      .map(({ script }) => familyOf(join(folder, script))),
  };
}

function familyOf(file) {
  let reader = null;
  let family = null;
  const couplerAtlas = {
    begin: (head) => {
      reader = new FamilyReader(head);
    },
    cells: (chunk) => reader.cells(chunk),
    page: (page) => reader.page(page),
    end: () => {
      family = reader.finish();
    },
  };
  new Function("couplerAtlas", readFileSync(file, "utf8"))(couplerAtlas);
  return family;
}

/** Runs a generator to its end: { value, longest: of its steps in milliseconds, whole }. */
export function finished(generator) {
  const began = performance.now();
  let longest = 0;
  for (;;) {
    const from = performance.now();
    const { value, done } = generator.next();
    longest = Math.max(longest, performance.now() - from);
    if (done) return { value, longest, whole: performance.now() - began };
  }
}

/** Numbers from 0 to 1, the same of the same seed (a linear congruence of Numerical Recipes). */
export function randoms(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}
