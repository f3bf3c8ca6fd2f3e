// The query of the Compare view and its address.

/** The maximum number of curves compared. */
export const MAX_COMPARED = 12;
/** How curves are aligned: { name: label }. */
export const ALIGNMENTS = {
  none: "none",
  place: "centred",
  size: "centred and scaled",
  similar: "best fit",
  mirrored: "best fit with mirroring",
};

/** Parses a query: { names or null, view: "side" | "over", align }. */
export function parseComparisonQuery(query) {
  const names = query.get("c");
  const align = query.get("align");
  return {
    names: names ? names.split(",").filter((name) => name.includes(":")) : null,
    view: query.get("view") === "over" ? "over" : "side",
    align: align in ALIGNMENTS ? align : "similar",
  };
}

/** The inverse of parseComparisonQuery. */
export function formatComparisonQuery({ view, align }, names) {
  return {
    c: names.join(","),
    view: view === "over" ? "over" : null,
    align: align === "similar" ? null : align,
  };
}
