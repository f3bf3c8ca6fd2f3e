// Checkboxes for the overlays, and the choice of the circuit.

import { choiceBox, figures, fill, h } from "../dom.js";
import { cognatesOfStudy, OVERLAYS } from "./overlays.js";
import { circuitTitle } from "./study.js";
import { formatLength } from "../labels.js";

/** Checkboxes and circuits. `on` has overlay(name, isOn) and circuit(k). */
export class Switches {
  constructor(/** @type {Plate} */ on) {
    this.on = on;
    this.boxes = OVERLAYS.map(({ name, label, there }) => {
      const box = choiceBox("checkbox", { name: `show-${name}` }, label);
      box.input.onchange = () => on.overlay(name, box.input.checked);
      return { name, there, ...box };
    });
    this.lengths = h("div.cognate-lengths");
    this.circuits = h("div.circuits", { role: "radiogroup", "aria-label": "Circuits" });
    this.aside = h("p.note", { hidden: true }, "The atlas does not contain this circuit.");
    this.circuitSection = h("section.gauge.circuits-gauge", h("h3", "Circuits"), this.circuits, this.aside);
    const boxes = this.boxes.map(({ element }) => element);
    const checks = h("div.checks", boxes);
    this.element = h("section.gauge.switches", h("h3", "Overlays"), checks, this.lengths);
  }

  /**
   * `candidates` has the circuits of the current parameters, `study` is what is drawn, `isExtra` says whether the atlas lacks its circuit.
   * @param {Set<string>} on @param {boolean} isExtra
   */
  show(/** @type {Candidates} */ candidates, /** @type {Study | null} */ study, on, isExtra) {
    for (const { name, there, input, element } of this.boxes) {
      element.hidden = !study || !there(study);
      input.checked = on.has(name);
    }
    this.#cognates(study, on);
    const circuits = candidates?.circuits ?? [];
    const choices = circuits.map((circuit, k) => this.#circuit(candidates, circuit, k));
    fill(this.circuits, choices);
    this.circuitSection.hidden = circuits.length < 2;
    this.aside.hidden = !isExtra;
  }

  /** @param {Candidates} _ @param {Circuit} circuit @param {number} k */
  #circuit({ is_length: isLength, home, shown }, circuit, k) {
    const onchange = () => this.on.circuit(k);
    const attributes = { name: "circuit", value: k + 1, checked: k === shown, onchange };
    const words = `${k + 1}: ${circuitTitle(isLength, circuit)}`;
    const label = h("span", words, k === home ? h("span.note", " · this curve") : null);
    return choiceBox("radio", attributes, label).element;
  }

  #cognates(/** @type {Study | null} */ study, /** @type {Set<string>} */ on) {
    const pair = study && on.has("cognates") ? cognatesOfStudy(study) : null;
    this.lengths.hidden = !pair;
    if (!pair) return;
    const head = ["", "original", "first", "second"].map((word) => h("th", { scope: "col" }, word));
    /** @type {(keyof Lengths)[]} */ const names = ["frame", "crank", "coupler", "rocker", "along", "across"];
    const row = (/** @type {keyof Lengths} */ name) => [
      h("th.text", { scope: "row" }, name),
      pair.lengths.map((lengths) => h("td", formatLength(lengths[name]))),
    ];
    const rows = names.map((name) => h("tr", row(name)));
    const table = figures("", "The three four-bars that trace this curve", head, h("tbody", rows));
    fill(this.lengths, h("div.scroll", table));
  }
}
