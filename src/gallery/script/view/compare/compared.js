// The curves that are compared: those of the atlas, and those whose parameters were changed on a plate.

import { curveAt } from "../../data/family.js";
import { emptyBox, widenedBox } from "../../draw/plane-view.js";
import { parsedName, takenCurve, takenMeasures } from "../../take/taken.js";

/**
 * The curve of a name, "evans:12.1.1" or "evans:12.1.1?p=2.5": { name, family, curve, key, changes: Map }, or
 * { name, reason } with a sentence on why there is none.
 */
export async function comparedCurve(atlas, name) {
  try {
    const { family: id, key, changes } = parsedName(name) ?? {};
    const family = await atlas.family(id ?? name);
    const curve = curveAt(family, key);
    if (curve === undefined) return { name, reason: "not in this atlas" };
    if (changes.size === 0) return { name, family, curve, key, changes };
    return { name, family: changedFamily(family, name, atlas.measures), curve: 0, key, changes };
  } catch (error) {
    // Sentences of what is solved begin with the name.
    return { name, reason: error.message.replace(`${name}: `, "") };
  }
}

/**
 * What a name with changed parameters makes of a family: one with this curve alone, solved and measured by
 * the page, so that it is drawn, laid over others and told of as the curves of the atlas are.
 *
 * @throws {Error} a sentence on why it cannot be assembled
 */
function changedFamily(family, name, measures) {
  const taken = takenCurve(family, name);
  const { place, values, template, linkage, joint, circuit } = taken;
  const { cells } = family;
  const of = (list) => [list[place]];
  const { numbers, words } = measuredApart(taken, measures);
  return {
    ...family,
    template,
    cells: {
      count: 1,
      number: Uint32Array.of(taken.cell),
      values,
      status: Uint8Array.of(taken.status === "ok" ? 0 : 1),
      reason: [taken.reason ?? ""],
      caption: of(cells.caption),
      note: of(cells.note),
    },
    curves: {
      count: 1,
      cell: Uint32Array.of(0),
      trace: Uint16Array.of(linkage.traced.indexOf(joint) + 1),
      circuit: Uint16Array.of(circuit),
      page: Uint32Array.of(0),
      closed: Uint8Array.of(taken.course.closed ? 1 : 0),
      measures: numbers,
      words,
      ...packedPlaces(taken.course, joint),
    },
    places: new Map([[parsedName(name).key, 0]]),
    pages: [],
  };
}

/** Measures of a taken curve as a family has them, numbers and words apart. */
function measuredApart(taken, measures) {
  const isWord = new Map(measures.map(({ name, word }) => [name, word]));
  const [numbers, words] = [{}, {}];
  for (const [name, value] of takenMeasures(taken, [...isWord.keys()])) {
    if (value === null) continue;
    if (isWord.get(name)) words[name] = { values: [value], codes: Uint8Array.of(0) };
    else numbers[name] = Float64Array.of(value);
  }
  return { numbers, words };
}

/** The places of a joint over a sampled circuit as a family packs them: { box, start, points }. */
function packedPlaces({ x, y, count }, joint) {
  const box = Float64Array.from(widenedBox(emptyBox(), x[joint], y[joint], count));
  const points = new Uint16Array(2 * count);
  const part = (value, low, high) => (high > low ? Math.round((65535 * (value - low)) / (high - low)) : 0);
  for (let k = 0; k < count; k += 1) {
    points[2 * k] = part(x[joint][k], box[0], box[2]);
    points[2 * k + 1] = part(y[joint][k], box[1], box[3]);
  }
  return { box, start: Uint32Array.of(0, count), points };
}
