// The shape that an address has.

import { curveOutline } from "../../data/family.js";
import { needCurveWithKey, needCurves } from "../../data/needs.js";
import { decodeShape } from "../../shape/encode.js";

/** The drawn shape of a state, or a curve of the atlas. @param {App} app @param {ShapeQuery} _ @returns {Promise<Outline | null>} */
export async function outlineOfState({ atlas }, { d, place, like }) {
  if (d) return decodeShape(d, place);
  if (!like) return null;
  const [id, key] = like.split(":");
  const family = await atlas.family(id);
  const curve = await needCurveWithKey(family, key ?? "");
  if (curve === undefined) throw new Error(`There is no curve ${key} in the family ${id}.`);
  await needCurves(family, [curve]);
  return curveOutline(family, curve);
}
