// Pins of what is found, by a button and by a key.

import { h } from "../dom.js";
import { pinButton } from "../pin-button.js";

/** A button beside the link of a curve, whose `data-name` is the curve's, that pins it. */
export function curvePinButton(app, name) {
  return pinButton(
    app,
    name,
    { class: "pin quiet", tabindex: "-1", title: "Pin (p)" },
    h("span", { "aria-hidden": "true" }, "⚲"),
    h("span", { class: "visually-hidden" }, `Pin ${name}`),
  );
}

/** Has the letter p on the link of a curve press the button beside it. */
export function pinOnKey(event) {
  const { name } = event.target.dataset;
  if (event.key !== "p" || !name || event.ctrlKey || event.metaKey || event.altKey) return;
  event.target.parentElement.querySelector(".pin").click();
}
