// The panel next to a page: its list of curves, or the highlighted curve.

import { address, curveAddress } from "../data/address.js";
import { cellCaption, cellText, cellValues, curveKey, measureValue, pageViews } from "../data/family.js";
import { buttonOf, h, termList } from "./dom.js";
import { formatCaption, formatNumber, measureText, formatCount } from "./labels.js";
import { thumbnail } from "./thumbnail.js";
import { panelCells } from "../data/needs.js";
import { pinButton } from "./pins.js";

/**
 * The curves of a page as links, and the linkages that could not be assembled.
 * @param {Family} family @param {number} page @param {DrawnCurve[]} drawn @param {{ one?: boolean, onenter(curve: number): void, onleave(): void }} _
 */
export function curveListPanel(family, page, drawn, { onenter, onleave }) {
  // If all curves are of one linkage, each row shows only its point.
  const one = drawn.length > 1 && drawn.every(({ view }) => view.cell === drawn[0].view.cell);
  const links = drawn.map(({ curve }) => h("li", curveRow(family, curve, { one, onenter, onleave })));
  const short = cellsOnPage(family, page).filter((cell) => family.cells.status[cell] === 2);
  return h(
    "div.panel",
    one ? h("h2", formatCaption(cellLabel(family, drawn[0].view.cell, "Linkage"))) : null,
    drawn.length
      ? h(one ? "p.note" : "h2", `${formatCount(drawn.length, "curve")} on this page`)
      : noCurvesNote(family),
    h("ol.page-curves", links),
    short.length ? notAssembledList(family, short) : null,
  );
}

function noCurvesNote(/** @type {Family} */ family) {
  if (family.layout !== "chart")
    return [h("h2", "No curves"), h("p.note", "No curves are drawn on this page.")];
  const href = address([family.id], { show: "curves" });
  const link = h("a", { href }, formatCount(family.curves.count, "curve"));
  return [h("h2", "A chart"), h("p.note", "Computed from ", link, ", which are not drawn on it.")];
}

/** The caption of a cell, or its number after a word. */
function cellLabel(/** @type {Family} */ family, /** @type {number} */ cell, /** @type {string} */ word) {
  return cellCaption(family, cell) || `${word} ${family.cells.number[cell]}`;
}

/** @param {Family} family @param {number} curve @param {{ one?: boolean, onenter(curve: number): void, onleave(): void }} _ */
function curveRow(family, curve, { one, onenter, onleave }) {
  const { cell, circuit } = family.curves;
  const caption = one ? null : cellLabel(family, cell[curve], "linkage");
  const point = pointLabel(family, curve);
  const words = [caption, point, circuit[curve] > 1 || (one && !point) ? `circuit ${circuit[curve]}` : null];
  const over = { onpointerenter: () => onenter(curve), onpointerleave: onleave };
  return h(
    "a",
    {
      href: curveAddress(family.id, curveKey(family, curve)),
      ...over,
      onfocus: over.onpointerenter,
      onblur: onleave,
    },
    thumbnail(family, [curve], { width: 44, height: 30 }),
    h("span", formatCaption(words.filter(Boolean).join(" · "))),
  );
}

/** What pages call a curve by its traced point, if the linkage has several. @param {Family} family */
export function pointLabel(family, /** @type {number} */ curve) {
  const trace = family.curves.trace[curve];
  return family.traces > 1 ? (family.paths[trace - 1] ?? `point ${trace}`) : "";
}

/** The linkages that could not be assembled, each with the reason. @param {Family} family */
function notAssembledList(family, /** @type {number[]} */ cells) {
  const item = (/** @type {number} */ cell) => {
    const reason = h("span.note", ` ${cellText(family, cell, "reason")}`);
    return h("li", h("b", formatCaption(cellLabel(family, cell, "linkage"))), reason);
  };
  return h("section.not-assembled", h("h3", "Could not be assembled"), h("ul", cells.map(item)));
}

/**
 * The data of a curve: caption, class, parameters, measures and actions.
 * @param {App} app @param {Family} family @param {number} curve @param {{ onall(): void }} _
 */
