// The indexes of families by shape, kept as long as the page is open.

import { buildIndex, addWindows } from "../../shape/shape-index.js";
import { inSlices } from "./slices.js";

const INDEXES = new WeakMap();

/**
 * The index of a family; with windows no shorter than `least` of a curve, unless that is null. Null if
 * stopped.
 */
export async function indexFor(family, least, stopped) {
  if (!INDEXES.has(family)) {
    const index = await inSlices(buildIndex(family), stopped);
    if (!index) return null;
    INDEXES.set(family, index);
  }
  const index = INDEXES.get(family);
  if (least !== null) await inSlices(addWindows(index, least), stopped);
  return stopped() ? null : index;
}
