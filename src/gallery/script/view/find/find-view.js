// The view that finds curves by their measures.

import { beginsWithGreatest, filterColumns } from "../../find/columns.js";
import { Filters, Orders, passingRows } from "../../find/filter.js";
import { formatFindQuery, parseFindQuery } from "../../find/query.js";
import { CurveTable } from "../../find/table.js";
import { buttonOf, fill, h, keepFocus } from "../dom.js";
import { MAX_AUTOLOAD_BYTES, familyChooser, loadAllLine } from "./loading.js";
import { loadTables, loadedCurves, requestedFamilies } from "./loading.js";
import { findLayout, noResults, FilterPanel } from "./panel.js";
import { ResultRows } from "./rows.js";
import { ResultTiles } from "./tiles.js";
import { rowText } from "../labels.js";
import { Store } from "../store.js";
import { matchesRoute, routeAddress } from "../../data/address.js";

const ADDRESS_DELAY = 250;

/** The route `#/find?…`: filters on every measure and parameter, and the curves that pass. @type {Route} */
export const findRoute = {
  name: "find",
  label: "Find",
  href: (app) => routeAddress("find", {}, app),
  matches: (target, app) => matchesRoute("find", target, app),
  open: (app, { query }) => new FindView(app, query),
};

export class FindView {
  title = "Find";
  /** @type {CurveTable} */ table = new CurveTable([]);
  orders = new Orders(this.table);
  filters = new Filters(this.table);
  /** @type {Column[]} */ columns = [];
  /** The rows that pass. @type {Uint32Array} */ rows = new Uint32Array();
  /** What is said while tables are loaded, and whether not all are. */ loading = "";
  isPartial = true;
  isLoaded = false;
  laying = 0;
  saying = 0;
  /** Whether the panel itself changes a filter. */ isFiltering = false;
  /** Stopped by what is loaded next. */ reading = new AbortController();

  constructor(/** @type {App} */ app, /** @type {AddressQuery} */ query) {
    this.app = app;
    this.address = query;
    this.store = new Store(app, this.stateOf(query), (state) =>
      routeAddress("find", formatFindQuery(state), app),
    );
    this.panel = new FilterPanel((name, filter, isHeld) => this.setFilter(name, filter, isHeld));
    this.tiles = new ResultTiles(app);
    /** @param {string} name @param {boolean} down */
    const sortBy = (name, down) => this.store.change({ sort: { name, down } });
    this.list = new ResultRows(app, (name) => {
      const { sort } = this.query;
      sortBy(name, sort.name === name ? !sort.down : beginsWithGreatest(app.atlas.measures, name));
    });
    this.countLabel = h("p.counted", "Loading");
    this.loadAll = loadAllLine(() => {
      this.limit = Infinity;
      this.load();
      this.results.focus({ preventScroll: true });
    });
    this.limit = MAX_AUTOLOAD_BYTES;
    this.message = h("p.note", { hidden: true });
    this.results = h("div.found", { tabindex: "-1" });
    this.sorter = h("select", {
      id: "find-sort",
      onchange: ({ target: { value } }) => sortBy(value, beginsWithGreatest(app.atlas.measures, value)),
    });
    this.direction = buttonOf("", () => sortBy(this.query.sort.name, !this.query.sort.down));
    this.families = h("div.family-choice");
    const { element, displayButtons, clear } = findLayout(this);
    this.element = element;
    this.displayButtons = displayButtons;
    this.clear = clear;
    this.load();
    this.store.watch((state, before) => before && this.changed(state, before));
  }

  /** What is searched for. */
  get query() {
    return this.store.state;
  }

  stateOf(/** @type {AddressQuery} */ query) {
    return parseFindQuery(query, (id) => this.app.atlas.families.some((family) => family.id === id));
  }

  /** Shows what a gesture, or another address, has changed. @param {FindQuery} state @param {FindQuery} before */
  changed(state, before) {
    if (String(state.families) !== String(before.families)) this.load();
    else if (state.filters !== before.filters && !this.isFiltering && this.isLoaded) {
      const focused = keepFocus(this.panel.element);
      this.applyQuery();
      focused();
    } else this.show();
  }

  /** Loads the tables of the requested families, up to the limit, and applies the query as they arrive. */
  load() {
    const { app, query } = this;
    this.reading.abort();
    this.reading = new AbortController();
    const listed = requestedFamilies(app.atlas, query.families);
    const choose = (/** @type {string[] | null} */ ids) => this.store.change({ families: ids });
    fill(this.families, familyChooser(app.atlas, listed, choose));
    this.loadAll.show(null);
    /** @param {Family[]} families @param {LoadState} state */
    const onLoad = (families, state) => this.setFamilies(families, state);
    const onError = (/** @type {string} */ sentence) => this.showMessage(sentence);
    loadTables(app.atlas, listed, this.limit, this.reading.signal, onLoad, onError);
  }

