// A plate as one file: this page itself, with one curve and the kernel in it, which opens anywhere.

import { curveKey } from "../../data/family.js";
import { elementIn } from "../dom.js";
import { EXPORT_FORMATS, exportFile } from "./files.js";

/** The plate of a curve, as the address of the page has it, as a file { name, type, bytes }. @param {App} app @param {string} name @param {CurveOfFamily} _ */
export async function plateFile(app, name, { family, curve }) {
  const points = EXPORT_FORMATS.filter(({ kernel }) => kernel === "csv");
  const { name: file } = await exportFile(app, [name], points[0]);
  const key = curveKey(family, curve);
  const { id, title, manifest, ranges, free } = family;
  const { curve: request } = (await app.kernel.load()).curve(family, curve);
  const address = window.location.hash;
  /** @type {PlateOfFile} */ const plate = { address, key, id, title, manifest, ranges, free, request };
  const atlas = JSON.parse(elementIn(document, "#atlas").textContent);
  const kernel = await app.atlas.kernelFile();
  const text = pageText(`${family.title}, ${key}`, { ...atlas, families: [], book: [], kernel, plate });
  return { name: file.replace(/csv$/, "html"), type: "text/html", bytes: text };
}

/** The text of this page with another summary of an atlas. @param {string} title @param {AtlasSummary} summary */
function pageText(title, summary) {
  const page = document.implementation.createHTMLDocument(`${title} · ${summary.title}`);
  page.documentElement.lang = document.documentElement.lang;
  const noScript = page.createElement("noscript");
  noScript.textContent = "The plate needs JavaScript.";
  const root = page.createElement("div");
  root.id = "gallery";
  const [metas, scripts] = ["head > meta", "body > script"].map((selector) =>
    Array.from(document.querySelectorAll(selector), (element) => page.importNode(element, true)),
  );
  page.head.prepend(...metas);
  page.body.append(noScript, root, ...scripts);
  // There are no scripts and pictures beside it.
  const policy = elementIn(page, "meta[http-equiv]");
  policy.setAttribute("content", policy.getAttribute("content")?.replaceAll("'self' ", "") ?? "");
  // Escaped, so that the data cannot end its script element.
  elementIn(page, "#atlas").textContent = JSON.stringify(summary).replaceAll("<", "\\u003c");
  return `<!DOCTYPE html>\n${page.documentElement.outerHTML}\n`;
}
