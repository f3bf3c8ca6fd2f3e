// The view that finds curves by their measures.

import { filterColumns } from "../../find/columns.js";
import { Filters } from "../../find/filter.js";
import { Orders, passingRows } from "../../find/order.js";
import { formatFindQuery, parseFindQuery } from "../../find/query.js";
import { CurveTable } from "../../find/table.js";
import { fill, h } from "../dom.js";
import { matchesRoute, routeAddress } from "../route-address.js";
import { exportMenu } from "../export/menu.js";
import { columnLabel, columnValueText } from "./column-label.js";
import { familyChooser } from "./families.js";
import { loadAllLine } from "./load-all.js";
import { MAX_AUTOLOAD_BYTES, loadedCurves, loadTables, requestedFamilies } from "./loading.js";
import { noResults } from "./no-results.js";
import { FilterPanel } from "./panel.js";
import { ResultRows } from "./rows.js";
import { ResultTiles } from "./tiles.js";

const ADDRESS_DELAY = 250;

/** The route `#/find?…`: filters on every measure and parameter, and the curves that pass. */
export const findRoute = {
  name: "find",
  label: "Find",
  href: (app) => routeAddress("find", {}, app),
  matches: (target, app) => matchesRoute("find", target, app),
  open: (app, { query }) => {
    const view = new FindView(app, parseFindQuery(query));
    return {
      title: "Find",
      element: view.element,
      shown: () => view.shown(),
      update: (target) => view.update(parseFindQuery(target.query)),
      leave: () => view.leave(),
    };
  },
};

class FindView {
  constructor(app, query) {
    Object.assign(this, { app, query });
    this.panel = new FilterPanel((name, filter) => this.setFilter(name, filter));
    this.tiles = new ResultTiles(app);
    this.list = new ResultRows(app, (name) =>
      this.sortBy(name, this.query.sort.name === name ? !this.query.sort.down : false),
    );
    this.countLabel = h("p", { class: "counted" }, "Loading");
    this.loadAll = loadAllLine(() => {
      this.limit = Infinity;
      this.load();
      this.results.focus({ preventScroll: true });
    });
    this.limit = MAX_AUTOLOAD_BYTES;
    this.message = h("p", { class: "note", hidden: true });
    this.results = h("div", { class: "found", tabindex: "-1" });
    this.sorter = h("select", {
      id: "find-sort",
      onchange: (event) => this.sortBy(event.target.value, this.query.sort.down),
    });
    this.direction = h("button", {
      type: "button",
      onclick: () => this.sortBy(this.query.sort.name, !this.query.sort.down),
    });
    this.families = h("div", { class: "family-choice" });
    this.element = this.buildElement();
    this.load();
  }

  buildElement() {
    const show = (name, label) =>
      h("button", { type: "button", "data-show": name, onclick: () => this.showAs(name) }, label);
    this.displayButtons = [show("sheet", "Grid"), show("table", "Table")];
    const clearAll = () => this.setFilters(new Map());
    this.clear = h("button", { type: "button", class: "quiet", onclick: clearAll }, "Clear all filters");
    const wide = window.matchMedia("(min-width: 60rem)").matches;
    return h(
      "div",
      { class: "view wide find-view" },
      h(
        "div",
        { class: "head" },
        h("div", {}, h("h1", {}, "Find"), this.countLabel, this.loadAll.element, this.message),
        exportMenu(this.app, () => this.names()),
      ),
      h(
        "div",
        { class: "find-split" },
        h(
          "details",
          { class: "find-panel", open: wide },
          h("summary", {}, "Filters"),
          this.families,
          this.panel.element,
        ),
        h(
          "div",
          {},
          h(
            "div",
            { class: "toolbar" },
            h("span", { class: "field row" }, h("label", { for: "find-sort" }, "Sort by"), this.sorter),
            this.direction,
            this.clear,
            h("div", { class: "segments end", role: "group", "aria-label": "Show as" }, this.displayButtons),
          ),
          this.results,
        ),
      ),
    );
  }

  /** Loads the tables of the requested families, up to the limit, and applies the query as they arrive. */
  load() {
    const { app, query } = this;
    this.stop?.();
    const listed = requestedFamilies(app.atlas, query.families);
    fill(
      this.families,
      familyChooser(app.atlas, listed, (families) => this.setQuery({ ...this.query, families })),
    );
    this.loadAll.show(null);
    this.stop = loadTables(
      app.atlas,
      listed,
      this.limit,
      (families, state) => this.setFamilies(families, state),
      (sentence) => this.showMessage(sentence),
    );
  }

  setFamilies(families, state) {
    this.table = new CurveTable(families, families.map(loadedCurves));
    this.orders = new Orders(this.table);
    this.columns = filterColumns(
      this.table,
      this.app.atlas.measures,
      new Set([...this.query.filters.keys(), this.query.sort.name]),
    );
    const [loaded, total] = [state.curves, state.total].map((number) => number.toLocaleString("en"));
    this.loading = state.done ? "" : ` · ${loaded} of ${total} loaded`;
    this.isPartial = state.curves < state.total;
    this.loadAll.show(state);
    this.applyQuery();
  }

