// The panel of filters, the most useful first.

import { fill, h, choiceBox } from "../dom.js";
import { RangeFilter } from "./range-filter.js";

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
