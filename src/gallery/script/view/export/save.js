// Saves files with the browser's download, and copies text to the clipboard, which browsers may deny to a page opened from disk.

import { h, openDialog } from "../dom.js";

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
