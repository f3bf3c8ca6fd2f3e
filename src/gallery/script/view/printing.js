// Lists of which only what is in sight is in the page, on paper: there they are whole, or so much of them as
// anyone wants to hold.

import { h } from "./dom.js";

/**
 * Before anything is printed calls `prettyValue()`, which puts into the page what is to be on paper and returns
 * the line that is to stand before it, or null; and `restore()` when it has been printed. Returns { isPrinting,
 * end() }.
 */
export function onPrint(element, layOut, restore) {
  let line = null;
  const state = {
    isPrinting: false,
    end: () => {
      window.removeEventListener("beforeprint", before);
      window.removeEventListener("afterprint", after);
    },
  };
  const before = () => {
    if (!element.isConnected || state.isPrinting) return;
    state.isPrinting = true;
    line = layOut();
    if (line) element.before(line);
  };
  const after = () => {
    if (!state.isPrinting) return;
    state.isPrinting = false;
    line?.remove();
    restore();
  };
  window.addEventListener("beforeprint", before);
  window.addEventListener("afterprint", after);
  return state;
}

/** A line on how many of how many things are on paper, the first of them; null where it is one, or none. */
export function printedCountNote(printed, count, things) {
  if (count < 2) return null;
  const [some, all] = [printed, count].map((number) => number.toLocaleString("en"));
  const which = printed < count ? `the first ${some} of ${all}` : `all ${all}`;
  return h("p", { class: "note on-paper" }, `Printed: ${which} ${things}`);
}
