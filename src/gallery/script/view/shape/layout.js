// The layout of the view By shape: the target on the left, results on the right.

import { buttonOf, h } from "../dom.js";
import { fourBarChips, shapeOptions } from "./options.js";
import { PathField } from "./path-field.js";

/** The element of a view with its parts. @param {ShapeView} view */
export function shapeLayout(view) {
  const { target, store, status, loadAll, families } = view;
  const clear = () => {
    view.clear();
    target.element.focus();
  };
  const field = new PathField(view.app, (outline, name) => view.setShape(outline, name));
  const heading = h("div", h("h1", "By shape"), status, loadAll.element);
  const tools = h("div.toolbar", buttonOf("Clear", clear));
  const chips = fourBarChips(store, () => view.shape);
  const panel = h(
    "div.panel",
    target.element,
    view.fourBars.live,
    view.fourBars.reasons,
    tools,
    chips,
    shapeOptions(store),
    field.element,
    target.help,
    families,
  );
  const results = h("div.shape-results", view.results, view.fourBars.element);
  const element = h("div.view.wide.shape-view", h("div.head", heading), h("div.shape-split", panel, results));
  field.listen(element);
  return element;
}
