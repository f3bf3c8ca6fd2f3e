// The controls of a page: which page, and how near.

import { address } from "../data/address.js";
import { h } from "./dom.js";
import { pageField } from "./page-field.js";
import { printedColorsButton } from "./settings.js";

/**
 * { element, update({ page, magnification, isFit }) }: ways to the page before and after, a field for the number of
 * a page, and buttons for nearer, further, and the whole page. `listed` is the family as the atlas lists it,
 * `go(page)` opens a page, `zoom()` is the Zoom.
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

/** Leads a step to a page, or nowhere if there is none. */
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
    button("Further", "−", 1 / 1.5),
    whole,
    button("Nearer", "+", 1.5),
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