  /** Sets all filters and controls from the query. */
  applyQuery() {
    this.filters = new Filters(this.table);
    for (const [name, filter] of this.query.filters) this.filters.set(name, filter);
    this.panel.setColumns(this.columns, this.table, this.query);
    fill(
      this.sorter,
      h("option", { value: "" }, "atlas order"),
      this.columns.map(({ name }) => h("option", { value: name }, columnLabel(name))),
    );
    this.show();
  }

  setFilter(name, filter) {
    if (filter) this.query.filters.set(name, filter);
    else this.query.filters.delete(name);
    const began = performance.now();
    this.filters.set(name, filter);
    this.show();
    this.element.dataset.milliseconds = (performance.now() - began).toFixed(1);
    this.writeAddress();
  }

  sortBy(name, down) {
    this.query.sort = { name, down };
    this.show();
    this.writeAddress();
  }

  showAs(name) {
    this.query.show = name;
    this.show();
    this.writeAddress();
  }

  setQuery(query) {
    const isOther = String(query.families) !== String(this.query.families);
    this.query = query;
    if (isOther) this.load();
    else if (this.table) this.applyQuery();
    this.writeAddress();
  }

  /**
   * Replaces all filters and moves the focus to the results, since the button that was pressed may be
   * removed.
   */
  setFilters(filters) {
    this.setQuery({ ...this.query, filters });
    this.results.focus({ preventScroll: true });
  }

  /** Shows the curves that pass the filters. */
  show() {
    const { sort, show } = this.query;
    const column = this.columns.find(({ name }) => name === sort.name);
    this.rows = passingRows(this.orders.by(column?.name, column?.kind, sort.down), this.filters.failing);
    this.panel.show(this.filters);
    this.sorter.value = column?.name ?? "";
    fill(this.direction, sort.down ? "Descending" : "Ascending");
    this.direction.disabled = !column;
    this.clear.hidden = this.query.filters.size === 0;
    for (const button of this.displayButtons)
      button.setAttribute("aria-pressed", String(button.dataset.show === show));
    this.count();
    // While a bound is dragged, the results are laid out once per frame.
    this.laying ??= requestAnimationFrame(() => this.layOut());
  }

  layOut() {
    this.laying = null;
    const { sort, show } = this.query;
    const column = this.columns.find(({ name }) => name === sort.name);
    if (this.rows.length === 0 && this.table.count > 0 && !this.loading) {
      const without = (name) =>
        this.setFilters(new Map([...this.query.filters].filter(([other]) => other !== name)));
      fill(this.results, noResults(this.filters, without, this.isPartial));
      return;
    }
    const list = show === "table" ? this.list : this.tiles;
    if (list.element.parentElement !== this.results) fill(this.results, list.element);
    if (show === "table") this.list.setRows(this.table, this.rows, this.shownColumns(column), sort);
    else this.tiles.setRows(this.table, this.rows, (row) => (column ? this.valueText(column, row) : null));
  }

  /** Sorted and filtered columns come first, so that they are visible. */
  shownColumns(column) {
    const isNamed = ({ name }) => name === column?.name || this.query.filters.has(name);
    const isFirst = ({ group }) => group === "first";
    const named = this.columns.filter((one) => isNamed(one) && !isFirst(one));
    return [...named, ...this.columns.filter(isFirst)];
  }

  valueText(column, row) {
    const family = this.table.families[this.table.family[row]];
    if (column.kind === "numbers")
      return columnValueText(column, family, this.table.numbers(column.name)[row]);
    const { values, codes } = this.table.words(column.name);
    return values[codes[row]] ?? "–";
  }

  count() {
    const [left, all] = [this.rows.length, this.table.count];
    const sentence =
      all === 0
        ? "No curves are loaded; select families"
        : `${left.toLocaleString("en")} of ${all.toLocaleString("en")} curves`;
    fill(this.countLabel, h("b", {}, sentence), this.loading);
    window.clearTimeout(this.saying);
    this.saying = window.setTimeout(() => this.app.announce(sentence), 2 * ADDRESS_DELAY);
  }

  showMessage(sentence) {
    this.message.hidden = false;
    fill(this.message, sentence);
  }

  names() {
    return Array.from(this.rows ?? [], (row) => this.table.nameOf(row));
  }

  writeAddress() {
    window.clearTimeout(this.writing);
    this.writing = window.setTimeout(
      () => this.app.replace(routeAddress("find", formatFindQuery(this.query), this.app)),
      ADDRESS_DELAY,
    );
  }

  /** Handles another address of this route. */
  update(query) {
    this.setQuery(query);
    return true;
  }

  shown() {
    this.isShown = true;
    this.tiles.shown();
    this.list.fill();
  }

  leave() {
    this.stop?.();
    cancelAnimationFrame(this.laying);
    this.tiles.end();
    this.list.end();
    window.clearTimeout(this.writing);
    window.clearTimeout(this.saying);
    // A browser may keep form controls that were removed, and with them this view: its data are released.
    this.panel.release();
    [this.table, this.orders, this.filters, this.columns, this.rows] = [null, null, null, [], null];
  }
}
