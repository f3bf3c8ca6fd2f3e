// A piece of a manifest that has the cells of curves once more: a family for each linkage and the way it is
// sampled.

import { shortestDigits } from "./digits.js";

/** The linkages that the program knows by itself. */
export const CATALOGUE = [
  "chebyshev",
  "cognates",
  "evans",
  "four-bar",
  "geared-five-bar",
  "hart-inversor",
  "hoeken",
  "hrones-nelson",
  "inverted-slider-crank",
  "jansen",
  "klann",
  "linear-actuator",
  "pantograph",
  "peaucellier-lipkin",
  "roberts",
  "scotch-yoke",
  "slider-crank",
  "stephenson-six-bar",
  "watt",
  "watt-six-bar",
];

/**
 * The families of some curves { family, values, name, beside, changes }, in their order, as TOML; to be put
 * into a manifest that has an [atlas], and the linkages of the atlas's own that they name. A cell that
 * several curves are exported of stands once. Of a circuit beside the atlas all circuits are exported.
 */
export function manifestOfCurves(curves) {
  const tables = familiesOfCurves(curves).map(familyInManifest);
  return `# Put this into a manifest with an [atlas].\n${tables.join("")}`;
}

/**
 * The names that curves on circuits beside the atlas have in their manifest, "evans-taken:1.1.2"; null of one
 * whose traced point was moved, for no parameter says that.
 */
export function curveNamesInManifest(curves) {
  const families = familiesOfCurves(curves);
  return curves.map((curve) => {
    const family = families.find((other) => other.curves.includes(curve));
    const cell = [...rowsOfFamily(family).keys()].indexOf(caseInManifest(curve.family, curve.values)) + 1;
    const isSaid = movedPointComment(curve).length === 0;
    return isSaid ? `${idInManifest(family)}:${cell}.${curve.trace}.${curve.beside}` : null;
  });
}

// A family for each linkage, title and way of sampling, { settings, title, linkage, number, curves }.
function familiesOfCurves(curves) {
  const families = [];
  for (const curve of curves) {
    const settings = settingsInManifest(curve.family, curve.extraCircuit !== null);
    const title = curve.family.title;
    const same = families.find(
      (other) =>
        other.settings === settings && other.title === title && other.linkage === curve.family.linkage,
    );
    if (same) same.curves.push(curve);
    else families.push({ settings, title, linkage: curve.family.linkage, curves: [curve] });
  }
  const earlier = (k) => families.slice(0, k).filter(({ linkage }) => linkage === families[k].linkage).length;
  return families.map((family, k) => ({ ...family, number: earlier(k) + 1 }));
}

// The cells of a family in their order, with the names of the curves that each is there for.
function rowsOfFamily({ curves }) {
  const rows = new Map();
  for (const { family, values, name } of curves) {
    const row = caseInManifest(family, values);
    rows.set(row, [...(rows.get(row) ?? []), name]);
  }
  return rows;
}

function idInManifest({ linkage, number }) {
  return `${linkage.slice(0, 50).replace(/-+$/, "")}-taken${number > 1 ? `-${number}` : ""}`;
}

function familyInManifest(made) {
  const { settings, title, linkage, curves } = made;
  const rows = rowsOfFamily(made);
  const columns = Math.min(rows.size, 3);
  const panels = [columns, Math.min(Math.ceil(rows.size / columns), 3)];
  const own = CATALOGUE.includes(linkage)
    ? ""
    : `\n# The [[linkage]] \`${linkage}\` is the atlas's own: copy it from its manifest.`;
  const moved = [...curves.flatMap(movedPointComment), ...curves.flatMap(extraCircuitComment)]
    .map((line) => `\n${line}`)
    .join("");
  const lines = [
    `${own}${moved}\n[[family]]`,
    `id = "${idInManifest(made)}"`,
    `linkage = "${linkage}"`,
    `title = ${tomlString(title)}`,
    `panels = [${panels.join(", ")}]`,
  ];
  const cases = [...rows].map(([row, names]) => `    ${row}, # ${names.join(", ")}\n`);
  return `${lines.join("\n")}\n${settings}cases = [\n${cases.join("")}]\n`;
}

// A traced point that was moved on its link, "M.along", is no parameter: that is for a linkage of one's own.
function movedPointComment({ family, name, changes }) {
  const moved = [...(changes ?? [])].filter(([word]) => !family.names.includes(word));
  if (moved.length === 0) return [];
  const words = moved.map(([word, value]) => `${word} = ${shortestDigits(value)}`);
  return [`# Of ${name}, ${words.join(" and ")} is for a [[linkage]] of your own: no parameter says it.`];
}

// A circuit that the atlas does not have is one of all.
function extraCircuitComment({ name, extraCircuit }) {
  return extraCircuit === null ? [] : [`# ${name} is circuit ${extraCircuit} of all: of each cell the others come too.`];
}

function caseInManifest(family, values) {
  const pairs = family.template.parameters.map(({ name }, k) => `${name} = ${shortestDigits(values[k])}`);
  return pairs.length > 0 ? `{ ${pairs.join(", ")} }` : "{}";
}

// What a family says beside its cells: by it families of one linkage are told apart.
function settingsInManifest({ linkage, template, sampling, straight, columns }, hasAll) {
  const isLength = template.joints.some((joint) => "piston" in joint);
  const input = (value) => (isLength ? shortestDigits(value) : `"${shortestDigits(value)} deg"`);
  const { step, samples, spacing } = sampling;
  const spaced = spacing && spacing !== "even" ? `, spacing = "${spacing}"` : "";
  const lines = [
    `sampling = { ${step !== undefined ? `step = ${input(step)}` : `samples = ${samples}${spaced}`} }`,
    `circuits = "${hasAll ? "all" : template.circuits}"`,
    `continuation = "${template.continuation}"`,
  ];
  if (template.coincident !== "together" || !CATALOGUE.includes(linkage))
    lines.push(`coincident = "${template.coincident}"`);
  const { mirror, cos, sin } = template.placement;
  if (mirror || cos !== 1 || sin !== 0) lines.push(`place = ${placementInManifest(mirror, cos, sin)}`);
  if (straight && straight.tolerance !== 0.001) {
    const [[key, value]] = Object.entries(straight);
    lines.push(`straight = { ${key} = ${key === "input" ? input(value) : shortestDigits(value)} }`);
  }
  if (columns?.length > 0) lines.push(`columns = [${columns.map((name) => `"${name}"`).join(", ")}]`);
  return lines.map((line) => `${line}\n`).join("");
}

// Mirrored or not, and turned by so many degrees: to nine places, the digits a manifest will have had.
function placementInManifest(mirror, cos, sin) {
  const deg = (Math.atan2(sin, cos) * 180) / Math.PI;
  const rounded = Math.sign(deg) * (Math.round(Math.abs(deg) * 1e9) / 1e9) + 0;
  return `{ mirror = ${mirror}, rotate = "${shortestDigits(rounded)} deg" }`;
}

// A text in TOML.
function tomlString(text) {
  const escaped = text.replace(/["\\]/g, "\\$&").replace(/[\u0000-\u001f\u007f-\u009f]/g, (c) => {
    return `\\u${c.charCodeAt(0).toString(16).toUpperCase().padStart(4, "0")}`;
  });
  return `"${escaped}"`;
}
