// Saves files with the browser's download, and copies text to the clipboard, which browsers may deny to a page opened from disk.

import { focusedElement, h } from "../dom.js";

/** Saves { name, type, bytes }. @param {{ name: string, type: string, bytes: Uint8Array<ArrayBuffer> }} _ */
export function saveFile({ name, type, bytes }) {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  // The browser has read the object by then.
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}

/** Copies a text, or shows it selected for manual copying; resolves to whether it was copied. `what` describes the text. */
export async function copyText(/** @type {string} */ what, /** @type {string} */ text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    await showCopyDialog(what, text);
    return false;
  }
}

// Shows a dialog with the text selected, until it is closed.
function showCopyDialog(/** @type {string} */ what, /** @type {string} */ text) {
  const rows = Math.min(text.split("\n").length + 1, 20);
  const area = h("textarea", { readonly: true, rows, cols: 72, "aria-label": what });
  area.value = text;
  const close = h("button", "Close");
  const dialog = h(
    "dialog.export-copy",
    { "aria-label": `Copy ${what}` },
    h("p", "The browser denies clipboard access to pages on disk. Press Ctrl+C or ⌘C to copy the text."),
    area,
    close,
  );
  close.addEventListener("click", () => dialog.close());
  const back = focusedElement();
  document.body.append(dialog);
  dialog.showModal();
  area.focus();
  area.select();
  /** @type {Promise<void>} */ const closed = new Promise((done) => {
    dialog.addEventListener("close", () => {
      dialog.remove();
      back?.focus();
      done();
    });
  });
  return closed;
}