  setFamilies(/** @type {Family[]} */ families, /** @type {LoadState} */ state) {
    this.isLoaded = true;
    this.table = new CurveTable(families, families.map(loadedCurves));
    this.orders = new Orders(this.table);
    const kept = new Set([...this.query.filters.keys(), this.query.sort.name]);
    this.columns = filterColumns(this.table, this.app.atlas.measures, kept);
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
    const options = this.columns.map(({ name, title }) => h("option", { value: name }, title));
    fill(this.sorter, h("option", { value: "" }, "atlas order"), options);
    this.show();
    const { name } = this.query.sort;
    if (name && !this.sortColumn) this.address.ignore("sort", `there is no “${name}”`);
  }

  /** Sets a filter; the gesture ends when nothing has followed, unless a handle is held. @param {Filter | null} filter */
  setFilter(/** @type {string} */ name, filter, isHeld = false) {
    const filters = new Map(this.query.filters);
    if (filter) filters.set(name, filter);
    else filters.delete(name);
    const began = performance.now();
    this.filters.set(name, filter);
    this.isFiltering = true;
    this.store.preview({ filters });
    this.isFiltering = false;
    this.element.dataset.milliseconds = (performance.now() - began).toFixed(1);
    if (!isHeld) this.store.commitSoon(ADDRESS_DELAY);
  }

  /** Replaces all filters; the focus moves to the results, since the button that was pressed may be removed. */
  setFilters(/** @type {Map<string, Filter>} */ filters) {
    this.store.change({ filters });
    this.results.focus({ preventScroll: true });
  }

  /** Shows the curves that pass the filters. */
  show() {
    const { sort, show } = this.query;
    const column = this.sortColumn;
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
    this.laying ||= requestAnimationFrame(() => this.layOut());
  }

  get sortColumn() {
    return this.columns.find(({ name }) => name === this.query.sort.name);
  }

  layOut() {
    this.laying = 0;
    const { sort, show } = this.query;
    const column = this.sortColumn;
    if (this.rows.length === 0 && this.table.count > 0 && !this.loading) {
      const without = (/** @type {string} */ name) =>
        this.setFilters(new Map([...this.query.filters].filter(([other]) => other !== name)));
      fill(this.results, noResults(this.filters, this.columns, without, this.isPartial));
      return;
    }
    const list = show === "table" ? this.list : this.tiles;
    if (list.element.parentElement !== this.results) fill(this.results, list.element);
    if (show === "table") this.list.setRows(this.table, this.rows, this.shownColumns(column), sort);
    else this.tiles.setRows(this.table, this.rows, (row) => column && rowText(this.table, column, row));
  }

  /** Sorted and filtered columns come first, so that they are visible. @param {Column | undefined} column */
  shownColumns(column) {
    const isNamed = (/** @type {Column} */ { name }) => name === column?.name || this.query.filters.has(name);
    const isFirst = (/** @type {Column} */ { group }) => group === "first";
    const named = this.columns.filter((one) => isNamed(one) && !isFirst(one));
    return [...named, ...this.columns.filter(isFirst)];
  }

  count() {
    const [left, all] = [this.rows.length, this.table.count].map((number) => number.toLocaleString("en"));
    const sentence = this.table.count ? `${left} of ${all} curves` : "No curves are loaded; select families";
    fill(this.countLabel, h("b", sentence), this.loading);
    window.clearTimeout(this.saying);
    this.saying = window.setTimeout(() => this.app.announce(sentence), 2 * ADDRESS_DELAY);
  }

  showMessage(/** @type {string} */ sentence) {
    this.message.hidden = false;
    fill(this.message, sentence);
  }

  /** Handles another address of this route. */
  update(/** @type {Target} */ { query }) {
    this.address = query;
    this.store.show(this.stateOf(query));
    return true;
  }

  shown() {
    this.tiles.shown();
    this.list.fill();
  }

  leave() {
    this.reading.abort();
    cancelAnimationFrame(this.laying);
    this.tiles.end();
    this.list.end();
    this.store.leave();
    window.clearTimeout(this.saying);
    // A browser may keep form controls that were removed, and with them this view: its data are released.
    this.panel.release();
    this.table = new CurveTable([]);
    this.orders = new Orders(this.table);
    this.filters = new Filters(this.table);
    this.columns = [];
    this.rows = new Uint32Array();
  }
}
