// A field for a page number.

import { h } from "./dom.js";

/** A form { element, field } for one of the `pages` of a family; calls `go(page)` with a valid number. */
export function pageField({ pages }, label, go) {
  const field = h("input", { type: "number", min: 1, max: pages, step: 1, "aria-label": "Page" });
  const submit = (event) => {
    event.preventDefault();
    const page = Math.round(Number(field.value));
    if (page >= 1 && page <= pages) go(page);
    else field.setAttribute("aria-invalid", "true");
  };
  const words = h("span", {}, label);
  const total = h("span", {}, `of ${pages.toLocaleString("en")}`);
  const form = { class: "field row page-field", novalidate: true, onsubmit: submit };
  return { element: h("form", form, words, field, total), field };
}
