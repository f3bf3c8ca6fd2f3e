// The data of a curve: its origin, and its measures next to those of changed parameters.

import { address } from "../../data/address.js";
import { cellText, curveKey, measureValue, pageOfCurve } from "../../data/family.js";
import { pageFile } from "../../data/atlas.js";
import { fill, h } from "../dom.js";
import { familySource } from "../overview.js";
import { measureLabel } from "../labels.js";
import { formatLength } from "./speed-view.js";

/** The caption and the note of a cell. */
export function cellHeading(family, cell) {
  return { caption: cellText(family, cell, "caption"), note: cellText(family, cell, "note") };
}

/** The list of a curve's origin. */
export function curveOrigin(app, family, curve) {
  const cell = family.curves.cell[curve];
  const page = pageOfCurve(family, curve);
  const rows = [
    ["Family", h("a", { href: address([family.id]) }, family.title)],
    ["Linkage", family.linkage],
    ["Cell, trace, circuit", curveKey(family, curve).replaceAll(".", ", ")],
    ["Caption", cellText(family, cell, "caption")],
    ["Note", cellText(family, cell, "note")],
    ["Status", family.cells.status[cell] === 1 ? `partial: ${cellText(family, cell, "reason")}` : ""],
    [
      "Page",
      page > 0
        ? h(
            "a",
            { href: address([family.id, String(page)], { curve: curveKey(family, curve) }) },
            `page ${page}`,
          )
        : "",
    ],
    ["File", page > 0 ? pageFile(app.atlas, family.id, page) : ""],
    ["Source", familySource(family)],
  ];
  const shown = rows.filter(([, value]) => value);
  return h(
    "dl",
    { class: "facts origin" },
    shown.flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]),
  );
}

/**
 * The table of measures: `show(now)` adds those computed by the page next to the recorded ones; null removes
 * them.
 */
export class MeasureTable {
  constructor(app, family, curve, isLength) {
    this.rows = app.atlas.measures.map((measure) =>
      measureRow(measureLabel(measure.name), measure, measureValue(family, curve, measure.name), isLength),
    );
    this.body = h(
      "tbody",
      {},
      this.rows.map(({ element }) => element),
    );
    this.note = h("p", { class: "note" });
    this.table = h(
      "table",
      { class: "figures measures" },
      h("caption", { class: "visually-hidden" }, "Measures of the curve"),
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ["Measure", "Atlas", "Current", "Change"].map((word, k) =>
            h("th", { scope: "col", class: ["text", "", "now", "now"][k] }, word),
          ),
        ),
      ),
      this.body,
    );
    this.element = h(
      "section",
      { class: "measures-section" },
      h("h2", {}, "Measures"),
      this.note,
      h("div", { class: "scroll" }, this.table),
    );
    this.show(null);
  }

  /** `now` is { name: number or word } for changed parameters, or null if nothing is changed. */
  show(now) {
    this.table.classList.toggle("with-changes", now !== null);
    fill(
      this.note,
      now ? "The measures of the atlas, and those of the changed parameters, computed by this page." : [],
    );
    for (const row of this.rows) {
      const value = now?.[row.measure.name];
      // Measures that apply to neither are hidden.
      row.element.hidden = row.recorded === undefined && (value === undefined || Number.isNaN(value));
      fill(row.now, now ? formatMeasure(row.measure, value, row.isLength) : "");
      fill(row.change, now ? formatMeasureChange(row.measure, row.recorded, value) : "");
    }
  }
}

function measureRow(name, measure, recorded, isLength) {
  const now = h("td", { class: "now" });
  const change = h("td", { class: "now" });
  const title = h(
    "th",
    { scope: "row", class: "text" },
    h("span", { class: "measure-name" }, name),
    h("span", { class: "definition" }, measure.definition),
  );
  const ofLength = isLength && /^(input_m|straight_(start|input)|dwell_(start|input))/.test(measure.name);
  const element = h("tr", {}, title, h("td", {}, formatMeasure(measure, recorded, ofLength)), now, change);
  return { element, measure, recorded, now, change, isLength: ofLength };
}

/** The value of a measure with its unit, in four or five digits; empty if it does not apply. */
function formatMeasure({ word, unit }, value, isLength = false) {
  if (value === undefined || value === null || Number.isNaN(value)) return "";
  if (word || typeof value === "string") return value;
  if (value === Infinity) return "∞";
  if (Number.isInteger(value) && Math.abs(value) < 1e6 && unit !== "deg")
    return String(value).replace("-", "−");
  return unit === "deg" && !isLength ? `${value.toFixed(2).replace("-", "−")}°` : formatLength(value);
}

function formatMeasureChange({ word, unit }, before, after) {
  const isThere = (value) => value !== undefined && value !== null && !Number.isNaN(value);
  if (before === after || (!isThere(before) && !isThere(after))) return "";
  if (!isThere(before)) return "new";
  if (!isThere(after)) return "gone";
  if (word || typeof after === "string") return "changed";
  const by = after - before;
  if (!Number.isFinite(by) || Math.abs(by) < 1e-9 * Math.abs(before)) return "";
  const sign = by > 0 ? "+" : "−";
  if (Number.isInteger(before) && Number.isInteger(after)) return `${sign}${Math.abs(by)}`;
  return unit === "deg" ? `${sign}${Math.abs(by).toFixed(2)}°` : `${sign}${formatLength(Math.abs(by))}`;
}
