// The options of the search by shape: whole or partial curves, mirror images, ranking.

import { h } from "../dom.js";

const MIN_SHARES = [0.05, 0.1, 0.15, 0.25, 0.5];

/** The controls of a query (query.js), which they change before calling `changed()`: { element, mark() }. */
export function shapeOptions(query, changed) {
  const set = (name, value) => {
    query[name] = value;
    changed();
  };
  const [whole, part] = [false, true].map((isPart) =>
    h("input", { type: "radio", name: "shape-part", onchange: () => set("part", isPart) }),
  );
  const mark = () => {
    [whole.checked, part.checked] = [!query.part, query.part === true];
  };
  mark();
  const mirror = h("input", {
    type: "checkbox",
    name: "mirror",
    onchange: () => set("mirror", mirror.checked),
  });
  mirror.checked = query.mirror;
  const element = h(
    "fieldset",
    { class: "shape-options" },
    h("legend", {}, "The shape is"),
    h("label", { class: "check" }, whole, "a whole curve"),
    h(
      "div",
      { class: "toolbar" },
      h("label", { class: "check" }, part, "a part of a curve, at least"),
      minShareSelect(query.least, (least) => set("least", least)),
    ),
    h("label", { class: "check" }, mirror, "Include mirror images"),
    rankingSelect(query.by, (by) => set("by", by)),
  );
  return { element, mark };
}

function minShareSelect(least, choose) {
  const values = [...new Set([...MIN_SHARES, least])].sort((a, b) => a - b);
  const choice = h(
    "select",
    { "aria-label": "Minimum part of a curve", onchange: () => choose(Number(choice.value)) },
    values.map((value) => h("option", { value }, `${Math.round(100 * value)} %`)),
  );
  choice.value = String(least);
  return choice;
}

function rankingSelect(by, choose) {
  const choice = h(
    "select",
    { id: "shape-by", onchange: () => choose(choice.value) },
    h("option", { value: "rms" }, "rms deviation"),
    h("option", { value: "greatest" }, "greatest deviation"),
  );
  choice.value = by;
  return h("span", { class: "field row" }, h("label", { for: "shape-by" }, "Rank by"), choice);
}
