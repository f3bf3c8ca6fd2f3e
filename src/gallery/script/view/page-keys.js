// The keyboard commands of a page.

import { h } from "./dom.js";
import { directionOfKey, focusOne, onKeys } from "./keys.js";

/** Handles the keys on a page, and on its curves. @param {PageView} view */
export function watchPageKeys(view) {
  onKeys(view.sheet, "On a curve of the page", curveCommands(view));
  onKeys(view.viewport, "On the page", pageCommands(view));
}

/** @param {PageView} view @returns {KeyCommand[]} */
function pageCommands(view) {
  const pan = (/** @type {KeyboardEvent} */ event) => {
    const [right, up] = directionOfKey(event) ?? [0, 0];
    const { clientWidth, clientHeight } = view.viewport;
    // When the whole page is visible, the arrow keys scroll the window.
    return !view.zoom.isFit && view.zoom.pan((-right * clientWidth) / 8, (up * clientHeight) / 8);
  };
  return [
    ["+ =", "zoom in", () => view.zoom.zoom(1.5)],
    ["- −", "zoom out", () => view.zoom.zoom(1 / 1.5)],
    ["0", "fit the page", () => view.zoom.fit()],
    ["ArrowLeft ArrowRight ArrowUp ArrowDown", "pan", pan],
    ["n PageDown", "next page", () => view.go(view.page + 1)],
    ["p PageUp", "previous page", () => view.go(view.page - 1)],
    ["Home", "first page", () => view.go(1)],
    ["End", "last page", () => view.go(view.listed.pages)],
    ["Escape", "deselect the curve", () => view.deselect()],
  ];
}

/** @param {PageView} view @returns {KeyCommand[]} */
function curveCommands(view) {
  /** @type {Record<string, number>} */
  const along = { ArrowRight: 5, ArrowLeft: -5, ArrowUp: 30, ArrowDown: -30 };
  const step = (/** @type {number} */ by) => (/** @type {KeyboardEvent} */ event) => {
    if (event.shiftKey) return view.highlight.stepAlong(along[event.key]);
    return to((at) => at + by)(event);
  };
  const to =
    (/** @type {(at: number, count: number) => number} */ next) => (/** @type {KeyboardEvent} */ event) => {
      const links = [...(view.overlay?.links.values() ?? [])];
      const at = links.findIndex((link) => event.target instanceof Node && link.contains(event.target));
      if (at < 0) return false;
      return focusOne(links, next(at, links.length));
    };
  return [
    ["ArrowRight ArrowDown", "next curve; with Shift along the curve", step(1)],
    ["ArrowLeft ArrowUp", "previous curve; with Shift along the curve", step(-1)],
    ["Home", "first curve", to(() => 0)],
    ["End", "last curve", to((_, count) => count - 1)],
    ["Enter", "open its plate"],
    ["Escape", "show all curves", () => view.showAll()],
  ];
}

/** The help for wheel, keyboard and touch, as the element "page-keys". */
export function keyHelp() {
  const keys = "Wheel or pinch: zoom. Tab: select a curve. ?: list the keys.";
  const touch = "Pinch to zoom. Tap a curve to highlight it, and again to open its plate.";
  const words = [h("span.by-keys", keys), h("span.by-touch", touch)];
  return h("p.note.no-print.page-keys", { id: "page-keys" }, words);
}
