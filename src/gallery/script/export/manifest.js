// Writes a manifest fragment that contains the cells of curves: one family for each linkage and sampling.

import { shortestDigits } from "./digits.js";

/** The linkages of the built-in catalogue. */
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
 * The families of curves { family, values, name, extraCircuit, changes }, in their order, as TOML. The
 * fragment belongs in a manifest with an [atlas] and the custom linkages that it names. A cell shared by
 * several curves appears once. A curve on a circuit that the atlas does not contain selects all circuits.
 */
export function manifestOfCurves(curves) {
  const tables = familiesOfCurves(curves).map(familyInManifest);
  return `# Put this into a manifest with an [atlas].\n${tables.join("")}`;
}

/**
 * The names in the manifest of curves on circuits that the atlas does not contain, "evans-exported:1.1.2"; null
 * if the traced point was moved, which no parameter describes.
 */
export function curveNamesInManifest(curves) {
  const families = familiesOfCurves(curves);
  return curves.map((curve) => {
    const family = families.find((other) => other.curves.includes(curve));
    const cell = [...rowsOfFamily(family).keys()].indexOf(caseInManifest(curve.family, curve.values)) + 1;
    const isExpressible = movedPointComment(curve).length === 0;
    return isExpressible ? `${idInManifest(family)}:${cell}.${curve.trace}.${curve.extraCircuit}` : null;
  });
}

// One family for each linkage, title and sampling: { settings, title, linkage, number, curves }.
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

// The cells of a family in their order, with the names of their curves.
function rowsOfFamily({ curves }) {
  const rows = new Map();
  for (const { family, values, name } of curves) {
    const row = caseInManifest(family, values);
    rows.set(row, [...(rows.get(row) ?? []), name]);
  }
  return rows;
}

function idInManifest({ linkage, number }) {
  return `${linkage.slice(0, 50).replace(/-+$/, "")}-exported${number > 1 ? `-${number}` : ""}`;
}

function familyInManifest(group) {
  const { settings, title, linkage, curves } = group;
  const rows = rowsOfFamily(group);
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
    `id = "${idInManifest(group)}"`,
    `linkage = "${linkage}"`,
    `title = ${tomlString(title)}`,
    `panels = [${panels.join(", ")}]`,
  ];
  const cases = [...rows].map(([row, names]) => `    ${row}, # ${names.join(", ")}\n`);
  return `${lines.join("\n")}\n${settings}cases = [\n${cases.join("")}]\n`;
}

// A traced point moved on its link, "M.along", is not a parameter: it needs a custom linkage.
function movedPointComment({ family, name, changes }) {
  const moved = [...(changes ?? [])].filter(([word]) => !family.names.includes(word));
  if (moved.length === 0) return [];
  const words = moved.map(([word, value]) => `${word} = ${shortestDigits(value)}`);
  return [`# ${name}: ${words.join(" and ")} needs a [[linkage]] of your own; it is not a parameter.`];
}

// Notes a circuit that the atlas does not contain.
function extraCircuitComment({ name, extraCircuit }) {
  if (extraCircuit === null) return [];
  return [`# ${name} is circuit ${extraCircuit} of all; the other circuits of its cell are included.`];
}

function caseInManifest(family, values) {
  const pairs = family.template.parameters.map(({ name }, k) => `${name} = ${shortestDigits(values[k])}`);
  return pairs.length > 0 ? `{ ${pairs.join(", ")} }` : "{}";
}

// The settings of a family other than its cells; they distinguish families of one linkage.
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

// Mirroring and rotation; the angle is rounded to nine places to recover the digits of the manifest.
function placementInManifest(mirror, cos, sin) {
  const deg = (Math.atan2(sin, cos) * 180) / Math.PI;
  const rounded = Math.sign(deg) * (Math.round(Math.abs(deg) * 1e9) / 1e9) + 0;
  return `{ mirror = ${mirror}, rotate = "${shortestDigits(rounded)} deg" }`;
}

// Quotes a TOML string.
function tomlString(text) {
  const escaped = text.replace(/["\\]/g, "\\$&").replace(/[\u0000-\u001f\u007f-\u009f]/g, (c) => {
    return `\\u${c.charCodeAt(0).toString(16).toUpperCase().padStart(4, "0")}`;
  });
  return `"${escaped}"`;
}
