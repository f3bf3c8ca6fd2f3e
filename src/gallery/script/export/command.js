// The command lines that make again what is exported away.

/**
 * The command that takes away so many curves, which the words name (shortenCurveNames); the manifest is in the
 * folder.
 */
export function exportCommand(words, count, manifest = "atlas.toml") {
  const formats = ["svg", "moving-svg", "png", "dxf", "csv", "json", "toml"];
  const chosen = count > 20 ? ["svg", "dxf", "csv", "json", "toml"] : formats;
  const named = words.map(quoteForShell).join(" ");
  return `coupler-atlas export ${manifest} ${named} --format ${chosen.join(",")} -o curves\n`;
}

/**
 * What to do for curves on circuits beside the atlas, with the command; `names` are theirs, `words` those in
 * the manifest fragment (curveNamesInManifest), null of what it cannot say.
 */
export function extraCircuitsCommand(names, words) {
  const unsaid = names.filter((_, k) => words[k] === null);
  const said = words.filter((word) => word !== null);
  const lines = [
    `# The atlas does not have the circuit of ${names.join(", ")}.`,
    ...unsaid.map((name) => `# Nor can a manifest say the moved point of ${name}.`),
  ];
  if (said.length === 0) return `${lines.join("\n")}\n`;
  lines.push("# Its manifest fragment has all circuits: put it under an [atlas] into circuits.toml.");
  return `${lines.join("\n")}\n${exportCommand(said, said.length, "circuits.toml")}`;
}

/**
 * Names of curves in as few words as name the same: all curves of a family by its id, all of a cell by its
 * number. `families` has the families by their ids.
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
    const { cells, curves } = families.get(id);
    if (keys.length === curves.count) return [id];
    const ofCell = new Map();
    for (const cell of curves.cell) ofCell.set(cells.number[cell], (ofCell.get(cells.number[cell]) ?? 0) + 1);
    const named = new Map();
    for (const key of keys) {
      const cell = Number(key.split(".")[0]);
      named.set(cell, [...(named.get(cell) ?? []), key]);
    }
    const isWhole = (cell, own) => own.length > 1 && own.length === ofCell.get(cell);
    return [...named].flatMap(([cell, own]) =>
      isWhole(cell, own) ? [`${id}:${cell}`] : own.map((key) => `${id}:${key}`),
    );
  });
  return [...shortened, ...words];
}

/** A word for a shell; "?" and "&" mean something else there. */
function quoteForShell(word) {
  return /^[\w:.,=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
