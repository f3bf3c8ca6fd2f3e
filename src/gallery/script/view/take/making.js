// From names of curves to files.

import { commandBesideAtlas, commandOfCurves, shortenedNames } from "../../take/command.js";
import { csvOfCurve } from "../../take/csv.js";
import { dxfOfCurve } from "../../take/dxf.js";
import { jsonOfCurve } from "../../take/json.js";
import { manifestOfCurves, namesInManifest } from "../../take/manifest.js";
import { movingSvgOfCurve } from "../../take/moving.js";
import { pngOfCurve } from "../../take/png.js";
import { svgOfCurve } from "../../take/svg.js";
import { fileStem, namedCase, parsedName, takenCurve } from "../../take/taken.js";
import { zipOfFiles } from "../../take/zip.js";

/**
 * What curves can be saved as: { label, note, ending, type, made(app, taken) -> text or bytes, perhaps in a
 * while }.
 */
export const TAKEN_FORMATS = [
  {
    label: "SVG",
    note: "still",
    ending: ".svg",
    type: "image/svg+xml",
    made: (app, taken) => svgOfCurve(taken),
  },
  {
    label: "SVG, moving by itself",
    note: ".svg",
    ending: "-moving.svg",
    type: "image/svg+xml",
    made: (app, taken) => movingSvgOfCurve(taken),
  },
  {
    label: "PNG",
    note: "300 to the inch",
    ending: ".png",
    type: "image/png",
    made: (app, taken) => pngOfCurve(taken),
  },
  {
    label: "DXF",
    note: "CAD, AutoCAD R12",
    ending: ".dxf",
    type: "image/vnd.dxf",
    made: (app, taken) => dxfOfCurve(taken, app.atlas.program),
  },
  {
    label: "CSV",
    note: "points",
    ending: ".csv",
    type: "text/csv",
    made: (app, taken) => csvOfCurve(taken),
  },
  {
    label: "JSON",
    note: "all that is known",
    ending: ".json",
    type: "application/json",
    made: (app, taken) => jsonOfCurve(taken, measureNames(app)),
  },
];

// The page is left to itself so often, in milliseconds, while many curves are made.
const TAKEN_PATIENCE = 40;
// More curves than this are the program's work.
const MOST_TAKEN = 1000;

function measureNames({ atlas }) {
  return atlas.measures.map(({ name }) => name);
}

/**
 * Curves of some names as one file { name, type, bytes }, several in an archive; `told` is told how many are
 * done.
 */
export async function filesFor(app, names, format, told = () => {}) {
  if (names.length === 0) throw new Error("There is no curve to take away");
  if (names.length > MOST_TAKEN) {
    throw new Error(`Take ${MOST_TAKEN} curves at most here: the command line takes all ${names.length}`);
  }
  const files = [];
  let rested = performance.now();
  for (const name of names) {
    const taken = takenCurve(await familyOfName(app, name), name);
    const made = await format.made(app, taken);
    const bytes = typeof made === "string" ? new TextEncoder().encode(made) : made;
    files.push({ name: `${fileStem(taken)}${format.ending}`, type: format.type, bytes });
    if (performance.now() - rested > TAKEN_PATIENCE) {
      told(files.length);
      await new Promise((done) => {
        setTimeout(done);
      });
      rested = performance.now();
    }
  }
  return files.length === 1
    ? files[0]
    : { name: "curves.zip", type: "application/zip", bytes: zipOfFiles(files) };
}

function familyOfName(app, name) {
  const parsed = parsedName(name);
  return parsed
    ? app.atlas.family(parsed.family)
    : Promise.reject(new Error(`“${name}” is no name of a curve`));
}

/** The piece of a manifest that has curves of some names once more. */
export async function manifestFor(app, names) {
  const curves = [];
  for (const name of names) curves.push(namedCase(await familyOfName(app, name), name));
  return manifestOfCurves(curves);
}

/** The command line that takes curves of some names away. */
export async function commandFor(app, names) {
  const families = new Map();
  const beside = [];
  for (const name of names) {
    const family = await familyOfName(app, name);
    families.set(family.id, family);
    const curve = namedCase(family, name);
    if (curve.beside !== null) beside.push({ ...curve, asked: name });
  }
  const plain = names.filter((name) => !beside.some(({ asked }) => asked === name));
  const command = plain.length ? commandOfCurves(shortenedNames(plain, families), plain.length) : "";
  if (beside.length === 0) return command;
  return (
    command +
    commandBesideAtlas(
      beside.map(({ name }) => name),
      namesInManifest(beside),
    )
  );
}
