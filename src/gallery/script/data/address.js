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

/** Parses a fragment into { path: [words], query: Map of names to values }. */
export function parseAddress(fragment) {
  const [path, query] = fragment.replace(/^#?\/?/, "").split("?", 2);
  const word = (text) => {
    try {
      return decodeURIComponent(text);
    } catch {
      return text;
    }
  };
  const words = path.split("/").filter(Boolean).map(word);
  const pairs = (query ?? "")
    .split("&")
    .filter(Boolean)
    .map((pair) => {
      const at = pair.indexOf("=");
      return at < 0 ? [word(pair), ""] : [word(pair.slice(0, at)), word(pair.slice(at + 1))];
    });
  return { path: words, query: new Map(pairs) };
}

/** The fragment for a path and a query (a Map or an object); entries without a value are left out. */
export function address(path, query = {}) {
  const entries = query instanceof Map ? [...query] : Object.entries(query);
  const plain = (text) => encodeURIComponent(text).replaceAll("%3A", ":").replaceAll("%2C", ",");
  const pairs = entries
    .filter(([, value]) => value !== undefined && value !== null && value !== "")
    .map(([name, value]) => `${plain(name)}=${plain(String(value))}`);
  const fragment = `#/${path.map(plain).join("/")}`;
  return pairs.length ? `${fragment}?${pairs.join("&")}` : fragment;
}
