// The command lines that make again what is taken away.

/** The command that takes curves of these names away, in the formats named; the manifest is taken to be in the folder. */
export function commandOfCurves(names, formats = ["svg", "dxf", "csv", "json"]) {
  const words = names.map(quotedForShell);
  const output = names.length * formats.length > 1 ? " -o curves" : "";
  return `coupler-atlas export atlas.toml ${words.join(" ")} --format ${formats.join(",")}${output}\n`;
}

/** A word for a shell; "?" and "&" mean something else there. */
function quotedForShell(word) {
  return /^[\w:.,=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
