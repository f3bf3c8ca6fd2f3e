// The indexes of families by shape, kept as long as the page is open.

import { indexing, indexingWindows } from "../../shape/indexing.js";
import { inSlices } from "./slices.js";

const INDEXES = new WeakMap();

/**
 * The index of a family; with windows no shorter than `least` of a curve, unless that is null. Null if
 * stopped.
 */
export async function indexFor(family, least, stopped) {
  if (!INDEXES.has(family)) {
    const index = await inSlices(indexing(family), stopped);
    if (!index) return null;
    INDEXES.set(family, index);
  }
  const index = INDEXES.get(family);
  if (least !== null) await inSlices(indexingWindows(index, least), stopped);
  return stopped() ? null : index;
}
