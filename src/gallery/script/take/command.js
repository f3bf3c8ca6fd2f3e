// The command lines that make again what is taken away.

/**
 * The command that takes away so many curves, which the words name (shortenedNames); the manifest is in the
 * folder.
 */
export function commandOfCurves(words, count) {
  const formats = ["svg", "moving-svg", "png", "dxf", "csv", "json", "toml"];
  const chosen = count > 20 ? ["svg", "dxf", "csv", "json", "toml"] : formats;
  const named = words.map(quotedForShell).join(" ");
  return `coupler-atlas export atlas.toml ${named} --format ${chosen.join(",")} -o curves\n`;
}

/**
 * Names of curves in as few words as name the same: all curves of a family by its id, all of a cell by its
 * number. `families` has the families by their ids.
 */
export function shortenedNames(names, families) {
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
function quotedForShell(word) {
  return /^[\w:.,=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
