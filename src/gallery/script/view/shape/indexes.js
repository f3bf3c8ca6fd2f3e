// The shape indexes of families, cached while the page is open.

import { buildIndex, addWindows } from "../../shape/shape-index.js";
import { runInSlices } from "./slices.js";

const SHAPE_INDEXES = new WeakMap();

/**
 * The shape index of a family, with windows no shorter than `least` of a curve unless that is null. Null if
 * stopped.
 */
export async function shapeIndex(family, least, stopped) {
  if (!SHAPE_INDEXES.has(family)) {
    const index = await runInSlices(buildIndex(family), stopped);
    if (!index) return null;
    SHAPE_INDEXES.set(family, index);
  }
  const index = SHAPE_INDEXES.get(family);
  if (least !== null) await runInSlices(addWindows(index, least), stopped);
  return stopped() ? null : index;
}
