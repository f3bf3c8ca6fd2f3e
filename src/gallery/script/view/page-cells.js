// The linkages on a page, including those that could not be assembled.

/**
 * The cells on a page, numbered from 1, in order. Drawn cells are listed in the data; the position of a cell
 * that is not drawn follows from the number of panels per page, or of pages per linkage.
 */
export function cellsOnPage(family, page) {
  const views = family.pages[page - 1]?.views ?? [];
  const drawn = new Set(views.map(({ cell }) => cell));
  if (family.layout === "chart") return [];
  const { count } = family.cells;
  const pages = family.pages.length;
  const each = family.layout === "panels" ? panelsPerPage(family) : 0;
  for (let cell = (page - 1) * each; cell < Math.min(page * each, count); cell += 1) drawn.add(cell);
  if (family.layout === "coupler-grid" && pages % count === 0)
    drawn.add(Math.floor(((page - 1) * count) / pages));
  return [...drawn].sort((a, b) => a - b);
}

// The number of panels per page of each family, cached because it takes a scan of all pages.
const PANELS_PER_PAGE = new WeakMap();

function panelsPerPage(family) {
  if (!PANELS_PER_PAGE.has(family)) PANELS_PER_PAGE.set(family, inferPanelsPerPage(family));
  return PANELS_PER_PAGE.get(family);
}

/**
 * The smallest number of panels per page that agrees with the positions of the drawn cells; 0 if there is
 * none.
 */
function inferPanelsPerPage({ cells: { count }, pages }) {
  const agrees = (each) =>
    pages.every(({ views }, k) => views.every(({ cell }) => Math.floor(cell / each) === k));
  for (let each = Math.ceil(count / pages.length); each < count / Math.max(pages.length - 1, 1); each += 1) {
    if (agrees(each)) return each;
  }
  return pages.length === 1 ? count : 0;
}

/** The label of a page: the caption of its only linkage, or the numbers of its linkages. */
export function pageLabel(family, page) {
  const cells = cellsOnPage(family, page);
  if (cells.length === 0) return family.layout === "chart" ? "chart" : "";
  const numbers = cells.map((cell) => family.cells.number[cell]);
  if (cells.length > 1) return `linkages ${numbers[0]}–${numbers.at(-1)}`;
  const caption = family.cells.caption[cells[0]] || `linkage ${numbers[0]}`;
  const traces = (family.pages[page - 1]?.views ?? []).flatMap((view) =>
    view.curves.map((c) => family.curves.trace[c]),
  );
  if (traces.length < 2) return caption;
  return `${caption} · points ${Math.min(...traces)}–${Math.max(...traces)}`;
}
