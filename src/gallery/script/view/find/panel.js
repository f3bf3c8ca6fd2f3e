// The panel of filters, the most useful first.

import { fill, h } from "../dom.js";
import { RangeFilter } from "./range-filter.js";
import { WordFilter } from "./word-filter.js";

/** Calls `changed(name, filter)` when a filter is changed; null removes it. */
export class FilterPanel {
  constructor(changed) {
    this.changed = changed;
    this.filters = new Map();
    this.element = h("div", { class: "filters" });
    this.opened = new Set();
  }

  /** Creates the filters for the columns of a table, set as in a query. */
  setColumns(columns, table, query) {
    this.filters.clear();
    const groups = { first: [], more: [], parameters: [] };
    for (const column of columns)
      groups[column.group].push(this.createFilter(column, table, query.filters.get(column.name)));
    const isFiltered = (group) =>
      columns.some((column) => column.group === group && query.filters.has(column.name));
    fill(
      this.element,
      groups.first,
      this.group("parameters", "Parameters", groups.parameters, isFiltered("parameters")),
      this.group("more", "More measures", groups.more, isFiltered("more")),
    );
  }

  createFilter(column, table, filter) {
    const changed = (next) => this.changed(column.name, next);
    const kind = column.kind === "words" ? WordFilter : RangeFilter;
    const one = new kind(column, table, filter, changed);
    this.filters.set(column.name, one);
    return one.element;
  }

  group(group, label, elements, isOpen) {
    if (!elements.length) return null;
    if (isOpen) this.opened.add(group);
    const toggled = ({ target }) => {
      if (target.open) this.opened.add(group);
      else this.opened.delete(group);
      if (this.shown) this.show(this.shown);
    };
    return h(
      "details",
      { class: "more-filters", open: this.opened.has(group), ontoggle: toggled },
      h("summary", {}, label, h("span", { class: "note" }, ` ${elements.length}`)),
      elements,
    );
  }

  /** Removes the filters, and with them what they know of the table. */
  release() {
    this.filters.clear();
    this.shown = null;
    fill(this.element);
  }

  /** Shows the counts of the remaining rows, in groups that are open. */
  show(filters) {
    this.shown = filters;
    const rows = filters.rows();
    for (const [name, one] of this.filters) {
      if (one.column.group !== "first" && !this.opened.has(one.column.group)) continue;
      one.show(one instanceof WordFilter ? filters.wordCounts(name) : rows);
    }
  }
}
