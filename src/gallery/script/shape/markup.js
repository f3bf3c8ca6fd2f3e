// SVG as it is written, as a tree of elements. The page's own parser is not asked: what is pasted never comes
// near the document, and under node there is none.

// Comments, sections of characters, instructions, declarations; or a tag, with attributes that may hold ">".
const PIECE =
  /<!--[\s\S]*?-->|<!\[CDATA\[[\s\S]*?\]\]>|<\?[\s\S]*?\?>|<![^[>]*(?:\[[\s\S]*?\]\s*)?>|<(\/?)([A-Za-z_][\w:.-]*)((?:"[^"]*"|'[^']*'|[^"'>])*)>/g;
const ATTRIBUTE = /([\w:.-]+)\s*=\s*(?:"([^"]*)"|'([^']*)'|([^\s"'/>]+))/g;
const CHARACTERS = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };

/**
 * The elements in a text, [{ name, attributes: Map, children, parent }], within one that has no name: names
 * in small letters and without a prefix for SVG, attributes as they are written. Elements left open end with
 * the text.
 */
export function markupTree(text) {
  const root = { name: "", attributes: new Map(), children: [], parent: null };
  let within = root;
  for (const [, closes, tag, rest] of text.matchAll(PIECE)) {
    if (tag === undefined) continue;
    const name = tag.toLowerCase().replace(/^svg:/, "");
    if (closes) within = afterEnd(within, name);
    else {
      const element = { name, attributes: attributesOfTag(rest), children: [], parent: within };
      within.children.push(element);
      if (!/\/\s*$/.test(rest)) within = element;
    }
  }
  return root;
}

/** The element that goes on after an end tag; one that ends nothing is passed over. */
function afterEnd(within, name) {
  for (let up = within; up.parent; up = up.parent) if (up.name === name) return up.parent;
  return within;
}

function attributesOfTag(text) {
  const pairs = [...text.matchAll(ATTRIBUTE)].map(([, name, double, single, bare]) => [
    name,
    withCharacters(double ?? single ?? bare),
  ]);
  return new Map(pairs);
}

function withCharacters(text) {
  return text.replace(/&(?:#x([\da-f]+)|#(\d+)|(\w+));/gi, (all, hex, decimal, word) => {
    const code = hex ? parseInt(hex, 16) : Number(decimal ?? NaN);
    return code <= 0x10ffff ? String.fromCodePoint(code) : (CHARACTERS[word] ?? all);
  });
}
