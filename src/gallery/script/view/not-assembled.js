// The linkages of a family that could not be assembled, and why.

import { cellCaption, cellText } from "../data/family.js";
import { isFullyLoaded } from "../data/needs.js";
import { h } from "./dom.js";
import { formatCount } from "./labels.js";

// The number of linkages named for each reason.
const MAX_NAMES_PER_REASON = 12;

/**
 * A collapsed list of the linkages of a family that could not be assembled, or only partially, by reason;
 * null if there are none. Only their number if not all of the family's data are loaded.
 */
export function notAssembledSummary(/** @type {Family} */ family, /** @type {ListedFamily} */ listed) {
  const { status, number, count } = family.cells;
  if (!isFullyLoaded(family)) return listed.not_assembled ? h("p.note", notAssembledNote(listed)) : null;
  /** @type {Map<string, number[]>} */ const reasons = new Map();
  for (let cell = 0; cell < count; cell += 1) {
    if (status[cell] === 0) continue;
    const sentence = `${status[cell] === 1 ? "partial: " : ""}${cellText(family, cell, "reason")}`;
    const cells = reasons.get(sentence) ?? [];
    cells.push(cell);
    reasons.set(sentence, cells);
  }
  if (reasons.size === 0) return null;
  const none = status.filter((code) => code === 2).length;
  const part = status.filter((code) => code === 1).length;
  const sums = [
    none ? `${formatCount(none, "linkage")} could not be assembled` : null,
    part ? `${formatCount(part, "linkage")} assembled only in part` : null,
  ];
  const named = (/** @type {number[]} */ cells) =>
    cells
      .slice(0, MAX_NAMES_PER_REASON)
      .map((cell) => cellCaption(family, cell) || `linkage ${number[cell]}`)
      .join("; ");
  const item = (/** @type {[string, number[]]} */ [sentence, cells]) => {
    const more = cells.length > MAX_NAMES_PER_REASON ? " …" : "";
    return h("li", h("b", `${sentence} (${cells.length.toLocaleString("en")})`), ` ${named(cells)}${more}`);
  };
  const summary = h("summary", sums.filter(Boolean).join(", "));
  return h("details.not-assembled.note", summary, h("ul", [...reasons].map(item)));
}

/** The number of linkages of a family that could not be assembled. @param {ListedFamily} _ */
export function notAssembledNote({ not_assembled: none, kept }) {
  return `${none.toLocaleString("en")} of ${formatCount(kept, "linkage")} could not be assembled`;
}
