// Loads the curves to compare, from the atlas or with parameters changed on a plate.

import { parseCurveName } from "../../data/address.js";
import { cellText } from "../../data/family.js";
import { holdPieces, needCurveWithKey, needCurves, piecesOfCurves } from "../../data/needs.js";
import { packedPoints, singleCurveFamily } from "../../data/reader.js";
import { boxOfPoints } from "../../draw/plane-view.js";

// The chord error of a changed curve, relative to its size.
const CHANGED_PATH = 1e-4;

/**
 * The curve with a name, "evans:12.1.1" or "evans:12.1.1?p=2.5", or a sentence that says why there is none. Its
 * data are kept until `release()`.
 * @param {App} app @param {string} name @returns {Promise<ComparedCurve | { name: string, reason: string }>}
 */
export async function loadComparedCurve(app, name) {
  try {
    const {
      family: id,
      key,
      changes,
    } = parseCurveName(name) ?? { family: name, key: "", changes: new Map() };
    const family = await app.atlas.family(id);
    const curve = await needCurveWithKey(family, key);
    if (curve === undefined) return { name, reason: "not in this atlas" };
    await needCurves(family, [curve]);
    if (changes.size > 0) {
      const kernel = await app.kernel.load();
      const changed = changedFamily(kernel, { family, curve, changes }, app.atlas.measures);
      return { name, ...changed, curve: 0, key, changes, release: () => {} };
    }
    return { name, family, curve, key, changes, release: holdPieces(piecesOfCurves(family, [curve])) };
  } catch (error) {
    return { name, reason: error.message };
  }
}

/**
 * A family that contains only a curve with changed parameters, solved and measured by the kernel, so that it
 * can be drawn, aligned and described like the curves of the atlas: { family, requested, shown }.
 *
 * @throws {Error} a sentence that says why it cannot be assembled
 * @param {Kernel} kernel @param {CurveOfFamily & { changes: Map<string, number> }} _1
 * @param {Measure[]} measures
 */
function changedFamily(kernel, { family, curve, changes }, measures) {
  const parameters = new Map(changes);
  // The number of a circuit among all, unless it is a parameter.
  const number = family.names.includes("circuit") ? undefined : parameters.get("circuit");
  if (number !== undefined) parameters.delete("circuit");
  const shown = number === undefined ? null : number - 1;
  const requested = kernel.curve(family, curve, parameters);
  const study = kernel.study(requested, { shown });
  try {
    const { answer } = study;
    if (answer.study === undefined) throw new Error(answer.reason);
    if (shown !== null && answer.shown !== shown) throw new Error(`there is no circuit ${number}`);
    return { family: familyOfStudy(study, answer, { family, curve, number }, measures), requested, shown };
  } finally {
    study.close();
  }
}

/**
 * @param {KernelStudy} study @param {StudyAnswer} answer @param {CurveOfFamily & { number?: number }} _
 * @param {Measure[]} measures
 */
function familyOfStudy(study, answer, { family, curve, number }, measures) {
  const { values, circuits, shown, shortfall, curve_box: box } = answer;
  const { curves, cells } = family;
  const place = curves.cell[curve];
  const { closed } = circuits[shown];
  const size = Math.hypot(box[2] - box[0], box[3] - box[1]);
  const path = study.path(CHANGED_PATH * size).lead;
  // The path of a closed curve ends where it starts.
  const points = closed ? path.subarray(0, path.length - 2) : path;
  /** @type {Cells} */ const cell = {
    count: 1,
    number: cells.number.slice(place, place + 1),
    values: Float64Array.from(family.names, (name) => values[name]),
    assignment: cells.assignment.slice(place, place + 1),
    status: Uint8Array.of(shortfall === null ? 0 : 1),
  };
  /** @type {Curves} */ const own = {
    count: 1,
    cell: Uint32Array.of(0),
    trace: curves.trace.slice(curve, curve + 1),
    circuit: Uint16Array.of(number ?? curves.circuit[curve]),
    closed: Uint8Array.of(closed ? 1 : 0),
    ...splitMeasures(study.measures().values, measures),
  };
  const [caption, note] = [cellText(family, place, "caption"), cellText(family, place, "note")];
  const texts = { caption: [caption], note: [note], reason: [shortfall ?? ""] };
  return singleCurveFamily(family, cell, own, { ...packPoints(points), ...texts, pages: new Map() });
}

/** Splits measures { name: value } into numbers and words, as a family stores them: { measures, words }. */
function splitMeasures(/** @type {Measured} */ values, /** @type {Measure[]} */ known) {
  const isWord = new Map(known.map(({ name, word }) => [name, word]));
  const [numbers, words] = [{}, {}];
  for (const [name, value] of Object.entries(values)) {
    if (isWord.get(name)) words[name] = { values: [value], codes: Uint8Array.of(0) };
    else numbers[name] = Float64Array.of(Number(value));
  }
  return { measures: numbers, words };
}

/** Points as a loaded piece has them. @param {Float64Array} places */
function packPoints(places) {
  const box = Float64Array.from(boxOfPoints(places));
  const part = (value, low, high) => (high > low ? Math.round((65535 * (value - low)) / (high - low)) : 0);
  const points = Uint16Array.from(places, (value, k) => part(value, box[k % 2], box[2 + (k % 2)]));
  return packedPoints(box, Uint16Array.of(places.length / 2), points);
}
