// Loads the curves to compare, from the atlas or with parameters changed on a plate.

import { cellText } from "../../data/family.js";
import { holdPieces, needCurveWithKey, needCurves, piecesOfCurves } from "../../data/needs.js";
import { singleCurveFamily } from "../../data/reader.js";
import { emptyBox, widenedBox } from "../../draw/plane-view.js";
import { parseCurveName, solveNamedCurve, measuresOfCurve } from "../../export/curve.js";

/**
 * The curve with a name, "evans:12.1.1" or "evans:12.1.1?p=2.5": { name, family, curve, key, changes: Map,
 * release }, or { name, reason } with a sentence that says why there is none. Its data are kept until
 * `release()`.
 */
export async function loadComparedCurve(atlas, name) {
  try {
    const { family: id, key, changes } = parseCurveName(name) ?? {};
    const family = await atlas.family(id ?? name);
    const curve = await needCurveWithKey(family, key);
    if (curve === undefined) return { name, reason: "not in this atlas" };
    await needCurves(family, [curve]);
    if (changes.size > 0)
      return {
        name,
        family: changedFamily(family, name, atlas.measures),
        curve: 0,
        key,
        changes,
        release: () => {},
      };
    return { name, family, curve, key, changes, release: holdPieces(piecesOfCurves(family, [curve])) };
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
  const { numbers, words } = splitMeasures(exported, measures);
  const cell = {
    number: exported.cell,
    values,
    status: exported.status === "ok" ? 0 : 1,
    trace: linkage.traced.indexOf(joint) + 1,
    circuit,
    closed: exported.circuitSamples.closed ? 1 : 0,
    measures: numbers,
    words,
  };
  const [caption, note] = ["caption", "note"].map((text) => cellText(family, place, text));
  const outline = {
    ...packPoints(exported.circuitSamples, joint),
    caption,
    note,
    reason: exported.reason ?? "",
  };
  return singleCurveFamily({ ...family, template }, cell, outline);
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

/** The positions of a joint over a sampled circuit, as a family stores them: { box, counts, points }. */
function packPoints({ x, y, count }, joint) {
  const box = Float64Array.from(widenedBox(emptyBox(), x[joint], y[joint], count));
  const points = new Uint16Array(2 * count);
  const part = (value, low, high) => (high > low ? Math.round((65535 * (value - low)) / (high - low)) : 0);
  for (let k = 0; k < count; k += 1) {
    points[2 * k] = part(x[joint][k], box[0], box[2]);
    points[2 * k + 1] = part(y[joint][k], box[1], box[3]);
  }
  return { box, counts: Uint16Array.of(count), points };
}
