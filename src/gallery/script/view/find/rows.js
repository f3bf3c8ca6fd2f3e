// The results as a table; only the rows near the window are in the document.

import { address } from "../../data/address.js";
import { curveKey, NO_WORD } from "../../data/family.js";
import { fill, h } from "../dom.js";
import { printedCountNote, onPrint } from "../printing.js";
import { MAX_HEIGHT, scrollScale } from "../long-scroll.js";
import { watchPins } from "../pin-button.js";
import { columnLabel, columnValueText } from "./column-label.js";
import { pinOnKey, curvePinButton } from "./curve-pin.js";

const ROW_HEIGHT = 34;
const ROWS_AHEAD = 12;
// The maximum number of rows printed.
const PRINTED_ROWS = 1000;

/** A table of rows; calls `sorted(name)` when a column heading is pressed. */
export class ResultRows {
  constructor(app, sorted) {
    Object.assign(this, { app, sorted });
    this.rows = [];
    this.head = h("thead", {});
    this.body = h("tbody", {});
    this.figures = h(
      "table",
      { class: "figures results-table" },
      h("caption", { class: "visually-hidden" }, "Curves"),
      this.head,
      this.body,
    );
    this.element = h(
      "div",
      {
        class: "scroll",
        tabindex: "0",
        role: "region",
        "aria-label": "Table of curves",
        onscroll: () => this.fill(),
        onkeydown: pinOnKey,
      },
      this.figures,
    );
    this.unwatch = watchPins(app, this.element);
    this.paper = onPrint(
      this.element,
      () => this.printed(),
      () => this.fill(),
    );
  }

  end() {
    this.unwatch();
    this.paper.end();
    [this.rows, this.table] = [[], null];
  }

  setRows(table, rows, columns, sort) {
    Object.assign(this, { table, rows, columns });
    this.figures.setAttribute("aria-rowcount", rows.length + 1);
    const heading = ({ name, kind }) =>
      h(
        "th",
        {
          class: kind === "words" ? "text" : null,
          scope: "col",
          "aria-sort": sort.name === name ? (sort.down ? "descending" : "ascending") : null,
        },
        h(
          "button",
          { type: "button", onclick: () => this.sorted(name) },
          columnLabel(name),
          sort.name === name ? (sort.down ? " ↓" : " ↑") : "",
        ),
      );
    // A heading that was pressed keeps the focus when it is replaced.
    const focused = [...this.head.querySelectorAll("button")].indexOf(document.activeElement);
    fill(this.head, h("tr", {}, h("th", { scope: "col" }, "curve"), columns.map(heading)));
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
    const space = (pixels) => {
      const cell = h("td", { colspan: this.columns.length + 1, class: "space" });
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
    fill(
      this.body,
      Array.from({ length: last }, (_, k) => this.line(k)),
    );
    return printedCountNote(last, this.rows.length, "curves");
  }

  line(k) {
    const { table } = this;
    const row = this.rows[k];
    const family = table.families[table.family[row]];
    const name = table.nameOf(row);
    const href = address([family.id, "curve", curveKey(family, table.curve[row])]);
    const text = (column) => {
      if (column.kind === "numbers") return columnValueText(column, family, table.numbers(column.name)[row]);
      const { values, codes } = table.words(column.name);
      return codes[row] === NO_WORD ? "–" : values[codes[row]];
    };
    return h(
      "tr",
      { "aria-rowindex": k + 2 },
      h(
        "th",
        { scope: "row", class: "text" },
        h("a", { href, "data-name": name }, name),
        curvePinButton(this.app, name),
      ),
      this.columns.map((column) => h("td", { class: column.kind === "words" ? "text" : null }, text(column))),
    );
  }
}
