// Buttons that pin curves.

import { h } from "./dom.js";

/**
 * A button that pins or unpins the curve with a name, "family:cell.trace.circuit". Without children, its
 * label says whether the curve is pinned.
 */
export function pinButton(app, name, attributes = {}, ...children) {
  const act = () => {
    const { pin } = button.dataset;
    app.pins.toggle(pin);
    markPin(app, button);
    app.announce(app.pins.has(pin) ? `${pin} pinned` : `${pin} unpinned`);
  };
  const button = h("button", { type: "button", "data-pin": name, onclick: act, ...attributes }, ...children);
  markPin(app, button);
  return button;
}

/** Sets the curve that a button pins. */
export function setPinName(app, button, name) {
  button.dataset.pin = name;
  markPin(app, button);
}

/** Keeps the pin buttons in an element up to date; returns a function that stops it. */
export function watchPins(app, element) {
  return app.pins.watch(() =>
    element.querySelectorAll("[data-pin]").forEach((button) => markPin(app, button)),
  );
}

function markPin(app, button) {
  const isPinned = app.pins.has(button.dataset.pin);
  button.setAttribute("aria-pressed", String(isPinned));
  if (!button.firstElementChild) button.textContent = isPinned ? "Pinned" : "Pin";
}
