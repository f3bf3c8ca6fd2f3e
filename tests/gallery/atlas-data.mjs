// Reads the families of a rendered atlas under node, as the page reads them.

import { readFileSync } from "node:fs";
import { join } from "node:path";

import { FamilyReader } from "../../src/gallery/script/data/family.js";

/** The data in the page of an atlas, and all its families: { data, families }. */
export function atlasOf(folder) {
  const page = readFileSync(join(folder, "index.html"), "utf8");
  const data = JSON.parse(page.match(/<script type="application\/json" id="atlas">([\s\S]*?)<\/script>/)[1]);
  return {
    data,
    families: data.families
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

/**
 * Runs a generator to its end: { value, longest, whole }, the longest step and the whole time in
 * milliseconds.
 */
export function runToEnd(generator) {
  const began = performance.now();
  let longest = 0;
  for (;;) {
    const from = performance.now();
    const { value, done } = generator.next();
    longest = Math.max(longest, performance.now() - from);
    if (done) return { value, longest, whole: performance.now() - began };
  }
}

/** Pseudorandom numbers from 0 to 1 from a seed (a linear congruential generator of Numerical Recipes). */
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}
