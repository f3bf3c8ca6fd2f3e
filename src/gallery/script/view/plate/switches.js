// Checkboxes for the overlays, and the choice of the circuit.

import { fill, h } from "../dom.js";
import { cognatesOfStudy, OVERLAYS } from "./overlays.js";
import { circuitTitle } from "./study.js";
import { formatLength } from "./speed-view.js";

/** Checkboxes and circuits. `on` has overlay(name, isOn) and circuit(k). */
export class Switches {
  constructor(on) {
    this.on = on;
    this.boxes = new Map(
      OVERLAYS.map(({ name, label }) => {
        const box = h("input", {
          type: "checkbox",
          name: `show-${name}`,
          onchange: () => on.overlay(name, box.checked),
        });
        return [name, { box, row: h("label", { class: "check" }, box, label) }];
      }),
    );
    this.lengths = h("div", { class: "cognate-lengths" });
    this.circuits = h("div", { class: "circuits", role: "radiogroup", "aria-label": "Circuits" });
    this.aside = h(
      "p",
      { class: "note", hidden: true },
      "The atlas does not contain this circuit. Files are exported from this page’s solution; no command " +
        "line names the circuit yet, and the manifest fragment selects all circuits.",
    );
    this.circuitSection = h(
      "section",
      { class: "gauge circuits-gauge" },
      h("h3", {}, "Circuits"),
      this.circuits,
      this.aside,
    );
    this.element = h(
      "section",
      { class: "gauge switches" },
      h("h3", {}, "Overlays"),
      h(
        "div",
        { class: "checks" },
        [...this.boxes.values()].map(({ row }) => row),
      ),
      this.lengths,
    );
  }

  /**
   * `candidates` has the linkage and routes of the current parameters, `study` is what is drawn, `isExtra`
   * says whether the atlas lacks its circuit.
   */
  show(candidates, study, on, isExtra) {
    for (const { name, there } of OVERLAYS) {
      const { box, row } = this.boxes.get(name);
      row.hidden = !study || !there(study);
      box.checked = on.has(name);
    }
    this.#cognates(study, on);
    const routes = candidates?.routes ?? [];
    fill(
      this.circuits,
      routes.map((route, k) => this.#circuit(candidates, route, k)),
    );
    this.circuitSection.hidden = routes.length < 2;
    this.aside.hidden = !isExtra;
  }

  #circuit({ linkage, home, shown }, route, k) {
    const radio = h("input", {
      type: "radio",
      name: "circuit",
      value: k + 1,
      checked: k === shown,
      onchange: () => this.on.circuit(k),
    });
    const words = `${k + 1}: ${circuitTitle(linkage, route)}`;
    return h(
      "label",
      { class: "check" },
      radio,
      h("span", {}, words, k === home ? h("span", { class: "note" }, " · this curve") : null),
    );
  }

  #cognates(study, on) {
    const pair = study && on.has("cognates") ? cognatesOfStudy(study) : null;
    this.lengths.hidden = !pair;
    if (!pair) return;
    const head = ["", "original", "first", "second"];
    const rows = ["frame", "crank", "coupler", "rocker", "along", "across"].map((name, k) => [
      name,
      pair.cognates.map(({ lengths, point }) => lengths[name] ?? point[k - 4]),
    ]);
    const row = ([name, values]) =>
      h(
        "tr",
        {},
        h("th", { scope: "row", class: "text" }, name),
        values.map((x) => h("td", {}, formatLength(x))),
      );
    fill(
      this.lengths,
      h(
        "div",
        { class: "scroll" },
        h(
          "table",
          { class: "figures" },
          h("caption", { class: "visually-hidden" }, "The three four-bars that trace this curve"),
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              head.map((word) => h("th", { scope: "col" }, word)),
            ),
          ),
          h("tbody", {}, rows.map(row)),
        ),
      ),
    );
  }
}
