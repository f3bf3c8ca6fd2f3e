// The pinned curves, which are compared and exported together, and the buttons that pin them.

import { elementIn, h } from "./dom.js";
import { onKeys } from "./keys.js";
import { storedChoice, storeChoice } from "./settings.js";

/** The names of pinned curves, "family:cell.trace.circuit", in the order in which they were pinned. */
export class Pins {
  constructor() {
    /** @type {string[]} */ this.names = [];
    /** @type {Set<(names: string[]) => void>} */ this.listeners = new Set();
  }

  has(/** @type {string} */ name) {
    return this.names.includes(name);
  }

  /** Pins a curve, or unpins it if it is pinned. */
  toggle(/** @type {string} */ name) {
    this.set(this.has(name) ? this.names.filter((known) => known !== name) : [...this.names, name]);
  }

  /** Replaces all pins. @param {string[]} names */
  set(names) {
    this.names = [...new Set(names)];
    this.listeners.forEach((listener) => listener(this.names));
  }

  /** Calls `listener` with the names whenever they change; returns a function that stops it. */
  watch(/** @type {(names: string[]) => void} */ listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}

/** The pins of an atlas in all tabs of a browser, which keeps them if it allows storage for pages on disk. */
export function storedPins(/** @type {Window} */ window) {
  const pins = new Pins();
  const key = `coupler-atlas-pins ${window.location.pathname}`;
  const read = (/** @type {string | null} */ text) => {
    try {
      /** @type {unknown[]} */ const stored = JSON.parse(text ?? "[]");
      pins.set(stored.filter((name) => typeof name === "string"));
    } catch {
      // Unreadable pins are dropped.
    }
  };
  read(storedChoice(key));
  pins.watch((names) => storeChoice(key, JSON.stringify(names)));
  // Another tab has changed them.
  window.addEventListener("storage", (event) => event.key === key && read(event.newValue));
  return pins;
}

/**
 * A button that pins or unpins the curve with a name, "family:cell.trace.circuit". Without children, its
 * label says whether the curve is pinned.
 * @param {string} name @param {...Content} children
 */
export function pinButton(/** @type {App} */ app, name, attributes = {}, ...children) {
  const act = () => {
    const { pin = "" } = button.dataset;
    app.pins.toggle(pin);
    markPin(app, button);
    app.announce(app.pins.has(pin) ? `${pin} pinned` : `${pin} unpinned`);
  };
  const button = h("button", { "data-pin": name, onclick: act, ...attributes }, ...children);
  markPin(app, button);
  return button;
}

/** Sets the curve that a button pins. @param {App} app */
export function setPinName(app, /** @type {HTMLElement} */ button, /** @type {string} */ name) {
  button.dataset.pin = name;
  markPin(app, button);
}

/** Keeps the pin buttons in an element up to date; returns a function that stops it. @param {App} app */
export function watchPins(app, /** @type {Element} */ element) {
  return app.pins.watch(() => {
    /** @type {NodeListOf<HTMLElement>} */ const buttons = element.querySelectorAll("[data-pin]");
    buttons.forEach((button) => markPin(app, button));
  });
}

function markPin(/** @type {App} */ app, /** @type {HTMLElement} */ button) {
  const isPinned = app.pins.has(button.dataset.pin ?? "");
  button.setAttribute("aria-pressed", String(isPinned));
  if (!button.firstElementChild) button.textContent = isPinned ? "Pinned" : "Pin";
}

/** A button next to the link of a curve that pins the curve. The link's `data-name` is the curve's name. */
export function curvePinButton(/** @type {App} */ app, /** @type {string} */ name) {
  const sign = h("span", { "aria-hidden": "true" }, "⚲");
  const attributes = { class: "pin quiet", tabindex: "-1", title: "Pin (p)" };
  return pinButton(app, name, attributes, sign, h("span.visually-hidden", `Pin ${name}`));
}

/** Handles the key p on the links of curves in an element: presses the pin button next to the link. */
export function pinOnKey(/** @type {Element} */ element) {
  const press = (/** @type {KeyboardEvent} */ { target }) => {
    if (!(target instanceof HTMLElement) || !target.dataset.name || !target.parentElement) return false;
    return elementIn(target.parentElement, ".pin").click();
  };
  onKeys(element, "In curves", [["p", "pin or unpin the curve", press]]);
}
