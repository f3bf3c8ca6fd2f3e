// Families of a single cell, which the kernel makes: the linkages that plates begin with, of its catalogue and of the families of the atlas,
// and the curve of the file of a plate.

import { newLinkage } from "../data/address.js";
import { familyOfCell } from "../data/reader.js";

/**
 * An atlas with `linkages()`, which resolves to the linkages, and whose `family("new/four-bar")` resolves to a family of one, with a
 * single cell: its values are those of the catalogue, or those that a family of the atlas begins with.
 * @param {AtlasFiles} atlas @param {App["kernel"]} kernel
 */
export function withLinkages(atlas, kernel) {
  /** @type {Map<string, Promise<Family>>} */ const opened = new Map();
  const linkages = async () => {
    /** @type {NewLinkage[]} */ const known = (await kernel.load()).call({ method: "catalogue" }).linkages;
    const isKnown = new Set(known.map(({ id }) => id));
    const others = atlas.families.filter(({ linkage, script }) => script && !isKnown.has(linkage));
    const own = others.map((one) => ({ id: one.linkage, legend: one.title, manifest: "", family: one.id }));
    // The first family of each.
    return known.concat(own.filter(({ id }, k) => own.findIndex((one) => one.id === id) === k));
  };
  const open = async (/** @type {string} */ id, /** @type {string} */ linkage) => {
    const found = (await linkages()).find((one) => one.id === linkage);
    if (!found) throw new Error(`there is no linkage “${linkage}” in the catalogue or in this atlas`);
    const { manifest } = found.family ? await atlas.family(found.family) : found;
    const known = { id, title: linkage, manifest };
    const loaded = await kernel.load();
    return familyOfCell(loaded.call({ method: "first_cell", family: loaded.family(known).handle }), known);
  };
  const openPlate = async (/** @type {PlateOfFile} */ { request, ranges, free, ...known }) => {
    const loaded = await kernel.load();
    const data = loaded.curveData({ family: loaded.family(known), curve: request });
    return { ...familyOfCell(data, known), ranges, free };
  };
  const { plate } = atlas;
  const family = (/** @type {string} */ id) => {
    const linkage = newLinkage(id);
    if (plate ? plate.id !== id : linkage === null) return atlas.family(id);
    const one = opened.get(id) ?? (plate ? openPlate(plate) : open(id, linkage ?? ""));
    opened.set(id, one);
    return one;
  };
  return { ...atlas, family, linkages };
}
