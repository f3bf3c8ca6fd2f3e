// The layout of the Find view, and the message shown when no curve passes the filters.

import { buttonOf, h } from "../dom.js";
import { exportMenu } from "../export/menu.js";
import { formatCount } from "../labels.js";

/** The element of a view with its parts, and the buttons that it updates: { element, displayButtons, clear }. */
export function findLayout(/** @type {FindView} */ view) {
  const show = (/** @type {FindQuery["show"]} */ name, /** @type {string} */ label) =>
    buttonOf(label, () => view.store.change({ show: name }), { "data-show": name });
  const displayButtons = [show("sheet", "Grid"), show("table", "Table")];
  const clear = buttonOf("Clear all filters", () => view.setFilters(new Map()), { class: "quiet" });
  const wide = window.matchMedia("(min-width: 60rem)").matches;
  // Results come before the filters, which are many: the links lead to either.
  const skip = (/** @type {string} */ words, /** @type {() => void} */ to) =>
    h("a.skip", { href: "#", onclick: (event) => (event.preventDefault(), to()) }, words);
  const heading = h("div", h("h1", "Find"), view.countLabel, view.loadAll.element, view.message);
  const sorter = h("span.field.row", h("label", { for: "find-sort" }, "Sort by"), view.sorter);
  const display = h("div.segments.end", { role: "group", "aria-label": "Show as" }, displayButtons);
  const take = exportMenu(view.app, () => Array.from(view.rows, (row) => view.table.curveOf(row).name));
  const summary = h("summary", "Filters");
  const panel = h("details.find-panel", { open: wide }, summary, view.families, view.panel.element);
  const tools = h("div.toolbar", sorter, view.direction, clear, display);
  const element = h(
    "div.view.wide.find-view",
    skip("Skip to results", () => view.results.focus()),
    skip("Skip to filters", () => summary.focus()),
    h("div.head", heading, take),
    h("div.find-split", h("div", tools, view.results), panel),
  );
  return { element, displayButtons, clear };
}

/**
 * A message for filters that no curve passes, and for each filter a button that removes it, with the number
 * of curves that would pass then; calls `without(name)` with the name of its column.
 * @param {Filters} filters @param {Column[]} columns @param {(name: string) => void} without
 */
export function noResults(filters, columns, without, isPartial = false) {
  const names = [...filters.fails.keys()];
  const way = (/** @type {string} */ name) => {
    const title = columns.find((one) => one.name === name)?.title ?? name;
    const left = formatCount(filters.countWithout(name), "curve");
    return h(
      "li",
      buttonOf(`Remove ${title}: ${left}`, () => without(name)),
    );
  };
  const none = isPartial ? "None of the loaded curves passes" : "No curve passes";
  const sentence = names.length === 1 ? `${none} this filter.` : `${none} all of these filters.`;
  return h("div.no-results", h("p", sentence), h("ul.toolbar", names.map(way)));
}
