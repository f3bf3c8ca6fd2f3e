// Loads the curves to compare, from the atlas or with parameters changed on a plate.

import { findCurve } from "../../data/family.js";
import { emptyBox, widenedBox } from "../../draw/plane-view.js";
import { parseCurveName, solveNamedCurve, measuresOfCurve } from "../../export/curve.js";

/**
 * The curve with a name, "evans:12.1.1" or "evans:12.1.1?p=2.5": { name, family, curve, key, changes: Map },
 * or { name, reason } with a sentence that says why there is none.
 */
export async function loadComparedCurve(atlas, name) {
  try {
    const { family: id, key, changes } = parseCurveName(name) ?? {};
    const family = await atlas.family(id ?? name);
    const curve = findCurve(family, key);
    if (curve === undefined) return { name, reason: "not in this atlas" };
    if (changes.size === 0) return { name, family, curve, key, changes };
    return { name, family: changedFamily(family, name, atlas.measures), curve: 0, key, changes };
  } catch (error) {
    // Messages of the solver start with the name.
    return { name, reason: error.message.replace(`${name}: `, "") };
  }
}

/**
 * A family that contains only the curve with changed parameters, solved and measured by the page, so that it
 * can be drawn, aligned and described like the curves of the atlas.
 *
 * @throws {Error} a sentence that says why it cannot be assembled
 */
function changedFamily(family, name, measures) {
  const exported = solveNamedCurve(family, name);
  const { place, values, template, linkage, joint, circuit } = exported;
  const { cells } = family;
  const of = (list) => [list[place]];
  const { numbers, words } = splitMeasures(exported, measures);
  return {
    ...family,
    template,
    cells: {
      count: 1,
      number: Uint32Array.of(exported.cell),
      values,
      status: Uint8Array.of(exported.status === "ok" ? 0 : 1),
      reason: [exported.reason ?? ""],
      caption: of(cells.caption),
      note: of(cells.note),
    },
    curves: {
      count: 1,
      cell: Uint32Array.of(0),
      trace: Uint16Array.of(linkage.traced.indexOf(joint) + 1),
      circuit: Uint16Array.of(circuit),
      page: Uint32Array.of(0),
      closed: Uint8Array.of(exported.circuitSamples.closed ? 1 : 0),
      measures: numbers,
      words,
      ...packPoints(exported.circuitSamples, joint),
    },
    places: new Map([[parseCurveName(name).key, 0]]),
    pages: [],
  };
}

/** Splits the measures of an exported curve into numbers and words, as a family stores them. */
function splitMeasures(exported, measures) {
  const isWord = new Map(measures.map(({ name, word }) => [name, word]));
  const [numbers, words] = [{}, {}];
  for (const [name, value] of measuresOfCurve(exported, [...isWord.keys()])) {
    if (value === null) continue;
    if (isWord.get(name)) words[name] = { values: [value], codes: Uint8Array.of(0) };
    else numbers[name] = Float64Array.of(value);
  }
  return { numbers, words };
}

/** The positions of a joint over a sampled circuit, as a family stores them: { box, start, points }. */
function packPoints({ x, y, count }, joint) {
  const box = Float64Array.from(widenedBox(emptyBox(), x[joint], y[joint], count));
  const points = new Uint16Array(2 * count);
  const part = (value, low, high) => (high > low ? Math.round((65535 * (value - low)) / (high - low)) : 0);
  for (let k = 0; k < count; k += 1) {
    points[2 * k] = part(x[joint][k], box[0], box[2]);
    points[2 * k + 1] = part(y[joint][k], box[1], box[3]);
  }
  return { box, start: Uint32Array.of(0, count), points };
}
