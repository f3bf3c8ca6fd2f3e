// Addresses of the gallery's views: every view has one, in the fragment of the page's URL, so that it can be
// linked to.
//
//   #/                                     all families   #/evans                                the pages of a family
//   #/evans/3?curve=12.1.1                 a page, with a highlighted curve
//   #/evans/curve/12.1.1?p=2.5             the plate of a curve (cell.trace.circuit); with changed parameters
//   #/find?family=evans&mu_min_deg=30..    the curves that pass the filters   #/shape?d=…                            the curves similar to a shape
//   #/compare?c=evans:12.1.1,watt:3.1.1    curves compared   #/new                                  the linkages that plates begin with
//   #/new/four-bar?crank=1.2               the plate of one, which is in no family

// What the address of a plate says of more than changed parameters, by these names.
const PLATE_WORDS = ["circuit", "show", "joint", "graph", "rpm", "load", "lock", "at"];

// The first curve of a family, of which the plate of a linkage in no atlas has the short address.
const FIRST_KEY = "1.1.1";

/** Parses a fragment, also one that a mail program has encoded once more, or a value of which has lost its escapes. @returns {Target} */
export function parseAddress(/** @type {string} */ fragment) {
  const plain = fragment.includes("?") ? fragment : decodedWord(fragment.replace(/%(?!3F|26|3D)/gi, "%25"));
  const [, path, words = ""] = /^#?\/?([^?]*)\??(.*)$/s.exec(plain) ?? [];
  // The changes of compared curves, "c=evans:1.1.1?p=2&k=3".
  const lost = /\?.*?(?=&(?:view|align)=|$)/s;
  const query = words.replace(lost, (text) => text.replace(/[?&=]/g, (sign) => encodeURIComponent(sign)));
  return {
    path: path.split("/").filter(Boolean).map(decodedWord),
    query: new AddressQuery(queryPairs(query)),
  };
}

function decodedWord(/** @type {string} */ text) {
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
 * Parses the name of a curve, "evans:12.1.1?p=2.5&k=2", as in the program's `export`; null if it is not a name. The change "circuit"
 * selects a circuit by its number among all circuits of the linkage; an atlas of one circuit for each cell does not contain the others.
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
  /** @param {string | number} text */
  const plain = (text) => encodeURIComponent(text).replaceAll("%3A", ":").replaceAll("%2C", ",");
  const pairs = entries
    .filter(([, value]) => value !== undefined && value !== null && value !== "")
    .map(([name, value]) => `${plain(name)}=${plain(String(value))}`);
  // The id of a linkage's family, "new/four-bar", is two words of a path.
  const fragment = `#/${path.map(plain).join("/").replaceAll("%2F", "/")}`;
  return pairs.length ? `${fragment}?${pairs.join("&")}` : fragment;
}

/** The linkage of a family that is in no atlas, "new/four-bar"; null if an id is that of another. */
export function newLinkage(/** @type {string} */ id) {
  return id.startsWith("new/") ? id.slice(4) : null;
}

/** The name of a parameter in the address of a plate; one that is a word of plates has the prefix of Find, "p.at". */
export function parameterWord(/** @type {string} */ name) {
  return PLATE_WORDS.includes(name) ? `p.${name}` : name;
}

/**
 * The address of the plate of a linkage with values by their names, in no family: `#/new/four-bar?crank=1.2`.
 * @param {string} linkage @param {Map<string, unknown> | Record<string, unknown>} [values]
 */
export function newAddress(linkage, values) {
  return address(["new", linkage], values);
}

/** The family and the key of the curve of a plate; null if a path is that of no plate. @param {string[]} path */
export function curveOfPath(path) {
  const isNew = path[0] === "new" && path.length % 2 === 0 && !/^[0-9]+$/.test(path[1]);
  const [id, word, key] = isNew ? [`new/${path[1]}`, ...path.slice(2)] : path;
  if (isNew && path.length === 2) return { id, key: FIRST_KEY };
  return word === "curve" && path.length === (isNew ? 4 : 3) ? { id, key } : null;
}

/** The address of the plate of a curve. @param {Map<string, unknown> | Record<string, unknown>} [query] */
export function curveAddress(/** @type {string} */ id, /** @type {string} */ key, query) {
  const isShort = newLinkage(id) !== null && key === FIRST_KEY;
  return address(isShort ? [id] : [id, "curve", key], query);
}

/**
 * Whether an address matches the route of a word, `#/find?…`. A family with that id keeps the addresses below
 * it, and the word itself if the query has only names of the family's view.
 * @param {string} word
 */
export function matchesRoute(word, /** @type {Target} */ { path, query }, /** @type {App} */ { atlas }) {
  if (path.length !== 1 || path[0] !== word) return false;
  const isOfFamily =
    query.size === 0 || query.has("page") || query.has("curve") || query.get("show") === "curves";
  return !isFamily(atlas, word) || !isOfFamily;
}

/**
 * The address of a route with a query, which is never empty if a family has the same id.
 * @param {string} word @param {Map<string, unknown> | Record<string, unknown>} query @param {Pick<App, "atlas">} _
 */
export function routeAddress(word, query, { atlas }) {
  const short = address([word], query);
  const isTaken = !short.includes("?") && isFamily(atlas, word);
  return isTaken ? address([word], { show: "room" }) : short;
}

function isFamily(/** @type {Atlas} */ { families }, /** @type {string} */ word) {
  return families.some(({ id }) => id === word);
}

/** Words by their names. A name that no view reads is ignored, and so is a value that one cannot use. @extends {Map<string, string>} */
export class AddressQuery extends Map {
  /** @type {Set<string>} */ read = new Set();
  /** Why values are ignored, by their names. @type {Map<string, string>} */ wrong = new Map();
  /** Is called when a value is ignored. @type {() => void} */ onignore = () => {};

  get(/** @type {string} */ name) {
    this.read.add(name);
    return super.get(name);
  }

  /** A value is ignored, for a reason. */
  ignore(/** @type {string} */ name, /** @type {string} */ why) {
    this.wrong.set(name, why);
    this.onignore();
  }

  /** A finite number from `least` on; undefined if there is none. @returns {number | undefined} */
  number(/** @type {string} */ name, least = -Infinity) {
    const word = this.get(name);
    if (word === undefined) return undefined;
    const value = word.trim() === "" ? NaN : Number(word);
    if (Number.isFinite(value) && value >= least) return value;
    this.ignore(name, Number.isFinite(value) ? `less than ${least}` : "not a number");
    return undefined;
  }

  /** One of some words; undefined if there is none. */
  word(/** @type {string} */ name, /** @type {string[]} */ words) {
    return this.list(name, (word) => words.includes(word))?.[0];
  }

  /** A list of words, those that are usable; undefined if there is none. */
  list(/** @type {string} */ name, isUsable = (/** @type {string} */ _) => true) {
    const words = this.get(name)?.split(",").filter(Boolean);
    const wrong = words?.filter((word) => !isUsable(word)) ?? [];
    if (wrong.length) this.ignore(name, `there is no “${wrong.join(", ")}”`);
    return words?.filter(isUsable);
  }

  /** What is ignored, in a sentence; empty if nothing is. */
  get ignored() {
    const reasons = [...this].map(([name, value]) => {
      const why = this.wrong.get(name) ?? (this.read.has(name) ? null : "unknown");
      return why && `${name}${value ? `=${value.slice(0, 40)}` : ""} (${why})`;
    });
    const words = reasons.filter(Boolean);
    return words.length ? `Ignored in the address: ${words.join("; ")}` : "";
  }
}
