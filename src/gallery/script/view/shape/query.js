// The query of the search by shape and its address: `?d=…` or `?like=evans:12.1.1`, and options.

const DEFAULT_MIN_SHARE = 0.15;

/**
 * Parses a query: { d: a drawn shape or undefined, like: a curve's name or undefined, part: whether it is a
 * part of a curve, or null if not set, least: the least part of a curve, mirror, by: "rms" | "greatest",
 * families: [id] or null for all }.
 */
export function parseShapeQuery(query) {
  const least = Number(query.get("least"));
  return {
    d: query.get("d"),
    like: query.get("like"),
    part: query.has("part") ? query.get("part") !== "no" : null,
    least: least > 0 && least <= 1 ? least : DEFAULT_MIN_SHARE,
    mirror: query.get("mirror") !== "no",
    by: query.get("by") === "greatest" ? "greatest" : "rms",
    families: query.get("family")?.split(",").filter(Boolean) ?? null,
  };
}

/** The inverse of parseShapeQuery. */
export function formatShapeQuery({ d, like, part, least, mirror, by, families }) {
  return {
    d,
    like,
    part: part === null ? null : part ? "yes" : "no",
    least: part && least !== DEFAULT_MIN_SHARE ? least : null,
    mirror: mirror ? null : "no",
    by: by === "rms" ? null : by,
    family: families?.join(","),
  };
}
