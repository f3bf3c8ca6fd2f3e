// What is said where filters leave nothing.

import { h } from "../dom.js";
import { formatCount } from "../footer.js";
import { columnLabel } from "./column-label.js";

/**
 * A sentence for filters that no curve passes, and for each a button that takes it away, with how many curves
 * that would leave; `without(name)` is called with the name of its column.
 */
export function noResults(filters, without) {
  const names = [...filters.fails.keys()];
  const way = (name) => {
    const left = formatCount(filters.countWithout(name), "curve", "curves");
    return h(
      "li",
      {},
      h(
        "button",
        { type: "button", onclick: () => without(name) },
        `Without ${columnLabel(name)}: ${left}`,
      ),
    );
  };
  const sentence =
    names.length === 1 ? "No curve passes this filter." : "No curve passes all of these filters.";
  return h(
    "div",
    { class: "no-results" },
    h("p", {}, sentence),
    h("ul", { class: "toolbar" }, names.map(way)),
  );
}
