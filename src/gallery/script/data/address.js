// Addresses of the gallery's views: every view has one, in the fragment of the page's URL, so that it can be
// linked to.
//
//   #/                                     all families
//   #/evans                                the pages of a family
//   #/evans/3?curve=12.1.1                 a page, with a highlighted curve
//   #/evans/curve/12.1.1?p=2.5             the plate of a curve (cell.trace.circuit); with changed parameters
//   #/find?family=evans&mu_min_deg=30..    the curves that pass the filters
//   #/shape?d=…                            the curves similar to a shape
//   #/compare?c=evans:12.1.1,watt:3.1.1    curves compared

/** Parses a fragment. @returns {Target} */
export function parseAddress(fragment) {
  const [path, query = ""] = fragment.replace(/^#?\/?/, "").split("?", 2);
  return { path: path.split("/").filter(Boolean).map(decodedWord), query: new Map(queryPairs(query)) };
}

function decodedWord(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** @param {string} query @returns {[string, string][]} */
function queryPairs(query) {
  const pairs = query.split("&").filter(Boolean);
  return pairs.map((pair) => {
    const at = pair.indexOf("=");
    return at < 0
      ? [decodedWord(pair), ""]
      : [decodedWord(pair.slice(0, at)), decodedWord(pair.slice(at + 1))];
  });
}

/**
 * Parses the name of a curve, "evans:12.1.1?p=2.5&k=2", as in the program's `export`; null if it is not a name.
 * The change "circuit" selects a circuit by its number among all circuits of the linkage; an atlas of one
 * circuit for each cell does not contain the others.
 */
export function parseCurveName(/** @type {string} */ name) {
  const found = /^([^:?]+):(\d+\.\d+\.\d+)(?:\?(.*))?$/.exec(name);
  if (!found) return null;
  const [, family, key, query = ""] = found;
  /** @type {Map<string, number>} */
  const changes = new Map(queryPairs(query).map(([word, value]) => [word, Number(value)]));
  return { family, key, changes };
}

/**
 * The fragment for a path and a query (a Map or an object); entries without a value are left out.
 * @param {(string | number)[]} path @param {Map<string, unknown> | Record<string, unknown>} [query]
 */
export function address(path, query = {}) {
  const entries = query instanceof Map ? [...query] : Object.entries(query);
  const plain = (text) => encodeURIComponent(text).replaceAll("%3A", ":").replaceAll("%2C", ",");
  const pairs = entries
    .filter(([, value]) => value !== undefined && value !== null && value !== "")
    .map(([name, value]) => `${plain(name)}=${plain(String(value))}`);
  const fragment = `#/${path.map(plain).join("/")}`;
  return pairs.length ? `${fragment}?${pairs.join("&")}` : fragment;
}

/**
 * Whether an address matches the route of a word, `#/find?…`. A family with that id keeps the addresses below
 * it, and the word itself if the query has only names of the family's view.
 */
export function matchesRoute(word, /** @type {Target} */ { path, query }, /** @type {App} */ { atlas }) {
  if (path.length !== 1 || path[0] !== word) return false;
  return !isFamily(atlas, word) || !isFamilyQuery(query);
}

/** The address of a route with a query, which is never empty if a family has the same id. */
export function routeAddress(word, /** @type {Query | Record<string, unknown>} */ query, { atlas }) {
  const short = address([word], query);
  const isTaken = !short.includes("?") && isFamily(atlas, word);
  return isTaken ? address([word], { show: "room" }) : short;
}

function isFamily(/** @type {Atlas} */ { families }, word) {
  return families.some(({ id }) => id === word);
}

function isFamilyQuery(/** @type {Query} */ query) {
  return query.size === 0 || query.has("page") || query.has("curve") || query.get("show") === "curves";
}
