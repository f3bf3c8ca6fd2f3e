// The route of a curve's plate.

import { holdPieces, needCurveWithKey, piecesOfCurves } from "../../data/needs.js";
import { Plate } from "./plate.js";

/** The route `#/evans/curve/12.1.1?p=2.5`: the linkage of a curve in motion. */
export const plateRoute = {
  name: "curve",
  parent: "families",
  matches: ({ path }) => path.length === 3 && path[1] === "curve",
  open: async (app, target) => {
    const [id, , key] = target.path;
    const family = await app.atlas.family(id);
    const curve = await needCurveWithKey(family, key);
    if (curve === undefined) throw new Error(`There is no curve “${key}” in “${family.title}”.`);
    const release = holdPieces(piecesOfCurves(family, [curve]));
    const plate = new Plate(app, family, curve, target.query);
    return {
      title: `${family.title}, ${key}`,
      element: plate.element,
      update: ({ path, query }) => path[0] === id && path[2] === key && plate.setQuery(query),
      shown: () => plate.shown(),
      leave: () => {
        release();
        plate.leave();
      },
    };
  },
};
