// A field for shapes from other programs.

import { parseShape } from "../../shape/parse.js";
import { fill, h } from "../dom.js";

/**
 * The field; calls `use({ points, closed, said })` with the parsed shape, and shows a message if it cannot be
 * read.
 */
export function pasteField(use) {
  const text = h("textarea", {
    id: "shape-text",
    rows: 4,
    spellcheck: "false",
    placeholder: "x,y lines, JSON, points.csv, a drawing in SVG, or its path: M0 0 C…",
  });
  const wrong = h("p", { class: "error", role: "alert" });
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
    h("label", { for: "shape-text" }, "Paste points or a path"),
    text,
    wrong,
    h("div", {}, h("button", { type: "button", onclick: read }, "Use pasted shape")),
  );
}
