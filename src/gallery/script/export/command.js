// Command lines that export the same curves with the program.

import { curveCountOf, findCurve } from "../data/family.js";

/** The command that exports `count` curves, selected by `words` (shortenCurveNames), from the manifest in the atlas's folder. */
export function exportCommand(/** @type {string[]} */ words, /** @type {number} */ count) {
  const formats = ["svg", "moving-svg", "png", "dxf", "csv", "json", "toml"];
  const chosen = count > 20 ? ["svg", "dxf", "csv", "json", "toml"] : formats;
  const named = words.map(quoteForShell).join(" ");
  return `coupler-atlas export atlas.toml ${named} --format ${chosen.join(",")} -o curves\n`;
}

/**
 * The shortest list of words that selects the same curves: a family's id for all its curves, a cell's number
 * for all curves of the cell. `families` maps ids to families.
 * @param {string[]} names @param {Map<string, Family>} families
 */
export function shortenCurveNames(names, families) {
  const words = [];
  /** @type {Map<string, string[]>} */ const plain = new Map();
  for (const name of new Set(names)) {
    if (name.includes("?")) words.push(name);
    else {
      const [id, key] = name.split(":");
      plain.set(id, [...(plain.get(id) ?? []), key]);
    }
  }
  const shortened = [...plain].flatMap(([id, keys]) => {
    const family = families.get(id);
    if (!family) return [];
    if (keys.length === family.curves.count) return [id];
    /** @type {Map<number, string[]>} */ const named = new Map();
    for (const key of keys) {
      const cell = Number(key.split(".")[0]);
      named.set(cell, [...(named.get(cell) ?? []), key]);
    }
    const isWhole = (/** @type {string[]} */ [key, ...others]) =>
      others.length > 0 &&
      others.length + 1 === curveCountOf(family, family.curves.cell[findCurve(family, key) ?? 0]);
    return [...named].flatMap(([cell, own]) =>
      isWhole(own) ? [`${id}:${cell}`] : own.map((key) => `${id}:${key}`),
    );
  });
  return [...shortened, ...words];
}

/** Quotes a word for a shell, where "?" and "&" are special. */
function quoteForShell(/** @type {string} */ word) {
  return /^[\w:.,=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
