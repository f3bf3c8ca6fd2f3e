// The query of the Find view and its address: `?family=evans,watt&class=crank-rocker&mu_worst_deg=30..&sort=-length&show=table`.

const OTHER_KEYS = ["family", "sort", "show"];

/** Parses the query of an address; families are those that `isFamily` says. @param {AddressQuery} query */
export function parseFindQuery(query, isFamily = (/** @type {string} */ _) => true) {
  const families = query.list("family", isFamily);
  const sort = query.get("sort") ?? "";
  /** @type {Map<string, Filter>} */ const filters = new Map();
  for (const name of query.keys()) {
    const filter = OTHER_KEYS.includes(name) ? null : parseFilter(query.get(name) ?? "");
    if (filter) filters.set(name, filter);
    else if (!OTHER_KEYS.includes(name)) query.ignore(name, "neither a range, as 30..60, nor words");
  }
  return {
    families: families ?? null,
    filters,
    sort: { name: sort.replace(/^-/, ""), down: sort.startsWith("-") },
    // "room" is that of an address that would be a family's otherwise (routeAddress).
    show: query.word("show", ["table", "sheet", "room"]) === "table" ? "table" : "sheet",
  };
}

/** @returns {Filter | null} */
function parseFilter(/** @type {string} */ text) {
  const range = text.match(/^([^.]*(?:\.\d+(?:e[+-]?\d+)?)?)\.\.(.*)$/i);
  if (!range) return text ? new Set(text.split(",")) : null;
  const [low, high] = range.slice(1).map((word) => (word.trim() === "" ? undefined : Number(word)));
  const isNone = Number.isNaN(low) || Number.isNaN(high) || (low === undefined && high === undefined);
  return isNone ? null : { low, high };
}

/** The inverse of parseFindQuery, as data/address.js writes it. @param {FindQuery} _ */
export function formatFindQuery({ families, filters, sort, show }) {
  /** @type {Map<string, string>} */ const query = new Map();
  if (families) query.set("family", families.join(","));
  for (const [name, filter] of filters) {
    const { low = "", high = "" } = filter instanceof Set ? {} : filter;
    query.set(name, filter instanceof Set ? [...filter].join(",") : `${low}..${high}`);
  }
  if (sort.name) query.set("sort", `${sort.down ? "-" : ""}${sort.name}`);
  if (show === "table") query.set("show", "table");
  return query;
}
