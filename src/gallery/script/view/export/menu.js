// The export menu.

import { buttonOf, fill, h, isShortcut } from "../dom.js";
import { exportCommandLine, exportFile, exportManifest, EXPORT_FORMATS } from "./files.js";
import { copyText, saveFile } from "./files.js";
import { plateFile } from "./plate-file.js";

// The time in milliseconds after which an export can be cancelled.
const LONG = 1000;

/**
 * A button with a menu of all export formats. `names` are "family:cell.trace.circuit", with changed
 * parameters after "?", as an array or as a function called at the time of the export; `shown` is the curve of a plate.
 * @param {App} app @param {string[] | (() => string[])} names @param {CurveOfFamily | null} [shown]
 */
export function exportMenu(app, names, shown = null) {
  const currentNames = () => (typeof names === "function" ? names() : names);
  const status = h("span.export-status", { "aria-live": "polite" });
  const report = (/** @type {string} */ sentence) => fill(status, sentence);
  const task = (/** @type {(names: string[], signal: AbortSignal) => Promise<string>} */ work) => () => {
    report("Exporting");
    const ending = new AbortController();
    const cancel = buttonOf("Cancel", () => ending.abort(new Error("Cancelled")), { class: "quiet" });
    const isLong = window.setTimeout(() => element.append(cancel), LONG);
    return work(currentNames(), ending.signal)
      .then(report, (error) => report(error.message))
      .finally(() => {
        window.clearTimeout(isLong);
        cancel.remove();
      });
  };
  /** @param {string} what @param {(app: App, names: string[]) => Promise<string>} textOf */
  const copy = (what, textOf) =>
    task(async (list) => ((await copyText(what, await textOf(app, list))) ? `Copied ${what}` : ""));
  const said = (/** @type {number} */ done, /** @type {number} */ all) => report(`${done} of ${all}`);
  const save = (/** @type {ExportFormat} */ format) =>
    task(async (list, signal) => savedFile(await exportFile(app, list, format, said, signal)));
  /** @type {MenuEntry[]} */ const formats = EXPORT_FORMATS.map((one) => [one.label, one.note, save(one)]);
  const savePlate = task(async ([name]) => (shown ? savedFile(await plateFile(app, name, shown)) : ""));
  /** @type {MenuEntry[]} */ const page = shown ? [["HTML", "this plate in one file", savePlate]] : [];
  /** @type {MenuEntry[]} */ const others = [
    ["Manifest fragment", ".toml", task(async (list) => savedManifest(await exportManifest(app, list)))],
    ["Copy manifest fragment", "", copy("the manifest fragment", exportManifest)],
  ];
  // The file of a plate is not in the folder of its manifest.
  /** @type {MenuEntry[]} */ const command = [
    ["Copy command line", "", copy("the command line", exportCommandLine)],
  ];
  const last = app.atlas.plate ? [] : command;
  const element = h("div.export", menuButton("Export", [...formats, ...page, ...others, ...last]), status);
  return element;
}

function savedManifest(/** @type {string} */ bytes) {
  return savedFile({ name: "curves.toml", type: "application/toml", bytes });
}

/** Saves a file; what it says then. @param {Parameters<typeof saveFile>[0]} file */
function savedFile(file) {
  saveFile(file);
  return `Saved as ${file.name}`;
}

/**
 * A button that opens a menu of entries [[label, note, action], …]. Arrow keys, Home and End move between
 * entries, a letter moves to the next entry that starts with it; Escape or a click elsewhere closes the menu.
 * @param {string} label @param {MenuEntry[]} entries
 */
function menuButton(label, entries) {
  const state = { "aria-haspopup": "menu", "aria-expanded": "false", tabindex: "0" };
  const button = h("button.export-button", state, label);
  const items = entries.map(([word, note, action]) => {
    const act = () => {
      close(true);
      action();
    };
    const words = [h("span", word), note ? h("span.note", note) : null];
    return buttonOf(words, act, { role: "menuitem", tabindex: "-1" });
  });
  const menu = h("div.export-menu", { role: "menu", "aria-label": label, hidden: true }, items);
  const element = h("div.export-dropdown", button, menu);
  const open = (/** @type {HTMLElement} */ item) => {
    menu.hidden = false;
    button.setAttribute("aria-expanded", "true");
    keepInWindow(menu, element);
    item.focus();
  };
  const close = (/** @type {boolean} */ returns) => {
    menu.hidden = true;
    button.setAttribute("aria-expanded", "false");
    if (returns) button.focus();
  };
  button.addEventListener("click", () => (menu.hidden ? open(items[0]) : close(true)));
  button.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    event.preventDefault();
    event.stopPropagation();
    open(event.key === "ArrowDown" ? items[0] : items[items.length - 1]);
  });
  menu.addEventListener("keydown", (event) => handleMenuKey(event, items, close));
  // A click elsewhere takes the focus.
  element.addEventListener("focusout", ({ relatedTarget }) => {
    if (!menu.hidden && !element.contains(/** @type {Node | null} */ (relatedTarget))) close(false);
  });
  return element;
}

/** @param {KeyboardEvent} event @param {HTMLElement[]} items @param {(returns: boolean) => void} close */
function handleMenuKey(event, items, close) {
  const at = items.findIndex((item) => item === document.activeElement);
  const count = items.length;
  const letter = event.key.length === 1 && !isShortcut(event) ? event.key.toLowerCase() : null;
  const begins = (/** @type {HTMLElement} */ item) =>
    item.textContent.toLowerCase().startsWith(letter ?? " ");
  const next = { ArrowDown: (at + 1) % count, ArrowUp: (at + count - 1) % count, Home: 0, End: count - 1 }[
    event.key
  ];
  // Keys of the view do not apply while a menu is open.
  if (event.key !== "Tab") event.stopPropagation();
  if (event.key === "Escape") close(true);
  else if (next !== undefined) items[next].focus();
  else if (letter && letter !== " ") [...items.slice(at + 1), ...items].find(begins)?.focus();
  else return;
  event.preventDefault();
}

// Flips a menu that would overflow the window.
function keepInWindow(/** @type {HTMLElement} */ menu, /** @type {HTMLElement} */ around) {
  menu.classList.remove("over", "left");
  const { left, bottom, height } = menu.getBoundingClientRect();
  const above = around.getBoundingClientRect().top;
  menu.classList.toggle("over", bottom > window.innerHeight && above > height);
  menu.classList.toggle("left", left < 0);
}
