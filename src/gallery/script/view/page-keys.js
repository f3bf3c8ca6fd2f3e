// The keyboard commands of a page.

import { h, isShortcut } from "./dom.js";

/** Handles a key on a page. @param {PageView} view */
export function handlePageKey(event, view) {
  const act = keyAction(event, view);
  if (!act) return;
  event.preventDefault();
  act();
}

/** The action of a key on a page: a function, or null if there is none. @param {PageView} view */
function keyAction(event, view) {
  if (isShortcut(event)) return null;
  return curveKeyAction(event, view) ?? pageKeyAction(event.key, view);
}

function pageKeyAction(key, /** @type {PageView} */ view) {
  const { zoom, page, listed } = view;
  const [dx, dy] = [view.viewport.clientWidth / 8, view.viewport.clientHeight / 8];
  const acts = {
    "+": () => zoom.zoomBy(1.5),
    "=": () => zoom.zoomBy(1.5),
    "-": () => zoom.zoomBy(1 / 1.5),
    "−": () => zoom.zoomBy(1 / 1.5),
    0: () => zoom.fit(),
    n: () => view.go(page + 1),
    PageDown: () => view.go(page + 1),
    p: () => view.go(page - 1),
    PageUp: () => view.go(page - 1),
    Home: () => view.go(1),
    End: () => view.go(listed.pages),
    Escape: () => view.deselect(),
  };
  // When the whole page is visible, the arrow keys scroll the window.
  const ways = { ArrowLeft: [dx, 0], ArrowRight: [-dx, 0], ArrowUp: [0, dy], ArrowDown: [0, -dy] };
  if (key in ways && !zoom.isFit) return () => zoom.pan(...ways[key]);
  return acts[key] ?? null;
}

/** On a curve, arrow keys move to the next curve, and with Shift along the curve. */
function curveKeyAction({ key, shiftKey, target }, /** @type {PageView} */ view) {
  const link = target.closest?.("a[data-curve]");
  if (!link) return null;
  const links = [...(view.overlay?.links.values() ?? [])];
  const at = links.indexOf(link);
  const to = (k) => () => {
    links.forEach((other) => other.setAttribute("tabindex", "-1"));
    const next = links[(k + links.length) % links.length];
    next.setAttribute("tabindex", "0");
    next.focus({ preventScroll: true });
  };
  if (shiftKey) {
    const along = { ArrowRight: 5, ArrowLeft: -5, ArrowUp: 30, ArrowDown: -30 }[key];
    return along ? () => view.highlight.stepAlong(along) : null;
  }
  const acts = { ArrowRight: to(at + 1), ArrowDown: to(at + 1), ArrowLeft: to(at - 1), ArrowUp: to(at - 1) };
  const ends = { Home: to(0), End: to(links.length - 1) };
  const away = () => view.showAll();
  return acts[key] ?? ends[key] ?? (key === "Escape" ? away : null);
}

/** The help for wheel, keyboard and touch, as the element "page-keys". */
export function keyHelp() {
  const keys = h(
    "span.by-keys",
    "Wheel, pinch, + and −: zoom; 0: fit the page; arrow keys: pan; n and p: next and previous page. ",
    "Tab: select a curve; arrow keys: next curve, with Shift along the curve; Enter: open its plate.",
  );
  const touch = "Pinch to zoom. Tap a curve to highlight it, and again to open its plate.";
  return h("p.note.no-print.page-keys", { id: "page-keys" }, keys, h("span.by-touch", touch));
}
