// Exports curves by name to files.

import { findCurve } from "../../data/family.js";
import { needCurveWithKey } from "../../data/needs.js";
import { extraCircuitsCommand, exportCommand, shortenCurveNames } from "../../export/command.js";
import { csvOfCurve } from "../../export/csv.js";
import { dxfOfCurve } from "../../export/dxf.js";
import { jsonOfCurve } from "../../export/json.js";
import { manifestOfCurves, curveNamesInManifest } from "../../export/manifest.js";
import { movingSvgOfCurve } from "../../export/moving-svg.js";
import { pngOfCurve } from "../../export/png.js";
import { svgOfCurve } from "../../export/svg.js";
import { fileStem, manifestCase, parseCurveName, solveNamedCurve } from "../../export/curve.js";
import { zipOfFiles } from "../../export/zip.js";

/**
 * The export formats: { label, note, ending, type, render(app, exported) -> text or bytes, or a promise }.
 */
export const EXPORT_FORMATS = [
  {
    label: "SVG",
    note: "static",
    ending: ".svg",
    type: "image/svg+xml",
    render: (app, exported) => svgOfCurve(exported),
  },
  {
    label: "Animated SVG",
    note: ".svg",
    ending: "-moving.svg",
    type: "image/svg+xml",
    render: (app, exported) => movingSvgOfCurve(exported),
  },
  {
    label: "PNG",
    note: "300 dpi",
    ending: ".png",
    type: "image/png",
    render: (app, exported) => pngOfCurve(exported),
  },
  {
    label: "DXF",
    note: "CAD, AutoCAD R12",
    ending: ".dxf",
    type: "image/vnd.dxf",
    render: (app, exported) => dxfOfCurve(exported, app.atlas.program),
  },
  {
    label: "CSV",
    note: "points",
    ending: ".csv",
    type: "text/csv",
    render: (app, exported) => csvOfCurve(exported),
  },
  {
    label: "JSON",
    note: "all data",
    ending: ".json",
    type: "application/json",
    render: (app, exported) => jsonOfCurve(exported, measureNames(app)),
  },
];

// The time in milliseconds after which an export of many curves yields to the page.
const EXPORT_SLICE = 40;
// The maximum number of curves exported by the page.
const MAX_EXPORTED = 1000;

function measureNames({ atlas }) {
  return atlas.measures.map(({ name }) => name);
}

/**
 * Exports curves by name as one file { name, type, bytes }, an archive if there are several; calls
 * `onProgress` with the number of finished curves.
 */
export async function exportFile(app, names, format, onProgress = () => {}) {
  if (names.length === 0) throw new Error("There is no curve to export");
  if (names.length > MAX_EXPORTED) {
    const limit = `Cannot export more than ${MAX_EXPORTED} curves here`;
    throw new Error(`${limit}; use the command line for all ${names.length}`);
  }
  const files = [];
  let yieldedAt = performance.now();
  for (const name of names) {
    const exported = solveNamedCurve(await loadFamilyOfName(app, name), name);
    const content = await format.render(app, exported);
    const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
    files.push({ name: `${fileStem(exported)}${format.ending}`, type: format.type, bytes });
    if (performance.now() - yieldedAt > EXPORT_SLICE) {
      onProgress(files.length);
      await new Promise((done) => {
        setTimeout(done);
      });
      yieldedAt = performance.now();
    }
  }
  return files.length === 1
    ? files[0]
    : { name: "curves.zip", type: "application/zip", bytes: zipOfFiles(files) };
}

async function loadFamilyOfName(app, name) {
  const parsed = parseCurveName(name);
  if (!parsed) throw new Error(`“${name}” is not the name of a curve`);
  const family = await app.atlas.family(parsed.family);
  if (findCurve(family, parsed.key) === undefined) await needCurveWithKey(family, parsed.key);
  return family;
}

/** The manifest fragment of curves by name. */
export async function exportManifest(app, names) {
  const curves = [];
  for (const name of names) curves.push(manifestCase(await loadFamilyOfName(app, name), name));
  return manifestOfCurves(curves);
}

/** The command line that exports curves by name. */
export async function exportCommandLine(app, names) {
  const families = new Map();
  const extra = [];
  for (const name of names) {
    const family = await loadFamilyOfName(app, name);
    families.set(family.id, family);
    const curve = manifestCase(family, name);
    if (curve.extraCircuit !== null) extra.push({ ...curve, requested: name });
  }
  const plain = names.filter((name) => !extra.some(({ requested }) => requested === name));
  const command = plain.length ? exportCommand(shortenCurveNames(plain, families), plain.length) : "";
  if (extra.length === 0) return command;
  return (
    command +
    extraCircuitsCommand(
      extra.map(({ name }) => name),
      curveNamesInManifest(extra),
    )
  );
}
