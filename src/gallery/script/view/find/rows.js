// The results as a table; only the rows near the window are in the document.

import { curveAddress } from "../../data/address.js";
import { curveKey } from "../../data/family.js";
import { buttonOf, fill, h, setAttributes } from "../dom.js";
import { MAX_HEIGHT, scrollScale, printedCountNote, onPrint } from "../long-list.js";
import { rowText } from "../labels.js";
import { watchPins, pinOnKey, curvePinButton } from "../pins.js";

const ROW_HEIGHT = 34;
const ROWS_AHEAD = 12;
// The maximum number of rows printed.
const PRINTED_ROWS = 1000;

/** A table of rows; calls `sorted(name)` when a column heading is pressed. */
export class ResultRows {
  /** @type {CurveTable | null} */ table = null;
  /** @type {Uint32Array | number[]} */ rows = [];
  /** @type {Column[]} */ columns = [];

  constructor(/** @type {App} */ app, /** @type {(name: string) => void} */ sorted) {
    this.app = app;
    this.sorted = sorted;
    this.head = h("thead");
    this.body = h("tbody");
    const caption = h("caption.visually-hidden", "Curves");
    this.figures = h("table.figures.results-table", caption, this.head, this.body);
    const attributes = { tabindex: "0", role: "region", "aria-label": "Table of curves" };
    this.element = h("div.scroll", { ...attributes, onscroll: () => this.fill() }, this.figures);
    pinOnKey(this.element);
    this.unwatch = watchPins(app, this.element);
    this.paper = onPrint(this);
  }

  end() {
    this.unwatch();
    this.paper.end();
    this.rows = [];
    this.table = null;
  }

  /** @param {CurveTable} table @param {Uint32Array} rows @param {Column[]} columns */
  setRows(table, rows, columns, /** @type {FindQuery["sort"]} */ sort) {
    this.table = table;
    this.rows = rows;
    this.columns = columns;
    setAttributes(this.figures, { "aria-rowcount": rows.length + 1 });
    const heading = (/** @type {Column} */ { name, title, kind }) => {
      const isSorted = sort.name === name;
      const order = sort.down ? "descending" : "ascending";
      const words = [title, isSorted ? (sort.down ? " ↓" : " ↑") : ""];
      const button = buttonOf(words, () => this.sorted(name));
      return h(kind === "words" ? "th.text" : "th", { scope: "col", "aria-sort": isSorted && order }, button);
    };
    // A heading that was pressed keeps the focus when it is replaced.
    const before = [...this.head.querySelectorAll("button")];
    const focused = before.findIndex((one) => one === document.activeElement);
    fill(this.head, h("tr", h("th", { scope: "col" }, "curve"), columns.map(heading)));
    if (focused >= 0) this.head.querySelectorAll("button")[focused]?.focus();
    this.fill();
  }

  fill() {
    if (!this.table || !this.element.isConnected || this.paper.isPrinting) return;
    const { scrollTop, clientHeight } = this.element;
    const height = this.rows.length * ROW_HEIGHT;
    const top = scrollTop * scrollScale(height, clientHeight);
    const first = Math.max(Math.floor(top / ROW_HEIGHT) - ROWS_AHEAD, 0);
    const last = Math.min(first + Math.ceil(clientHeight / ROW_HEIGHT) + 2 * ROWS_AHEAD, this.rows.length);
    const space = (/** @type {number} */ pixels) => {
      const cell = h("td.space", { colspan: this.columns.length + 1 });
      cell.style.height = `${pixels}px`;
      return pixels > 0 ? h("tr", { "aria-hidden": "true" }, cell) : null;
    };
    const shown = [];
    for (let k = first; k < last; k += 1) shown.push(this.line(k));
    const before = first * ROW_HEIGHT - (top - scrollTop);
    const after = Math.min(height, MAX_HEIGHT) - before - (last - first) * ROW_HEIGHT;
    fill(this.body, space(before), shown, space(after));
  }

  /** Puts the first rows into the document, and no others, for printing. */
  printed() {
    const last = Math.min(this.rows.length, PRINTED_ROWS);
    const lines = Array.from({ length: last }, (_, k) => this.line(k));
    fill(this.body, lines);
    return printedCountNote(last, this.rows.length, "curves");
  }

  line(/** @type {number} */ k) {
    const { table } = this;
    if (!table) return null;
    const row = this.rows[k];
    const { family, curve, name } = table.curveOf(row);
    const href = curveAddress(family.id, curveKey(family, curve));
    const link = h("a", { href, "data-name": name }, name);
    const cell = (/** @type {Column} */ column) =>
      h("td", { class: column.kind === "words" ? "text" : null }, rowText(table, column, row));
    const head = h("th.text", { scope: "row" }, link, curvePinButton(this.app, name));
    return h("tr", { "aria-rowindex": k + 2 }, head, this.columns.map(cell));
  }
}
