// The layout of a plate, and its keyboard commands.

import { address, curveAddress } from "../../data/address.js";
import { cellText, curveKey } from "../../data/family.js";
import { fill, h } from "../dom.js";
import { onKeys } from "../keys.js";
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
  const take = exportMenu(app, () => [plate.name], { family, curve });
  const side = h(
    "aside.panel.plate-panel",
    { "aria-label": "Readings and parameters" },
    h("h2.visually-hidden", "Readings and parameters"),
    [dial, motion, sliders, switches].map((part) => part.element),
    switches.circuitSection,
  );
  const element = h(
    "div.view.plate",
    plateHeading(app, family, curve, { tag: changed, pin, take }),
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

/** The element of the plate of a curve whose linkage cannot be moved, with a sentence that says why. @param {number} curve @param {string} sentence */
export function stillPlateLayout(/** @type {App} */ app, /** @type {Family} */ family, curve, sentence) {
  const name = `${family.id}:${curveKey(family, curve)}`;
  const [pin, take] = [pinButton(app, name, { class: "pin" }), exportMenu(app, [name])];
  const element = h(
    "div.view.plate",
    plateHeading(app, family, curve, { tag: null, pin, take }),
    h("p.error", sentence),
    h("div.still-plate", thumbnail(family, [curve], STILL_PLATE)),
    plateFacts(app, family, curve, new MeasureTable(app, family, curve)),
  );
  return { element, leave: watchPins(app, element) };
}

/** @param {App} _ @param {Family} family @param {number} curve @param {{ tag: Element | null, pin: Element, take: Element }} parts */
function plateHeading({ atlas }, family, curve, { tag, pin, take }) {
  const cell = family.curves.cell[curve];
  const [caption, note] = [cellText(family, cell, "caption"), cellText(family, cell, "note")];
  const link = h("a.family-title", { href: address([family.id]) }, family.title);
  const title = atlas.plate ? family.title : link;
  const lede = h("p.lede", caption, note ? h("span.note", ` · ${note}`) : null, " ", tag);
  // A file of one plate leads to no other.
  const links = atlas.plate ? [] : [neighbourLink(family, curve, -1), neighbourLink(family, curve, 1), pin];
  const heading = h("h1", title, " ", h("span.key", curveKey(family, curve)));
  return h("div.head", h("div", heading, lede), h("nav.toolbar", { "aria-label": "Curve" }, links, take));
}

/** @param {App} app @param {Family} family @param {MeasureTable} measures */
function plateFacts(app, family, /** @type {number} */ curve, measures) {
  const origin = h("section", h("h2", "Origin"), curveOrigin(app, family, curve));
  return h("div.plate-facts", origin, measures.element);
}

function neighbourLink(/** @type {Family} */ family, /** @type {number} */ curve, /** @type {number} */ way) {
  const next = curve + way;
  const words = way < 0 ? "← Previous" : "Next →";
  const keys = way < 0 ? "[" : "]";
  if (next < 0 || next >= family.curves.count) return h("span.button", { "aria-disabled": "true" }, words);
  const href = curveAddress(family.id, curveKey(family, next));
  return h("a.button", { href, rel: way < 0 ? "prev" : "next", "aria-keyshortcuts": keys }, words);
}

/** Handles keys until the signal ends it. */
export function watchKeys(/** @type {Plate} */ plate, /** @type {AbortSignal} */ signal) {
  const { drive, stage, element } = plate;
  const follow = (/** @type {string} */ rel) =>
    /** @type {HTMLElement | null} */ (element.querySelector(`a[rel=${rel}]`))?.click();
  // A button is pressed by the space bar, and a slider moves by its own keys.
  const isAt = (/** @type {KeyboardEvent} */ { target }, /** @type {string} */ selector) =>
    target instanceof Element && target.matches(selector);
  const step = (/** @type {KeyboardEvent} */ event) =>
    !isAt(event, "input[type=range]") && stepByKey(event, drive);
  const pressed = "button, a, summary, input[type=checkbox]";
  /** @type {KeyCommand[]} */ const commands = [
    ["Space", "play or pause", (event) => !isAt(event, pressed) && plate.play()],
    ["ArrowLeft ArrowRight", "back or on by a degree; with Shift by ten", step],
    ["Home End", "to the previous or the next limit, or the start or the end", step],
    ["0", "fit to the frame", () => stage.fit()],
    ["+ =", "zoom in", () => stage.zoom(1.3)],
    ["-", "zoom out", () => stage.zoom(1 / 1.3)],
  ];
  /** @type {KeyCommand[]} */ const turns = [
    ["[", "previous curve", () => follow("prev")],
    ["]", "next curve", () => follow("next")],
  ];
  const all = plate.app.atlas.plate ? commands : [...commands, ...turns];
  onKeys(element, "On the plate", all, window, signal);
}
