// The layout of the view By shape.

import { buttonOf, fill, h } from "../dom.js";
import { parseShape } from "../../shape/parse.js";

/** The element of a view with its parts. @param {ShapeView} view */
export function shapeLayout(view) {
  const clear = () => {
    view.pad.clear();
    view.pad.element.focus();
  };
  const use = ({ points, closed, said }) => {
    view.pad.show(points, closed);
    view.setDrawnShape(points, closed);
    view.app.announce(`${said} read`);
  };
  const heading = h("div", h("h1", "By shape"), view.status, view.loadAll.element);
  const tools = h("div.toolbar", buttonOf("Clear", clear));
  const { pad, options, families } = view;
  const panel = h("div.panel", pad.element, pad.help, tools, options.element, pasteField(use), families);
  const results = h("div.shape-results", view.results, view.fourBars.element);
  const split = h("div.shape-split", panel, results);
  return h("div.view.wide.shape-view", h("div.head", heading), split);
}

/** The field; calls `use` with the parsed shape, and shows a message if it cannot be read. */
export function pasteField(use) {
  const text = h("textarea", {
    id: "shape-text",
    rows: 4,
    spellcheck: "false",
    placeholder: "x,y lines, JSON, points.csv, a drawing in SVG, or its path: M0 0 C…",
  });
  const wrong = h("p.error", { role: "alert" });
  const read = () => {
    try {
      use(parseShape(text.value));
      fill(wrong);
    } catch (error) {
      fill(wrong, error.message);
    }
  };
  const label = h("label", { for: "shape-text" }, "Paste points or a path");
  return h("div.field", label, text, wrong, h("div", buttonOf("Use pasted shape", read)));
}
