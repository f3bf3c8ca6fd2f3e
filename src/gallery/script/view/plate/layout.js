// The layout of a plate.

import { address } from "../../data/address.js";
import { curveKey } from "../../data/family.js";
import { fill, h } from "../dom.js";
import { curveOrigin, cellHeading } from "./facts.js";
import { formatCaption, formatChanges } from "../labels.js";
import { setPinName, pinButton, watchPins } from "../pin-button.js";
import { exportMenu } from "../export/menu.js";
import { neighbourAddress } from "./keys.js";

/** The element of a plate, { element, refresh(), leave() }. */
export function plateLayout(plate) {
  const { app, family, curve, stage, transport, dial, speed, sliders, switches, measures } = plate;
  const { caption, note } = cellHeading(family, family.curves.cell[curve]);
  const key = curveKey(family, curve);
  const changed = h("span", { class: "tag changed-tag", hidden: true }, "parameters changed");
  const pin = pinButton(app, `${family.id}:${key}`, { class: "pin" });
  const take = exportMenu(app, () => [plate.name]);
  const heading = h(
    "div",
    { class: "head" },
    h(
      "div",
      {},
      h(
        "h1",
        {},
        h("a", { href: address([family.id]), class: "family-title" }, family.title),
        " ",
        h("span", { class: "key" }, key),
      ),
      h(
        "p",
        { class: "lede" },
        caption,
        note ? h("span", { class: "note" }, ` · ${note}`) : null,
        " ",
        changed,
      ),
    ),
    h(
      "nav",
      { class: "toolbar", "aria-label": "Curve" },
      neighbourLink(family, curve, -1),
      neighbourLink(family, curve, 1),
      pin,
      take,
    ),
  );
  const side = h(
    "aside",
    { class: "panel plate-panel", "aria-label": "Readings and parameters" },
    dial.element,
    speed.element,
    sliders.element,
    switches.element,
    switches.circuitSection,
  );
  const element = h(
    "div",
    { class: "view plate" },
    heading,
    h(
      "div",
      { class: "split plate-split" },
      h("div", { class: "plate-main" }, stage.element, transport.element),
      side,
    ),
    h(
      "div",
      { class: "plate-facts" },
      h("section", {}, h("h2", {}, "Origin"), curveOrigin(app, family, curve)),
      measures.element,
    ),
  );
  const refresh = () => {
    changed.hidden = plate.isRecorded || plate.study === null;
    fill(changed, plate.changes.size ? formatCaption(formatChanges(plate.changes)) : "another circuit");
    setPinName(app, pin, plate.name);
    pin.disabled = plate.reason !== null;
  };
  return { element, refresh, leave: watchPins(app, element) };
}

function neighbourLink(family, curve, way) {
  const next = neighbourAddress(family, curve, way);
  const words = way < 0 ? "← Previous" : "Next →";
  const keys = way < 0 ? "[" : "]";
  if (!next) return h("span", { class: "button", "aria-disabled": "true" }, words);
  return h(
    "a",
    { class: "button", href: next, rel: way < 0 ? "prev" : "next", "aria-keyshortcuts": keys },
    words,
  );
}
