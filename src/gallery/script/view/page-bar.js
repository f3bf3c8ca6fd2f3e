// The controls of a page: which page, and how near.

import { address } from "../data/address.js";
import { h } from "./dom.js";

/**
 * { element, tell({ page, nearness, isFit }) }: ways to the page before and after, a field for the number of
 * a page, and buttons for nearer, further, and the whole page. `go(page)` opens a page, `zoom()` is the Zoom.
 */
export function pageBar(shown, { go, zoom }) {
  const steps = { before: pageStep("Previous page", "←", "prev"), after: pageStep("Next page", "→", "next") };
  const field = h("input", {
    type: "number",
    min: 1,
    max: shown.pages,
    step: 1,
    id: "page-number",
    "aria-label": "Page",
  });
  const asked = (event) => {
    event.preventDefault();
    const page = Math.round(Number(field.value));
    if (page >= 1 && page <= shown.pages) go(page);
    else field.setAttribute("aria-invalid", "true");
  };
  const near = h("span", { class: "near-by" });
  const button = (label, sign, act) =>
    h("button", { type: "button", "aria-label": label, title: label, onclick: act }, sign);
  const whole = h("button", { type: "button", onclick: () => zoom().fit() }, "Fit");
  const element = h(
    "div",
    { class: "toolbar page-bar" },
    h("a", { class: "button contents", href: "#" }, "All pages"),
    h("div", { class: "segments" }, steps.before, steps.after),
    h(
      "form",
      { class: "field row", novalidate: true, onsubmit: asked },
      h("span", {}, "page"),
      field,
      h("span", {}, `of ${shown.pages.toLocaleString("en")}`),
    ),
    h(
      "div",
      { class: "toolbar end", role: "group", "aria-label": "Zoom" },
      near,
      h(
        "div",
        { class: "segments" },
        button("Further", "−", () => zoom().by(1 / 1.5)),
        whole,
        button("Nearer", "+", () => zoom().by(1.5)),
      ),
    ),
  );
  const point = (link, page) => {
    const isThere = page >= 1 && page <= shown.pages;
    if (isThere) link.setAttribute("href", address([shown.id, page]));
    else link.removeAttribute("href");
    link.setAttribute("aria-disabled", String(!isThere));
  };
  const tell = ({ page, nearness, isFit }) => {
    point(steps.before, page - 1);
    point(steps.after, page + 1);
    element.querySelector(".contents").setAttribute("href", address([shown.id], { page }));
    if (document.activeElement !== field) {
      field.value = page;
      field.removeAttribute("aria-invalid");
    }
    near.textContent = `${Math.round(nearness * 100)} %`;
    whole.setAttribute("aria-pressed", String(isFit));
  };
  return { element, tell };
}

function pageStep(label, sign, rel) {
  return h("a", { class: "button", rel, "aria-label": label, title: label, role: "link" }, sign);
}
