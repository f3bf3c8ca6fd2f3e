// The message shown when no curve passes the filters.

import { h } from "../dom.js";
import { formatCount } from "../footer.js";
import { columnLabel } from "./column-label.js";

/**
 * A message for filters that no curve passes, and for each filter a button that removes it, with the number
 * of curves that would pass then; calls `without(name)` with the name of its column.
 */
export function noResults(filters, without, isPartial = false) {
  const names = [...filters.fails.keys()];
  const way = (name) => {
    const left = formatCount(filters.countWithout(name), "curve", "curves");
    return h(
      "li",
      {},
      h("button", { type: "button", onclick: () => without(name) }, `Remove ${columnLabel(name)}: ${left}`),
    );
  };
  const none = isPartial ? "None of the loaded curves passes" : "No curve passes";
  const sentence = names.length === 1 ? `${none} this filter.` : `${none} all of these filters.`;
  return h(
    "div",
    { class: "no-results" },
    h("p", {}, sentence),
    h("ul", { class: "toolbar" }, names.map(way)),
  );
}
