// A field for shapes that come from elsewhere.

import { parseShape } from "../../shape/parse.js";
import { fill, h } from "../dom.js";

/**
 * The field; `use({ points, closed, said })` is called with what was read, and what cannot be read is told.
 */
export function pasteField(use) {
  const text = h("textarea", {
    id: "shape-text",
    rows: 4,
    spellcheck: "false",
    placeholder: "x,y lines, JSON, points.csv, a drawing in SVG, or its path: M0 0 C…",
  });
  const wrong = h("p", { class: "trouble", role: "alert" });
  const read = () => {
    try {
      use(parseShape(text.value));
      fill(wrong);
    } catch (error) {
      fill(wrong, error.message);
    }
  };
  return h(
    "div",
    { class: "field" },
    h("label", { for: "shape-text" }, "Or paste points or a path"),
    text,
    wrong,
    h("div", {}, h("button", { type: "button", onclick: read }, "Use what is pasted")),
  );
}
