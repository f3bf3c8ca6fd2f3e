// Loads the curves to compare, from the atlas or with parameters changed on a plate.

import { parseCurveName } from "../../data/address.js";
import { holdPieces, needCurveWithKey, needCurves, piecesOfCurves } from "../../data/needs.js";
import { familyOfCell } from "../../data/reader.js";

/**
 * The curve with a name, "evans:12.1.1" or "evans:12.1.1?p=2.5", or a sentence that says why there is none. Its
 * data are kept until `release()`.
 * @param {App} app @param {string} name @returns {Promise<ComparedCurve | { name: string, reason: string }>}
 */
export async function loadComparedCurve(app, name) {
  try {
    const { key, changes, ...named } = parseCurveName(name) ?? { family: name, key: "", changes: new Map() };
    const family = await app.atlas.family(named.family);
    const curve = await needCurveWithKey(family, key);
    if (curve === undefined) return { name, reason: "not in this atlas" };
    await needCurves(family, [curve]);
    if (changes.size > 0) {
      const kernel = await app.kernel.load();
      const changed = changedFamily(kernel, { family, curve, changes });
      return { name, ...changed, curve: 0, key, changes, release: () => {} };
    }
    return { name, family, curve, key, changes, release: holdPieces(piecesOfCurves(family, [curve])) };
  } catch (error) {
    return { name, reason: error.message };
  }
}

/**
 * A family that contains only a curve with changed parameters, so that it can be drawn, aligned and described like the
 * curves of the atlas: { family, requested, shown }.
 *
 * @throws {Error} a sentence that says why it cannot be assembled
 * @param {Kernel} kernel @param {CurveOfFamily & { changes: Map<string, number> }} _1
 */
function changedFamily(kernel, { family, curve, changes }) {
  const parameters = new Map(changes);
  // The number of a circuit among all, unless it is a parameter.
  const number = family.names.includes("circuit") ? undefined : parameters.get("circuit");
  if (number !== undefined) parameters.delete("circuit");
  const requested = kernel.curve(family, curve, parameters);
  const data = kernel.curveData(kernel.curve(family, curve, changes));
  return { family: familyOfCell(data, family), requested, shown: number === undefined ? null : number - 1 };
}
