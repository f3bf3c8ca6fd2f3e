// The toolbar of a page: page number and zoom.

import { address } from "../data/address.js";
import { curveKey } from "../data/family.js";
import { buttonOf, h } from "./dom.js";
import { NumberField } from "./number-field.js";
import { printedColorsButton } from "./settings.js";

/**
 * The toolbar: links to the previous and next page, a field for the page number, and zoom buttons. `go(page)`
 * opens a page, `zoom()` returns the Zoom.
 * @param {ListedFamily} listed @param {{ go(page: number): void, zoom(): Zoom }} _
 */
export function pageBar(listed, { go, zoom }) {
  const contents = h("a.button.contents", "All pages");
  const [before, after] = [stepLink("Previous page", "←", "prev"), stepLink("Next page", "→", "next")];
  const number = pageField(listed, "page", go);
  const controls = zoomControls(zoom);
  const steps = h("div.segments", before, after);
  const parts = [contents, steps, number.element, printedColorsButton(), controls.element];
  const element = h("div.toolbar.page-bar", parts);
  const update = (
    /** @type {{ page: number, magnification: number, isFit: boolean }} */ { page, magnification, isFit },
  ) => {
    contents.setAttribute("href", address([listed.id], { page }));
    setStepTarget(before, listed, page - 1);
    setStepTarget(after, listed, page + 1);
    number.field.mark(null);
    number.field.show(page);
    controls.update(magnification, isFit);
  };
  return { element, update };
}

function stepLink(/** @type {string} */ label, /** @type {string} */ sign, /** @type {string} */ rel) {
  return h("a.button", { rel, "aria-label": label, title: label, role: "link" }, sign);
}

/** Points a link at a page, or disables it if there is no such page. @param {Element} link @param {number} page */
function setStepTarget(link, /** @type {ListedFamily} */ { id, pages }, page) {
  const isThere = page >= 1 && page <= pages;
  if (isThere) link.setAttribute("href", address([id, page]));
  else link.removeAttribute("href");
  link.setAttribute("aria-disabled", String(!isThere));
}

function zoomControls(/** @type {() => Zoom} */ zoom) {
  const level = h("span.zoom-level");
  const button = (/** @type {string} */ label, /** @type {string} */ sign, /** @type {number} */ factor) =>
    buttonOf(sign, () => zoom().zoom(factor), { "aria-label": label, title: label });
  const whole = buttonOf("Fit", () => zoom().fit());
  const segments = h("div.segments", button("Zoom out", "−", 1 / 1.5), whole, button("Zoom in", "+", 1.5));
  const update = (/** @type {number} */ magnification, /** @type {boolean} */ isFit) => {
    level.textContent = `${Math.round(magnification * 100)} %`;
    whole.setAttribute("aria-pressed", String(isFit));
  };
  const attributes = { role: "group", "aria-label": "Zoom" };
  return { element: h("div.toolbar.end", attributes, level, segments), update };
}

/** The address of a page's view: its selected curve, and what is enlarged. @param {PageView} _ */
export function pageAddress({ family, page, highlight, zoom }) {
  const { isFit, magnification, middle } = zoom;
  return address([family.id, page], {
    curve: highlight.selected === null ? null : curveKey(family, highlight.selected),
    zoom: isFit ? null : magnification.toFixed(2),
    at: isFit ? null : middle.map((mm) => mm.toFixed(1)).join(","),
  });
}

/** What the address of a page enlarges; null if nothing. @returns {{ near: number, place: Point } | null} */
export function readPageZoom(/** @type {AddressQuery} */ query) {
  const near = query.number("zoom", 1) ?? 0;
  const [x, y, ...more] = (query.get("at") ?? "").split(",").map(Number);
  const isPlace = Number.isFinite(x) && Number.isFinite(y) && !more.length;
  if (query.get("at") && !isPlace) query.ignore("at", "not a place");
  return near > 1 && isPlace ? { near, place: [x, y] } : null;
}

/**
 * A form { element, field } for one of the `pages` of a family; calls `go(page)` with a valid number.
 * @param {string} label @param {(page: number) => void} go
 */
export function pageField(/** @type {ListedFamily} */ { pages }, label, go) {
  let page = NaN;
  const change = (/** @type {number} */ value) => {
    page = value;
    field.mark(null);
  };
  const field = new NumberField({ inputmode: "numeric", "aria-label": "Page" }, { change });
  const submit = (/** @type {Event} */ event) => {
    event.preventDefault();
    if (field.wrong === null && Number.isInteger(page) && page >= 1 && page <= pages) return go(page);
    field.mark(`There is no page ${field.element.value}`);
    return field.element.reportValidity();
  };
  const words = h("span", label);
  const total = h("span", `of ${pages.toLocaleString("en")}`);
  const form = { class: "field row page-field", novalidate: true, onsubmit: submit };
  return { element: h("form", form, words, field.element, total), field };
}
