// Pin buttons of search results.

import { h } from "../dom.js";
import { pinButton } from "../pin-button.js";

/** A button next to the link of a curve that pins the curve. The link's `data-name` is the curve's name. */
export function curvePinButton(app, name) {
  return pinButton(
    app,
    name,
    { class: "pin quiet", tabindex: "-1", title: "Pin (p)" },
    h("span", { "aria-hidden": "true" }, "⚲"),
    h("span", { class: "visually-hidden" }, `Pin ${name}`),
  );
}

/** Handles the key p on the link of a curve: presses the pin button next to it. */
export function pinOnKey(event) {
  const { name } = event.target.dataset;
  if (event.key !== "p" || !name || event.ctrlKey || event.metaKey || event.altKey) return;
  event.target.parentElement.querySelector(".pin").click();
}
