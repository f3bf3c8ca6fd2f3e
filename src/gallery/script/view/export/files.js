// Exports curves by name to files.

import { newLinkage, parseCurveName } from "../../data/address.js";
import { findCurve } from "../../data/family.js";
import { needCurveWithKey } from "../../data/needs.js";
import { exportCommand, shortenCurveNames } from "../../export/command.js";
import { zipOfFiles } from "../../export/zip.js";

/** The export formats. @type {ExportFormat[]} */
export const EXPORT_FORMATS = [
  { label: "SVG", note: "static", type: "image/svg+xml", kernel: "svg" },
  { label: "Animated SVG", note: ".svg", type: "image/svg+xml", kernel: "moving-svg" },
  { label: "PNG", note: "300 dpi", type: "image/png", kernel: "svg", ending: ".png", convert: pngOfSvg },
  { label: "DXF", note: "CAD, AutoCAD R12", type: "image/vnd.dxf", kernel: "dxf" },
  { label: "CSV", note: "points", type: "text/csv", kernel: "csv" },
  { label: "JSON", note: "all data", type: "application/json", kernel: "json" },
];

// The time in milliseconds after which an export of many curves yields to the page.
const EXPORT_SLICE = 40;
// The maximum number of curves exported by the page.
const MAX_EXPORTED = 1000;

/**
 * Exports curves by name as one file { name, type, bytes }, an archive if there are several; calls
 * `onProgress` with the number of finished curves.
 * @param {App} app @param {string[]} names @param {ExportFormat} format
 */
export async function exportFile(app, names, format, onProgress = (/** @type {number} */ _) => {}) {
  if (names.length === 0) throw new Error("There is no curve to export");
  if (names.length > MAX_EXPORTED) {
    const limit = `Cannot export more than ${MAX_EXPORTED} curves here`;
    throw new Error(`${limit}; use the command line for all ${names.length}`);
  }
  const kernel = await app.kernel.load();
  const files = [];
  let yieldedAt = performance.now();
  for (const name of names) {
    files.push(await fileOfCurve(kernel, await curveOfName(app, kernel, name), name, format));
    if (performance.now() - yieldedAt > EXPORT_SLICE) {
      onProgress(files.length);
      await new Promise((done) => setTimeout(done));
      yieldedAt = performance.now();
    }
  }
  return files.length === 1
    ? files[0]
    : { name: "curves.zip", type: "application/zip", bytes: zipOfFiles(files) };
}

/** @param {Kernel} kernel @param {KernelCurve} curve @param {string} name @param {ExportFormat} _ */
async function fileOfCurve(kernel, curve, name, { kernel: format, type, ending, convert }) {
  const file = errorsNaming(name, () => kernel.export(curve, format));
  const bytes = convert ? await convert(file.text) : new TextEncoder().encode(file.text);
  return { name: ending ? file.name.replace(/\.[^.]+$/, ending) : file.name, type, bytes };
}

/** Runs `work`; its error says which curve it is of. @template T @param {string} name @param {() => T} work */
function errorsNaming(name, work) {
  try {
    return work();
  } catch (error) {
    throw new Error(`${name}: ${error.message}`, { cause: error });
  }
}

async function parsedName(/** @type {App} */ app, /** @type {string} */ name) {
  const parsed = parseCurveName(name);
  if (!parsed) throw new Error(`“${name}” is not the name of a curve`);
  const family = await app.atlas.family(parsed.family);
  const curve = findCurve(family, parsed.key) ?? (await needCurveWithKey(family, parsed.key));
  return { family, curve, changes: parsed.changes };
}

/** The curve with a name, for the kernel. */
async function curveOfName(/** @type {App} */ app, /** @type {Kernel} */ kernel, /** @type {string} */ name) {
  const { family, curve, changes } = await parsedName(app, name);
  if (curve === undefined) throw new Error(`there is no curve “${name}” in this atlas`);
  return kernel.curve(family, curve, changes);
}

/** The manifest fragment of curves by name. @param {App} app @param {string[]} names */
export async function exportManifest(app, names) {
  const kernel = await app.kernel.load();
  const curves = [];
  for (const name of names) curves.push(await curveOfName(app, kernel, name));
  return kernel.fragment(curves);
}

/** The command line that exports curves by name. @param {App} app @param {string[]} names */
export async function exportCommandLine(app, names) {
  /** @type {Map<string, Family>} */ const families = new Map();
  for (const name of names) {
    const { family } = await parsedName(app, name);
    if (newLinkage(family.id) !== null)
      throw new Error(`${name} is in no manifest: copy it as a manifest fragment`);
    families.set(family.id, family);
  }
  return exportCommand(shortenCurveNames(names, families), names.length);
}

/** The resolution of PNG plates, in pixels per inch. */
const PLATE_DPI = 300;

/** A plate in SVG, whose size is in millimetres, as the bytes of a PNG image. */
export async function pngOfSvg(/** @type {string} */ svg) {
  const [width, height] = ["width", "height"].map((side) =>
    Number(new RegExp(`^<svg[^>]* ${side}="([0-9.]+)mm"`).exec(svg)?.[1]),
  );
  const image = new Image();
  // A data URL does not taint the canvas.
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round((width / 25.4) * PLATE_DPI);
  canvas.height = Math.round((height / 25.4) * PLATE_DPI);
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  /** @type {Blob | null} */ const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  if (!blob) throw new Error("the browser cannot create an image of this size");
  return new Uint8Array(await blob.arrayBuffer());
}
