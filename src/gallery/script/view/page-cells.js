// The linkages on a page, including those that could not be assembled.

import { cellCaption, pageViews } from "../data/family.js";
import { panelCells } from "../data/needs.js";

/**
 * The cells on a page, numbered from 1, in order. Drawn cells are listed in the data; the position of a cell
 * that is not drawn follows from the number of panels per page, or of pages per linkage.
 */
export function cellsOnPage(family, page) {
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
export function pageLabel(family, page) {
  const cells = cellsOnPage(family, page);
  if (cells.length === 0) return family.layout === "chart" ? "chart" : "";
  const numbers = cells.map((cell) => family.cells.number[cell]);
  if (cells.length > 1) return `linkages ${numbers[0]}–${numbers.at(-1)}`;
  const caption = cellCaption(family, cells[0]) || `linkage ${numbers[0]}`;
  const traces = pageViews(family, page).flatMap((view) => view.curves.map((c) => family.curves.trace[c]));
  if (traces.length < 2) return caption;
  return `${caption} · points ${Math.min(...traces)}–${Math.max(...traces)}`;
}
