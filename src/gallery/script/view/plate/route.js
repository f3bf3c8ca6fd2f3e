// The route of a curve's plate.

import { curveOfPath, newLinkage } from "../../data/address.js";
import { holdPieces, needCurveWithKey, piecesOfCurves } from "../../data/needs.js";
import { stillPlateLayout } from "./layout.js";
import { Plate } from "./plate.js";

/** The route `#/evans/curve/12.1.1?p=2.5`, or `#/new/four-bar?crank=1.2`: the linkage of a curve in motion. @type {Route} */
export const plateRoute = {
  name: "curve",
  parent: "families",
  matches: ({ path }) => curveOfPath(path) !== null,
  open: async (app, target) => {
    const { id = "", key = "" } = curveOfPath(target.path) ?? {};
    // The kernel is loaded meanwhile.
    app.kernel.load().catch(() => {});
    const family = await app.atlas.family(id);
    const curve = await needCurveWithKey(family, key);
    if (curve === undefined) throw new Error(`There is no curve “${key}” in “${family.title}”.`);
    const release = holdPieces(piecesOfCurves(family, [curve]));
    const plate = await openPlate(app, family, curve, target.query);
    return {
      title: `${family.title}, ${key}`,
      element: plate.element,
      update: ({ path, query }) => String(path) === String(target.path) && plate.setQuery(query),
      shown: () => plate.shown(),
      leave: () => {
        release();
        plate.leave();
      },
    };
  },
};

/** The route of a plate of a linkage in no family. @type {Route} */
export const newPlateRoute = {
  ...plateRoute,
  name: "new-curve",
  parent: "new",
  matches: ({ path }) => newLinkage(curveOfPath(path)?.id ?? "") !== null,
};

/** The route of the plate of a file that has no other. @type {Route} */
export const onlyPlateRoute = {
  ...plateRoute,
  matches: ({ path }, { atlas: { plate } }) => {
    const { id, key } = curveOfPath(path) ?? {};
    return id !== undefined && id === plate?.id && key === plate.key;
  },
};

/** The plate of a curve; without the kernel, one that stands still and says so. @param {App} app @param {Family} family @param {AddressQuery} query */
async function openPlate(app, family, /** @type {number} */ curve, query) {
  try {
    return new Plate(app, await app.kernel.load(), family, curve, query);
  } catch (error) {
    const still = stillPlateLayout(app, family, curve, error.message);
    return { ...still, shown: () => {}, setQuery: () => true };
  }
}
