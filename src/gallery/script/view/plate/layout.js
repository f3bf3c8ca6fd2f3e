// The layout of a plate, and its keyboard commands.

import { address, curveAddress } from "../../data/address.js";
import { cellText, curveKey } from "../../data/family.js";
import { fill, h, isShortcut } from "../dom.js";
import { MeasureTable, curveOrigin } from "./facts.js";
import { formatCaption, formatChanges } from "../labels.js";
import { exportMenu } from "../export/menu.js";
import { thumbnail } from "../thumbnail.js";
import { stepByKey } from "./transport.js";
import { setPinName, pinButton, watchPins } from "../pins.js";

// The size of the picture of a curve whose linkage cannot be moved, in pixels.
const STILL_PLATE = { width: 640, height: 420 };

/** The element of a plate, { element, refresh(), leave() }. @param {Plate} plate */
export function plateLayout(plate) {
  const { app, family, curve, stage, transport, dial, motion, sliders, switches, measures } = plate;
  const changed = h("span.tag.changed-tag", { hidden: true }, "parameters changed");
  const pin = pinButton(app, `${family.id}:${curveKey(family, curve)}`, { class: "pin" });
  const take = exportMenu(app, () => [plate.name]);
  const side = h(
    "aside.panel.plate-panel",
    { "aria-label": "Readings and parameters" },
    [dial, motion, sliders, switches].map((part) => part.element),
    switches.circuitSection,
  );
  const element = h(
    "div.view.plate",
    plateHeading(family, curve, { tag: changed, tools: [pin, take] }),
    h("div.split.plate-split", h("div.plate-main", stage.element, transport.element), side),
    plateFacts(app, family, curve, measures),
  );
  const refresh = () => {
    changed.hidden = plate.isRecorded || plate.study === null;
    fill(changed, plate.changes.size ? formatCaption(formatChanges(plate.changes)) : "another circuit");
    setPinName(app, pin, plate.name);
    pin.disabled = plate.reason !== null;
  };
  return { element, refresh, leave: watchPins(app, element) };
}

/** The element of the plate of a curve whose linkage cannot be moved, with a sentence that says why. */
export function stillPlateLayout(/** @type {App} */ app, /** @type {Family} */ family, curve, sentence) {
  const name = `${family.id}:${curveKey(family, curve)}`;
  const tools = [pinButton(app, name, { class: "pin" }), exportMenu(app, [name])];
  const element = h(
    "div.view.plate",
    plateHeading(family, curve, { tag: null, tools }),
    h("p.error", sentence),
    h("div.still-plate", thumbnail(family, [curve], STILL_PLATE)),
    plateFacts(app, family, curve, new MeasureTable(app, family, curve)),
  );
  return { element, leave: watchPins(app, element) };
}

function plateHeading(/** @type {Family} */ family, curve, { tag, tools }) {
  const cell = family.curves.cell[curve];
  const [caption, note] = [cellText(family, cell, "caption"), cellText(family, cell, "note")];
  const title = h("a.family-title", { href: address([family.id]) }, family.title);
  const lede = h("p.lede", caption, note ? h("span.note", ` · ${note}`) : null, " ", tag);
  const links = [neighbourLink(family, curve, -1), neighbourLink(family, curve, 1), tools];
  return h(
    "div.head",
    h("div", h("h1", title, " ", h("span.key", curveKey(family, curve))), lede),
    h("nav.toolbar", { "aria-label": "Curve" }, links),
  );
}

/** @param {App} app @param {Family} family @param {MeasureTable} measures */
function plateFacts(app, family, curve, measures) {
  const origin = h("section", h("h2", "Origin"), curveOrigin(app, family, curve));
  return h("div.plate-facts", origin, measures.element);
}

function neighbourLink(/** @type {Family} */ family, curve, way) {
  const next = neighbourAddress(family, curve, way);
  const words = way < 0 ? "← Previous" : "Next →";
  const keys = way < 0 ? "[" : "]";
  if (!next) return h("span.button", { "aria-disabled": "true" }, words);
  return h("a.button", { href: next, rel: way < 0 ? "prev" : "next", "aria-keyshortcuts": keys }, words);
}

/** Listens for keys until the function that it returns is called. */
export function watchKeys(/** @type {Plate} */ plate) {
  const listener = (event) => handlePlateKey(plate, event);
  window.addEventListener("keydown", listener);
  return () => window.removeEventListener("keydown", listener);
}

function handlePlateKey(/** @type {Plate} */ plate, event) {
  const { drive, stage } = plate;
  if (event.defaultPrevented || isShortcut(event)) return;
  const { target } = event;
  const isField = target.matches?.("input:not([type=range]):not([type=checkbox]), select, textarea");
  if (isField) return;
  const isPressed = target.matches?.("button, a, summary, input[type=checkbox]");
  if (event.key === " " && !isPressed) plate.play();
  else if (event.key === "0") stage.fit();
  else if (event.key === "+" || event.key === "=") stage.zoom(1.3);
  else if (event.key === "-") stage.zoom(1 / 1.3);
  else if (event.key === "[" || event.key === "]") {
    const next = neighbourAddress(plate.family, plate.curve, event.key === "]" ? 1 : -1);
    if (next) plate.app.go(next);
  } else if (target.matches?.("input[type=range], select")) return;
  else if (/^Arrow(Left|Right)$/.test(event.key)) {
    stepByKey(event, drive);
    return;
  } else return;
  event.preventDefault();
}

/** The address of the previous (-1) or next (1) curve of a family; null at the ends. */
export function neighbourAddress(/** @type {Family} */ family, curve, way) {
  const next = curve + way;
  return next >= 0 && next < family.curves.count ? curveAddress(family.id, curveKey(family, next)) : null;
}
