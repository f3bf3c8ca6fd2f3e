// A field for a number, which is marked while it has none.

import { parseNumber } from "../data/number.js";
import { h, isShortcut } from "./dom.js";

/**
 * A text field for a number. `on.change(value)` is called when its text is another number, `on.settle()` when that is
 * entered, `on.step(by)` for the keys up and down; an `on.empty` lets it be empty. `show(value)` sets its text. A text that is no number
 * is marked, the browser says why when it is entered, and when the field is left it shows the number that holds.
 */
export class NumberField {
  /** Why the text is no number, and why the number is wrong. @type {string | null} */ wrong = null;
  /** @type {string | null} */ outer = null;
  /** The text of the number that holds. */ held = "";

  /** @param {object} attributes @param {{ change(value: number): void, settle?(): void, step?(by: number): void, empty?(): void, units?: Units }} on */
  constructor(attributes, on) {
    this.on = on;
    this.element = h("input", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      role: "spinbutton",
      oninput: () => this.#read(),
      onchange: () => this.wrong === null && on.settle?.(),
      onblur: () => this.#left(),
      onkeydown: (event) => this.#step(event),
      ...attributes,
    });
  }

  /** Shows a number, in words if they are others; what is being typed stays. */
  show(/** @type {number | undefined} */ value, text = value === undefined ? "" : String(value)) {
    const { element } = this;
    element.setAttribute("aria-valuenow", Number.isFinite(value) ? String(value) : "");
    this.held = text;
    if (document.activeElement === element && !element.readOnly) return;
    element.value = text;
    this.#mark(null, this.outer);
  }

  /** Marks the number as wrong, with a sentence that says why, or as right: null. */
  mark(/** @type {string | null} */ outer) {
    this.#mark(this.wrong, outer);
  }

  #mark(/** @type {string | null} */ wrong, /** @type {string | null} */ outer) {
    Object.assign(this, { wrong, outer });
    const reason = wrong ?? outer;
    this.element.setAttribute("aria-invalid", String(reason !== null));
    this.element.setCustomValidity(reason ?? "");
    this.element.title = reason ?? "";
  }

  #read() {
    const { element, on } = this;
    if (element.readOnly) return;
    if (element.value.trim() === "" && on.empty) {
      this.#mark(null, null);
      on.empty();
      return;
    }
    const found = parseNumber(element.value, on.units);
    this.#mark("reason" in found ? found.reason : null, this.outer);
    if ("value" in found) on.change(found.value);
  }

  #left() {
    if (this.wrong === null) return;
    this.element.value = this.held;
    this.#mark(null, this.outer);
  }

  #step(/** @type {KeyboardEvent} */ event) {
    if (event.key === "Enter" && this.wrong !== null) this.element.reportValidity();
    const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!by || !this.on.step || this.element.readOnly || isShortcut(event)) return;
    event.preventDefault();
    this.on.step(by * (event.shiftKey ? 10 : 1));
  }
}
