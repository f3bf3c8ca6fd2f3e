// The data of a curve: its origin, and its measures next to those of changed parameters.

import { address, newLinkage } from "../../data/address.js";
import { cellText, curveKey, measureValue, pageOfCurve } from "../../data/family.js";
import { pageFile } from "../../data/atlas.js";
import { figures, fill, h, termList } from "../dom.js";
import { formatDecimals, formatLength } from "../labels.js";

/** The list of a curve's origin. @param {App} app @param {Family} family */
export function curveOrigin(app, family, /** @type {number} */ curve) {
  const cell = family.curves.cell[curve];
  const page = pageOfCurve(family, curve);
  const key = curveKey(family, curve);
  const rows = [
    ["Family", app.atlas.plate ? family.title : h("a", { href: address([family.id]) }, family.title)],
    ["Linkage", family.linkage],
    ["Cell, trace, circuit", key.replaceAll(".", ", ")],
    ["Caption", cellText(family, cell, "caption")],
    ["Note", cellText(family, cell, "note")],
    ["Status", family.cells.status[cell] === 1 ? `partial: ${cellText(family, cell, "reason")}` : ""],
    ["Page", page > 0 ? h("a", { href: address([family.id, page], { curve: key }) }, `page ${page}`) : ""],
    ["File", page > 0 ? pageFile(app.atlas, family.id, page) : ""],
    ["Source", family.source],
  ];
  const known = rows.filter(([, value]) => value);
  return termList("dl.facts.origin", known);
}

/** The table of measures: `show(now)` adds those computed by the page next to the recorded ones; null removes them. */
export class MeasureTable {
  constructor(/** @type {App} */ app, /** @type {Family} */ family, /** @type {number} */ curve) {
    this.rows = app.atlas.measures.map((measure) =>
      measureRow(measure, measureValue(family, curve, measure.name), family.is_length),
    );
    const rows = this.rows.map(({ element }) => element);
    // A linkage in no atlas has values to start from.
    const [from, words] =
      newLinkage(family.id) === null ? ["Atlas", "of the atlas"] : ["Start", "at the start"];
    this.words = `The measures ${words}, and those of the changed parameters, computed by this page.`;
    const headings = ["Measure", from, "Current", "Change"].map((word, k) =>
      h("th", { scope: "col", class: ["text", "", "now", "now"][k] }, word),
    );
    this.note = h("p.note");
    this.table = figures(".measures", "Measures of the curve", headings, h("tbody", rows));
    this.element = h("section.measures-section", h("h2", "Measures"), this.note, h("div.scroll", this.table));
    this.show(null);
  }

  /** `now` is { name: number or word } for changed parameters, or null if nothing is changed. */
  show(/** @type {Measured | null} */ now) {
    this.table.classList.toggle("with-changes", now !== null);
    fill(this.note, now ? this.words : []);
    for (const row of this.rows) {
      const value = now?.[row.measure.name];
      // Measures that apply to neither are hidden.
      row.element.hidden = row.recorded === undefined && (value === undefined || Number.isNaN(value));
      fill(row.now, now ? formatMeasure(row.measure, value, row.isLength) : "");
      fill(row.change, now ? formatMeasureChange(row.measure, row.recorded, value) : "");
    }
  }
}

/** @param {number | string | undefined} recorded @param {boolean} isLength */
function measureRow(/** @type {Measure} */ measure, recorded, isLength) {
  const now = h("td.now");
  const change = h("td.now");
  const name = h("span.measure-name", measure.title);
  const title = h("th.text", { scope: "row" }, name, h("span.definition", measure.definition));
  const ofLength = isLength && measure.is_input;
  const element = h("tr", title, h("td", formatMeasure(measure, recorded, ofLength)), now, change);
  return { element, measure, recorded, now, change, isLength: ofLength };
}

/** The value of a measure with its unit, in four or five digits; empty if it does not apply. @param {number | string | undefined} value */
function formatMeasure(/** @type {Measure} */ { word, unit }, value, isLength = false) {
  if (value === undefined || Number.isNaN(value)) return "";
  if (word || typeof value === "string") return value;
  if (Number.isInteger(value) && Math.abs(value) < 1e6 && unit !== "deg")
    return String(value).replace("-", "−");
  return unit === "deg" && !isLength && Number.isFinite(value)
    ? `${formatDecimals(value, 2)}°`
    : formatLength(value);
}

/** @param {number | string | undefined} before @param {number | string | undefined} after */
function formatMeasureChange(/** @type {Measure} */ { unit }, before, after) {
  /** @param {number | string | undefined} value */
  const isThere = (value) => value !== undefined && !Number.isNaN(value);
  if (before === after || (!isThere(before) && !isThere(after))) return "";
  if (!isThere(before)) return "new";
  if (!isThere(after)) return "gone";
  if (typeof before !== "number" || typeof after !== "number") return "changed";
  const by = after - before;
  if (!Number.isFinite(by) || Math.abs(by) < 1e-9 * Math.abs(before)) return "";
  const sign = by > 0 ? "+" : "−";
  if (Number.isInteger(before) && Number.isInteger(after)) return `${sign}${Math.abs(by)}`;
  return unit === "deg" ? `${sign}${Math.abs(by).toFixed(2)}°` : `${sign}${formatLength(Math.abs(by))}`;
}
