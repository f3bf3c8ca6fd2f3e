// Lists of which only the visible part is in the document: their height, and how they are printed.

import { h } from "./dom.js";

/** The greatest height of an element, in pixels: Firefox allows 17.9 million, Chromium 33.5 million. */
export const MAX_HEIGHT = 15e6;

/**
 * The pixels of content per pixel scrolled, of a list of a height in a window: 1, unless the list is too
 * high. Its element then has the greatest height, and scrolling moves the content faster.
 */
export function scrollScale(/** @type {number} */ height, /** @type {number} */ windowHeight) {
  return height <= MAX_HEIGHT ? 1 : (height - windowHeight) / (MAX_HEIGHT - windowHeight);
}

/**
 * Calls `printed()` before printing, which puts the printed items of a list into the document and returns a line to precede them, or null,
 * and `fill()` afterwards. Returns { isPrinting, end() }.
 * @param {{ element: Element, printed(): Element | null, fill(): void }} list
 */
export function onPrint(list) {
  /** @type {Element | null} */ let line = null;
  const listening = new AbortController();
  const state = { isPrinting: false, end: () => listening.abort() };
  const before = () => {
    if (!list.element.isConnected || state.isPrinting) return;
    state.isPrinting = true;
    line = list.printed();
    if (line) list.element.before(line);
  };
  const after = () => {
    if (!state.isPrinting) return;
    state.isPrinting = false;
    line?.remove();
    list.fill();
  };
  window.addEventListener("beforeprint", before, { signal: listening.signal });
  window.addEventListener("afterprint", after, { signal: listening.signal });
  return state;
}

/** A line that says how many of how many things are printed; null for one or none. @param {number} printed @param {number} count @param {string} things */
export function printedCountNote(printed, count, things) {
  if (count < 2) return null;
  const [some, all] = [printed, count].map((number) => number.toLocaleString("en"));
  const which = printed < count ? `the first ${some} of ${all}` : `all ${all}`;
  return h("p.note.on-paper", `Printed: ${which} ${things}`);
}
