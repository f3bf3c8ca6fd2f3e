// Exports curves by name to files, which the browser saves, and texts to the clipboard, which it may deny to a page opened from disk.

import { newLinkage, parseCurveName } from "../../data/address.js";
import { findCurve } from "../../data/family.js";
import { needCurveWithKey } from "../../data/needs.js";
import { exportCommand, shortenCurveNames } from "../../export/command.js";
import { zipOfFiles } from "../../export/zip.js";
import { h, nextTurn, openDialog } from "../dom.js";
import { gifOfSvg, pngOfSvg } from "./pictures.js";

/** The export formats. @type {ExportFormat[]} */
export const EXPORT_FORMATS = [
  { label: "SVG", note: "static", type: "image/svg+xml", kernel: "svg" },
  { label: "Animated SVG", note: ".svg", type: "image/svg+xml", kernel: "moving-svg" },
  { label: "GIF", note: "animated", type: "image/gif", kernel: "moving-svg", convert: gifOfSvg },
  { label: "PNG", note: "300 dpi", type: "image/png", kernel: "svg", convert: pngOfSvg },
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
 * `onProgress` with a number of all that is finished, curves or the frames of one, until the signal ends it.
 * @param {App} app @param {string[]} names @param {ExportFormat} format @param {ExportProgress} onProgress @param {AbortSignal} [signal]
 */
export async function exportFile(app, names, format, onProgress = () => {}, signal = undefined) {
  if (names.length === 0) throw new Error("There is no curve to export");
  if (names.length > MAX_EXPORTED) {
    const limit = `Cannot export more than ${MAX_EXPORTED} curves here`;
    throw new Error(`${limit}; use the command line for all ${names.length}`);
  }
  const kernel = await app.kernel.load();
  const files = [];
  let yieldedAt = performance.now();
  const said = (/** @type {number} */ done, /** @type {number} */ all) => {
    signal?.throwIfAborted();
    onProgress(done, all);
  };
  const saidOfOne = names.length === 1 ? said : () => signal?.throwIfAborted();
  for (const name of names) {
    files.push(await fileOfCurve(kernel, await curveOfName(app, kernel, name), name, format, saidOfOne));
    if (performance.now() - yieldedAt > EXPORT_SLICE) {
      said(files.length, names.length);
      await nextTurn();
      yieldedAt = performance.now();
    }
  }
  return files.length === 1
    ? files[0]
    : { name: "curves.zip", type: "application/zip", bytes: zipOfFiles(files) };
}

/** @param {Kernel} kernel @param {KernelCurve} curve @param {string} name @param {ExportFormat} _ @param {ExportProgress} onProgress */
async function fileOfCurve(kernel, curve, name, { kernel: format, type, convert }, onProgress) {
  let file;
  try {
    file = kernel.export(curve, format);
  } catch (error) {
    throw new Error(`${name}: ${error.message}`, { cause: error });
  }
  const bytes = convert ? await convert(file.text, kernel, onProgress) : new TextEncoder().encode(file.text);
  return { name: convert ? file.name.replace(/[^.]+$/, type.replace("image/", "")) : file.name, type, bytes };
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

/** Saves a file, whose bytes may be those of a text. @param {{ name: string, type: string, bytes: Uint8Array<ArrayBuffer> | string }} _ */
export function saveFile({ name, type, bytes }) {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  h("a", { href: url, download: name }).click();
  // The browser has read the object by then.
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}

/** Copies a text, or shows it selected for manual copying; resolves to whether it was copied. `what` describes the text. */
export async function copyText(/** @type {string} */ what, /** @type {string} */ text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    showCopyDialog(what, text);
    return false;
  }
}

// Shows a dialog with the text selected.
function showCopyDialog(/** @type {string} */ what, /** @type {string} */ text) {
  const rows = Math.min(text.split("\n").length + 1, 20);
  const area = h("textarea", { readonly: true, rows, cols: 72, "aria-label": what });
  area.value = text;
  const words = "The browser denies clipboard access to pages on disk. Press Ctrl+C or ⌘C to copy the text.";
  openDialog("export-copy", { "aria-label": `Copy ${what}` }, h("p", words), area);
  area.focus();
  area.select();
}
