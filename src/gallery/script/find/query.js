// The query of the Find view and its address:
// `?family=evans,watt&class=crank-rocker&mu_worst_deg=30..&sort=-length&show=table`.

const OTHER_KEYS = new Set(["family", "sort", "show"]);

/** Parses the query of an address. @param {Query} query */
export function parseFindQuery(/** @type {Query} */ query) {
  const families = query.get("family");
  const sort = query.get("sort") ?? "";
  const filters = new Map();
  for (const [name, text] of query) {
    const filter = OTHER_KEYS.has(name) ? null : parseFilter(text);
    if (filter) filters.set(name, filter);
  }
  return {
    families: families ? families.split(",").filter(Boolean) : null,
    filters,
    sort: { name: sort.replace(/^-/, ""), down: sort.startsWith("-") },
    show: query.get("show") === "table" ? "table" : "sheet",
  };
}

function parseFilter(text) {
  const range = text.match(/^([^.]*(?:\.\d+(?:e[+-]?\d+)?)?)\.\.(.*)$/i);
  if (!range) return text ? new Set(text.split(",")) : null;
  const bound = (word) => (word.trim() !== "" && Number.isFinite(Number(word)) ? Number(word) : undefined);
  const [low, high] = [bound(range[1]), bound(range[2])];
  return low === undefined && high === undefined ? null : { low, high };
}

/** The inverse of parseFindQuery, as data/address.js writes it. @param {FindQuery} _ */
export function formatFindQuery({ families, filters, sort, show }) {
  const query = new Map();
  if (families) query.set("family", families.join(","));
  for (const [name, filter] of filters) {
    query.set(
      name,
      filter instanceof Set ? [...filter].join(",") : `${filter.low ?? ""}..${filter.high ?? ""}`,
    );
  }
  if (sort.name) query.set("sort", `${sort.down ? "-" : ""}${sort.name}`);
  if (show === "table") query.set("show", "table");
  return query;
}
