// The toolbar of a page: page number and zoom.

import { address } from "../data/address.js";
import { h } from "./dom.js";
import { pageField } from "./page-field.js";
import { printedColorsButton } from "./settings.js";

/**
 * The toolbar { element, update({ page, magnification, isFit }) }: links to the previous and next page, a
 * field for the page number, and zoom buttons. `listed` is the family's entry in the atlas, `go(page)` opens
 * a page, `zoom()` returns the Zoom.
 */
export function pageBar(listed, { go, zoom }) {
  const contents = h("a", { class: "button contents" }, "All pages");
  const [before, after] = [stepLink("Previous page", "←", "prev"), stepLink("Next page", "→", "next")];
  const number = pageField(listed, "page", go);
  const controls = zoomControls(zoom);
  const steps = h("div", { class: "segments" }, before, after);
  const parts = [contents, steps, number.element, printedColorsButton(), controls.element];
  const element = h("div", { class: "toolbar page-bar" }, parts);
  const update = ({ page, magnification, isFit }) => {
    contents.setAttribute("href", address([listed.id], { page }));
    setStepTarget(before, listed, page - 1);
    setStepTarget(after, listed, page + 1);
    if (document.activeElement !== number.field) {
      number.field.value = page;
      number.field.removeAttribute("aria-invalid");
    }
    controls.update(magnification, isFit);
  };
  return { element, update };
}

function stepLink(label, sign, rel) {
  return h("a", { class: "button", rel, "aria-label": label, title: label, role: "link" }, sign);
}

/** Points a link at a page, or disables it if there is no such page. */
function setStepTarget(link, { id, pages }, page) {
  const isThere = page >= 1 && page <= pages;
  if (isThere) link.setAttribute("href", address([id, page]));
  else link.removeAttribute("href");
  link.setAttribute("aria-disabled", String(!isThere));
}

function zoomControls(zoom) {
  const level = h("span", { class: "zoom-level" });
  const button = (label, sign, factor) =>
    h(
      "button",
      { type: "button", "aria-label": label, title: label, onclick: () => zoom().zoomBy(factor) },
      sign,
    );
  const whole = h("button", { type: "button", onclick: () => zoom().fit() }, "Fit");
  const segments = h(
    "div",
    { class: "segments" },
    button("Zoom out", "−", 1 / 1.5),
    whole,
    button("Zoom in", "+", 1.5),
  );
  const update = (magnification, isFit) => {
    level.textContent = `${Math.round(magnification * 100)} %`;
    whole.setAttribute("aria-pressed", String(isFit));
  };
  return {
    element: h("div", { class: "toolbar end", role: "group", "aria-label": "Zoom" }, level, segments),
    update,
  };
}
