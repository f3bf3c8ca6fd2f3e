// The layout of Find, and its panel of filters, the most useful first.

import { fill, h, choiceBox, buttonOf } from "../dom.js";
import { RangeFilter } from "./range-filter.js";
import { exportMenu } from "../export/menu.js";
import { formatCount } from "../labels.js";

/** Calls `changed(name, filter, isHeld)` when a filter is changed, perhaps by a handle that is held; null removes it. */
export class FilterPanel {
  constructor(/** @type {(name: string, filter: Filter | null, isHeld?: boolean) => void} */ changed) {
    this.changed = changed;
    /** @type {Map<string, RangeFilter | WordFilter>} */ this.filters = new Map();
    this.element = h("div.filters");
    /** @type {Set<ColumnGroup>} */ this.opened = new Set();
    /** @type {Filters | null} */ this.shown = null;
  }

  /** Creates the filters for the columns of a table, set as in a query. @param {Column[]} columns @param {CurveTable} table @param {FindQuery} query */
  setColumns(columns, table, query) {
    this.filters.clear();
    /** @type {Record<Column["group"], Element[]>} */ const groups = { first: [], more: [], parameters: [] };
    for (const column of columns)
      groups[column.group].push(this.createFilter(column, table, query.filters.get(column.name)));
    const isFiltered = (/** @type {ColumnGroup} */ group) =>
      columns.some((column) => column.group === group && query.filters.has(column.name));
    const parameters = this.group("parameters", "Parameters", groups.parameters, isFiltered("parameters"));
    const more = this.group("more", "More measures", groups.more, isFiltered("more"));
    fill(this.element, groups.first, parameters, more);
  }

  /** @param {Column} column @param {CurveTable} table @param {Filter | undefined} filter */
  createFilter(column, table, filter) {
    const changed = (/** @type {Filter | null} */ next, isHeld = false) =>
      this.changed(column.name, next, isHeld);
    const Kind = column.kind === "numbers" ? RangeFilter : WordFilter;
    const one = new Kind(column, table, filter, changed);
    this.filters.set(column.name, one);
    return one.element;
  }

  /** @param {ColumnGroup} group @param {string} label @param {Element[]} elements @param {boolean} isOpen */
  group(group, label, elements, isOpen) {
    if (!elements.length) return null;
    if (isOpen) this.opened.add(group);
    const summary = h("summary", label, h("span.note", ` ${elements.length}`));
    const details = h("details.more-filters", { open: this.opened.has(group) }, summary, elements);
    details.ontoggle = () => {
      if (details.open) this.opened.add(group);
      else this.opened.delete(group);
      if (this.shown) this.show(this.shown);
    };
    return details;
  }

  /** Removes the filters, and with them what they know of the table. */
  release() {
    this.filters.clear();
    this.shown = null;
    fill(this.element);
  }

  /** Shows the counts of the remaining rows, in groups that are open. @param {Filters} filters */
  show(filters) {
    this.shown = filters;
    const rows = filters.rows();
    for (const [name, one] of this.filters) {
      if (one.column.group !== "first" && !this.opened.has(one.column.group)) continue;
      one.show(one instanceof WordFilter ? filters.wordCounts(name) : rows);
    }
  }
}

/** Calls `changed(filter)` with a Set of words, or null for all. */
class WordFilter {
  /** @param {Column} column @param {CurveTable} table @param {Filter | undefined} filter @param {(filter: Filter | null) => void} changed */
  constructor(column, table, filter, changed) {
    this.column = column;
    this.changed = changed;
    this.chosen = new Set(filter instanceof Set ? filter : []);
    this.values = table.words(column.name).values;
    this.counts = this.values.map(() => h("span.count"));
    const box = (/** @type {string} */ word, /** @type {number} */ k) => {
      const attributes = { checked: this.chosen.has(word), onchange: () => this.ticked(word) };
      return choiceBox("checkbox", attributes, h("span", word), this.counts[k]).element;
    };
    const title = `${column.name}: ${column.definition}`;
    const legend = h("legend", { title }, column.title);
    this.element = h("fieldset.words", legend, this.values.map(box));
  }

  ticked(/** @type {string} */ word) {
    if (!this.chosen.delete(word)) this.chosen.add(word);
    this.changed(this.chosen.size ? new Set(this.chosen) : null);
  }

  /** Shows how many rows pass with each word. @param {Uint32Array} counts */
  show(counts) {
    counts.forEach((count, k) => {
      this.counts[k].textContent = count.toLocaleString("en");
    });
  }
}

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
