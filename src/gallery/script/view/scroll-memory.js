// Restores the scroll position and the focus when a view is visited again through the history.

import { elementIn, focusedElement } from "./dom.js";

/**
 * The scroll memory of a window: `leave()` records the position of the current history entry, `arrive()`
 * restores that of the new one, or scrolls to the top, unless the view has its own target (`data-goal`).
 */
export function scrollMemory() {
  /** @type {Map<number, { depth: number, link?: string | null }>} */ const left = new Map();
  /** @type {number | null} */ let present = null;
  let newest = 0;
  let settle = () => {};
  window.history.scrollRestoration = "manual";
  const entry = () => {
    const known = window.history.state?.entry;
    if (known !== undefined) return known;
    newest = Math.max(newest + 1, Date.now());
    window.history.replaceState({ entry: newest }, "");
    return newest;
  };
  return {
    leave: () => {
      settle();
      const link = focusedElement()?.closest("main a")?.getAttribute("href");
      if (present !== null) left.set(present, { depth: window.scrollY, link });
      present = entry();
    },
    arrive: () => {
      const known = present !== null && left.get(present);
      if (known) settle = restoreScroll(known);
      else if (!document.querySelector("main [data-goal]")) window.scrollTo(0, 0);
    },
  };
}

/** Scrolls to a recorded position as soon as the view is long enough; input by the user cancels it. Returns a function that ends it. */
function restoreScroll(/** @type {{ depth: number, link?: string | null }} */ { depth, link }) {
  const moves = ["wheel", "pointerdown", "keydown"];
  const growth = new ResizeObserver(() => goThere());
  const end = () => {
    growth.disconnect();
    moves.forEach((name) => window.removeEventListener(name, end));
  };
  const goThere = () => {
    window.scrollTo(0, depth);
    if (window.scrollY < depth - 1) return;
    end();
    restoreFocus(link);
  };
  moves.forEach((name) => window.addEventListener(name, end));
  growth.observe(elementIn(document, "main"));
  goThere();
  return end;
}

/** Restores the focus to a link when scrolling has created it. */
function restoreFocus(/** @type {string | null | undefined} */ href) {
  if (!href) return;
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      /** @type {NodeListOf<HTMLAnchorElement>} */ const links = document.querySelectorAll("main a");
      const link = [...links].find((one) => one.getAttribute("href") === href && one.tabIndex >= 0);
      link?.focus({ preventScroll: true });
    }),
  );
}
