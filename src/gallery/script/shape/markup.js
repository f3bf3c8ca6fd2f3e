// Parses SVG markup into a tree of elements. The browser's own parser is not used: pasted text must not reach
// the document, and node has none.

// Comments, sections of characters, instructions, declarations; or a tag, with attributes that may hold ">".
const TOKEN =
  /<!--[\s\S]*?-->|<!\[CDATA\[[\s\S]*?\]\]>|<\?[\s\S]*?\?>|<![^[>]*(?:\[[\s\S]*?\]\s*)?>|<(\/?)([A-Za-z_][\w:.-]*)((?:"[^"]*"|'[^']*'|[^"'>])*)>/g;
const ATTRIBUTE = /([\w:.-]+)\s*=\s*(?:"([^"]*)"|'([^']*)'|([^\s"'/>]+))/g;
const CHARACTERS = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };

/**
 * Parses a text to an element without a name that contains all others: names are in lower case without the prefix
 * of SVG, attributes as written. Unclosed elements end with the text.
 */
export function parseMarkup(text) {
  /** @type {Markup} */ const root = { name: "", attributes: new Map(), children: [], parent: null };
  let within = root;
  for (const [, closes, tag, rest] of text.matchAll(TOKEN)) {
    if (tag === undefined) continue;
    const name = tag.toLowerCase().replace(/^svg:/, "");
    if (closes) within = afterEnd(within, name);
    else {
      /** @type {Markup} */
      const element = { name, attributes: attributesOfTag(rest), children: [], parent: within };
      within.children.push(element);
      if (!/\/\s*$/.test(rest)) within = element;
    }
  }
  return root;
}

/** The element that continues after an end tag; an unmatched end tag is ignored. @param {Markup} within */
function afterEnd(within, name) {
  for (let up = within; up.parent; up = up.parent) if (up.name === name) return up.parent;
  return within;
}

function attributesOfTag(text) {
  /** @type {Query} */ const attributes = new Map();
  for (const [, name, double, single, bare] of text.matchAll(ATTRIBUTE))
    attributes.set(name, withCharacters(double ?? single ?? bare));
  return attributes;
}

function withCharacters(text) {
  return text.replace(/&(?:#x([\da-f]+)|#(\d+)|(\w+));/gi, (all, hex, decimal, word) => {
    const code = hex ? parseInt(hex, 16) : Number(decimal ?? NaN);
    return code <= 0x10ffff ? String.fromCodePoint(code) : (CHARACTERS[word] ?? all);
  });
}
