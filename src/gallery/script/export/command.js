// Command lines that export the same curves with the program.

import { curveCountOf, findCurve } from "../data/family.js";

/**
 * The command that exports `count` curves, selected by `words` (shortenCurveNames), from a manifest in the
 * atlas's folder.
 */
export function exportCommand(words, count, manifest = "atlas.toml") {
  const formats = ["svg", "moving-svg", "png", "dxf", "csv", "json", "toml"];
  const chosen = count > 20 ? ["svg", "dxf", "csv", "json", "toml"] : formats;
  const named = words.map(quoteForShell).join(" ");
  return `coupler-atlas export ${manifest} ${named} --format ${chosen.join(",")} -o curves\n`;
}

/**
 * Instructions and the command for curves on circuits that the atlas does not contain. `names` are the
 * curves' names; `words` are their names in the manifest fragment (curveNamesInManifest), null where a
 * manifest cannot describe the curve.
 */
export function extraCircuitsCommand(names, words) {
  const undescribed = names.filter((_, k) => words[k] === null);
  const said = words.filter((word) => word !== null);
  const lines = [
    `# The atlas does not contain the circuit of ${names.join(", ")}.`,
    ...undescribed.map((name) => `# A manifest cannot describe the moved point of ${name}.`),
  ];
  if (said.length === 0) return `${lines.join("\n")}\n`;
  lines.push("# The manifest fragment has all circuits: save it below an [atlas] table as circuits.toml.");
  return `${lines.join("\n")}\n${exportCommand(said, said.length, "circuits.toml")}`;
}

/**
 * The shortest list of words that selects the same curves: a family's id for all its curves, a cell's number
 * for all curves of the cell. `families` maps ids to families.
 */
export function shortenCurveNames(names, families) {
  const words = [];
  const plain = new Map();
  for (const name of new Set(names)) {
    if (name.includes("?")) words.push(name);
    else {
      const [id, key] = name.split(":");
      plain.set(id, [...(plain.get(id) ?? []), key]);
    }
  }
  const shortened = [...plain].flatMap(([id, keys]) => {
    const family = families.get(id);
    if (keys.length === family.curves.count) return [id];
    const named = new Map();
    for (const key of keys) {
      const cell = Number(key.split(".")[0]);
      named.set(cell, [...(named.get(cell) ?? []), key]);
    }
    const isWhole = ([key, ...others]) =>
      others.length > 0 &&
      others.length + 1 === curveCountOf(family, family.curves.cell[findCurve(family, key)]);
    return [...named].flatMap(([cell, own]) =>
      isWhole(own) ? [`${id}:${cell}`] : own.map((key) => `${id}:${key}`),
    );
  });
  return [...shortened, ...words];
}

/** Quotes a word for a shell, where "?" and "&" are special. */
function quoteForShell(word) {
  return /^[\w:.,=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