export function curvePanel(app, family, curve, { onall }) {
  const { cell, closed } = family.curves;
  const at = cell[curve];
  const key = curveKey(family, curve);
  const note = cellText(family, at, "note");
  const words = ["class", "type"].map((name) => measureValue(family, curve, name)).filter(Boolean);
  const tags = [`curve ${key}`, pointLabel(family, curve), ...new Set(words), closed[curve] ? null : "open"];
  const shown = tags.filter(Boolean).map((word) => [h("span.tag", word), " "]);
  return h(
    "div.panel",
    h("h2", formatCaption(cellLabel(family, at, "Linkage"))),
    h("p.tags", shown),
    note ? h("p.note", note) : null,
    family.cells.status[at] === 1 ? h("p.note", `Partial: ${cellText(family, at, "reason")}`) : null,
    h(
      "div.toolbar.no-print",
      h("a.button", { href: curveAddress(family.id, key) }, "Open plate"),
      pinButton(app, `${family.id}:${key}`),
      buttonOf("All curves", onall, { class: "quiet" }),
    ),
    parameterFacts(family, at),
    measureFacts(app.atlas, family, curve),
  );
}

function parameterFacts(/** @type {Family} */ family, /** @type {number} */ cell) {
  const values = cellValues(family, cell);
  const rows = family.names.map((name, k) => [h("i", name), formatNumber(values[k], 6)]);
  const shown = rows.filter((_, k) => Number.isFinite(values[k]));
  return shown.length ? [h("h3", "Parameters"), termList("dl.facts.page-parameters", shown)] : null;
}

/** The measures of a curve with tooltips, and all definitions in a collapsed list. */
function measureFacts(/** @type {Atlas} */ atlas, /** @type {Family} */ family, /** @type {number} */ curve) {
  const rows = atlas.measures.map((measure) => ({ ...measure, text: measureText(family, curve, measure) }));
  const shown = rows.filter(({ name, text }) => text !== undefined && !["class", "type"].includes(name));
  const definitions = shown.map(({ title, definition }) => [title, definition]);
  const terms = shown.map(({ title, definition, text }) => [
    h("dt", { title: definition }, title),
    h("dd", text),
  ]);
  return [
    h("h3", "Measures"),
    h("dl.facts.page-measures", terms),
    h("details.definitions.note", h("summary", "Definitions"), termList("dl", definitions)),
  ];
}

/**
 * The cells on a page, numbered from 1, in order. Drawn cells are listed in the data; the position of a cell
 * that is not drawn follows from the number of panels per page, or of pages per linkage.
 */
function cellsOnPage(/** @type {Family} */ family, /** @type {number} */ page) {
  if (family.layout === "chart") return [];
  const drawn = new Set(pageViews(family, page).map(({ cell }) => cell));
  const [first, last] = panelCells(family, page);
  for (let cell = first; cell < last; cell += 1) drawn.add(cell);
  const { count } = family.cells;
  const pages = family.pageCount;
  if (family.layout === "coupler-grid" && pages % count === 0)
    drawn.add(Math.floor(((page - 1) * count) / pages));
  return [...drawn].sort((a, b) => a - b);
}

/** The label of a page: the caption of its only linkage, or the numbers of its linkages. */
export function pageLabel(/** @type {Family} */ family, /** @type {number} */ page) {
  const cells = cellsOnPage(family, page);
  if (cells.length === 0) return family.layout === "chart" ? "chart" : "";
  const numbers = cells.map((cell) => family.cells.number[cell]);
  if (cells.length > 1) return `linkages ${numbers[0]}–${numbers.at(-1)}`;
  const caption = cellLabel(family, cells[0], "linkage");
  const traces = pageViews(family, page).flatMap((view) => view.curves.map((c) => family.curves.trace[c]));
  const isRange = traces.length > 1 && family.paths.length === 0;
  return isRange ? `${caption} · points ${Math.min(...traces)}–${Math.max(...traces)}` : caption;
}
