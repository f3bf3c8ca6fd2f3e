// The panel next to a page: its list of curves, or the highlighted curve.

import { address } from "../data/address.js";
import { cellCaption, cellText, curveCaption, curveKey, measureValue } from "../data/family.js";
import { h } from "./dom.js";
import { cellsOnPage } from "./page-cells.js";
import { formatCaption, formatNumber, measureLabel, measureText } from "./labels.js";
import { pinButton } from "./pin-button.js";
import { thumbnail } from "./thumbnail.js";

/** The curves of a page as links, and the linkages that could not be assembled. */
export function curveListPanel(family, page, drawn, { onenter, onleave }) {
  // If all curves are of one linkage, each row shows only its point.
  const one = drawn.length > 1 && drawn.every(({ view }) => view.cell === drawn[0].view.cell);
  const links = new Map(
    drawn.map(({ curve }) => [curve, curveRow(family, curve, { one, onenter, onleave })]),
  );
  const short = cellsOnPage(family, page).filter((cell) => family.cells.status[cell] === 2);
  return h(
    "div",
    { class: "panel" },
    one ? h("h2", {}, captionOfCurve(family, drawn[0].curve)) : null,
    drawn.length ? curveCount(drawn.length, one) : noCurvesNote(family),
    h(
      "ol",
      { class: "page-curves" },
      [...links.values()].map((link) => h("li", {}, link)),
    ),
    short.length ? notAssembledList(family, short) : null,
  );
}

function curveCount(count, isBelowHeading) {
  const sum = `${count} ${count === 1 ? "curve" : "curves"} on this page`;
  return isBelowHeading ? h("p", { class: "note" }, sum) : h("h2", {}, sum);
}

function noCurvesNote(family) {
  const [heading, sentence] =
    family.layout === "chart"
      ? ["A chart", chartCurvesNote(family)]
      : ["No curves", "No curves are drawn on this page."];
  return [h("h2", {}, heading), h("p", { class: "note" }, sentence)];
}

function chartCurvesNote(family) {
  return [
    "Computed from ",
    h(
      "a",
      { href: address([family.id], { show: "curves" }) },
      `${family.curves.count.toLocaleString("en")} curves`,
    ),
    ", which are not drawn on it.",
  ];
}

function captionOfCurve(family, curve) {
  const cell = family.curves.cell[curve];
  return formatCaption(cellCaption(family, cell) || `Linkage ${family.cells.number[cell]}`);
}

function curveRow(family, curve, { one, onenter, onleave }) {
  const { cell, circuit } = family.curves;
  const caption = one ? null : curveCaption(family, curve) || `linkage ${family.cells.number[cell[curve]]}`;
  const words = [
    caption,
    pointLabel(family, curve),
    circuit[curve] > 1 || one ? `circuit ${circuit[curve]}` : null,
  ];
  if (one && pointLabel(family, curve) && circuit[curve] === 1) words.pop();
  return h(
    "a",
    {
      href: address([family.id, "curve", curveKey(family, curve)]),
      onpointerenter: () => onenter(curve),
      onfocus: () => onenter(curve),
      onpointerleave: onleave,
      onblur: onleave,
    },
    thumbnail(family, [curve], { width: 44, height: 30 }),
    h("span", {}, formatCaption(words.filter(Boolean).join(" · "))),
  );
}

/** The label of the traced point of a curve, if the linkage has several. */
export function pointLabel(family, curve) {
  return family.traces > 1 ? `point ${family.curves.trace[curve]}` : "";
}

/** The linkages that could not be assembled, each with the reason. */
function notAssembledList(family, cells) {
  return h(
    "section",
    { class: "not-assembled" },
    h("h3", {}, "Could not be assembled"),
    h(
      "ul",
      {},
      cells.map((cell) =>
        h(
          "li",
          {},
          h("b", {}, formatCaption(cellCaption(family, cell) || `linkage ${family.cells.number[cell]}`)),
          h("span", { class: "note" }, ` ${cellText(family, cell, "reason")}`),
        ),
      ),
    ),
  );
}

/** The data of a curve: caption, class, parameters, measures and actions. */
export function curvePanel(app, family, curve, { onall }) {
  const { cell, closed } = family.curves;
  const at = cell[curve];
  const key = curveKey(family, curve);
  const note = cellText(family, at, "note");
  const words = ["class", "type"].map((name) => measureValue(family, curve, name)).filter(Boolean);
  return h(
    "div",
    { class: "panel" },
    h("h2", {}, formatCaption(cellCaption(family, at) || `Linkage ${family.cells.number[at]}`)),
    h(
      "p",
      { class: "tags" },
      [`curve ${key}`, pointLabel(family, curve), ...new Set(words), closed[curve] ? null : "open"]
        .filter(Boolean)
        .map((word) => [h("span", { class: "tag" }, word), " "]),
    ),
    note ? h("p", { class: "note" }, note) : null,
    family.cells.status[at] === 1
      ? h("p", { class: "note" }, `Partial: ${cellText(family, at, "reason")}`)
      : null,
    h(
      "div",
      { class: "toolbar no-print" },
      h("a", { class: "button", href: address([family.id, "curve", key]) }, "Open plate"),
      pinButton(app, `${family.id}:${key}`),
      h("button", { type: "button", class: "quiet", onclick: onall }, "All curves"),
    ),
    parameterFacts(family, at),
    measureFacts(app.atlas, family, curve),
  );
}

function parameterFacts(family, cell) {
  const width = family.names.length;
  const rows = family.names.map((name, k) => [name, family.cells.values[cell * width + k]]);
  const shown = rows.filter(([, value]) => Number.isFinite(value));
  if (shown.length === 0) return null;
  return [
    h("h3", {}, "Parameters"),
    h(
      "dl",
      { class: "facts page-parameters" },
      shown.map(([name, value]) => [h("dt", {}, h("i", {}, name)), h("dd", {}, formatNumber(value, 6))]),
    ),
  ];
}

/** The measures of a curve with tooltips, and all definitions in a collapsed list. */
function measureFacts(atlas, family, curve) {
  const rows = atlas.measures.map((measure) => [measure, measureText(family, curve, measure)]);
  const shown = rows.filter(([{ name }, text]) => text !== undefined && !["class", "type"].includes(name));
  return [
    h("h3", {}, "Measures"),
    h(
      "dl",
      { class: "facts page-measures" },
      shown.map(([{ name, definition }, text]) => [
        h("dt", { title: definition }, measureLabel(name)),
        h("dd", {}, text),
      ]),
    ),
    h(
      "details",
      { class: "definitions note" },
      h("summary", {}, "Definitions"),
      h(
        "dl",
        {},
        shown.map(([{ name, definition }]) => [h("dt", {}, measureLabel(name)), h("dd", {}, definition)]),
      ),
    ),
  ];
}
