// Addresses: everything that can be looked at has one, in the fragment of the page's own, so that a link
// can be sent.
//
//   #/                                     all families
//   #/evans                                the pages of a family
//   #/evans/3?curve=12.1.1                 a page, and a curve that is brought forward on it
//   #/evans/curve/12.1.1?p=2.5             the plate of a curve (cell.trace.circuit); with other parameters
//   #/find?family=evans&mu_min_deg=30..    what the filters leave
//   #/shape?d=…                            what is like a shape
//   #/compare?c=evans:12.1.1,watt:3.1.1    curves side by side

/** What a fragment says: { path: [words], query: Map of words }. */
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

/** The fragment of a path and, of a query (a Map or an object), what has a value. */
export function address(path, query = {}) {
  const entries = query instanceof Map ? [...query] : Object.entries(query);
  const plain = (text) => encodeURIComponent(text).replaceAll("%3A", ":").replaceAll("%2C", ",");
  const pairs = entries
    .filter(([, value]) => value !== undefined && value !== null && value !== "")
    .map(([name, value]) => `${plain(name)}=${plain(String(value))}`);
  const fragment = `#/${path.map(plain).join("/")}`;
  return pairs.length ? `${fragment}?${pairs.join("&")}` : fragment;
}
