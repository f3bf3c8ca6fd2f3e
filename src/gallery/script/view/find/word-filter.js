// A filter for words: checkboxes with counts.

import { h } from "../dom.js";
import { columnLabel } from "./column-label.js";

/** Calls `changed(filter)` with a Set of words, or null for all. */
export class WordFilter {
  constructor(column, table, filter, changed) {
    Object.assign(this, { column, changed });
    this.chosen = new Set(filter ?? []);
    this.values = table.words(column.name).values;
    this.boxes = this.values.map((word) =>
      h("input", { type: "checkbox", onchange: () => this.ticked(word) }),
    );
    this.counts = this.values.map(() => h("span", { class: "count" }));
    this.boxes.forEach((box, k) => {
      box.checked = this.chosen.has(this.values[k]);
    });
    this.element = h(
      "fieldset",
      { class: "words" },
      h("legend", { title: `${column.name}: ${column.definition}` }, columnLabel(column.name)),
      this.values.map((word, k) =>
        h("label", { class: "check" }, this.boxes[k], h("span", {}, word), this.counts[k]),
      ),
    );
  }

  ticked(word) {
    if (!this.chosen.delete(word)) this.chosen.add(word);
    this.changed(this.chosen.size ? new Set(this.chosen) : null);
  }

  /** Shows how many rows pass with each word. */
  show(counts) {
    counts.forEach((count, k) => {
      this.counts[k].textContent = count.toLocaleString("en");
    });
  }
}
