// Buttons that pin curves.

import { h } from "./dom.js";

/**
 * A button that pins the curve of a name, "family:cell.trace.circuit", and takes it down again. What it says
 * are the children, or else whether the curve is pinned.
 */
export function pinButton(app, name, attributes = {}, ...children) {
  const act = () => {
    const { pin } = button.dataset;
    app.pins.toggle(pin);
    markPin(app, button);
    app.announce(app.pins.has(pin) ? `${pin} pinned` : `${pin} no longer pinned`);
  };
  const button = h("button", { type: "button", "data-pin": name, onclick: act, ...attributes }, ...children);
  markPin(app, button);
  return button;
}

/** Has a button pin the curve of another name from now on. */
export function setPinName(app, button, name) {
  button.dataset.pin = name;
  markPin(app, button);
}

/** Keeps the buttons in an element as the pins are, until the function that it returns is called. */
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
