// All families of the atlas, each with its first page.

import { address } from "../data/address.js";
import { sumOf } from "../data/number.js";
import { elementIn, fill, h } from "./dom.js";
import { notAssembledNote } from "./not-assembled.js";
import { pageThumbnail } from "./thumbnail.js";
import { formatCount } from "./labels.js";

// From this many families on, there is a search field.
const MANY_FAMILIES = 8;
// Fewer families than this are shown large.
const FEW_FAMILIES = 4;

/** The route of all families; `#/?q=straight` shows those that match the words. @type {Route} */
export const overviewRoute = {
  name: "families",
  label: "Families",
  href: () => address([]),
  matches: ({ path }) => path.length === 0,
  open: (app, { query }) => {
    const { families, title, paper } = app.atlas;
    /** @type {Map<HTMLElement, ListedFamily>} */
    const tiles = new Map(families.map((family) => [familyTile(family, paper), family]));
    // Each is drawn when it comes within half a window height of the window.
    const seen = (/** @type {IntersectionObserverEntry[]} */ entries) => {
      for (const { target } of entries.filter(({ isIntersecting }) => isIntersecting)) {
        sight.unobserve(target);
        const tile = /** @type {HTMLElement} */ (target);
        showFirstPage(app, tile, tiles.get(tile)?.id ?? "");
      }
    };
    const sight = new IntersectionObserver(seen, { rootMargin: "50% 0px" });
    const list = h(families.length < FEW_FAMILIES ? "ul.families.few" : "ul.families", [...tiles.keys()]);
    const hasSearch = families.length >= MANY_FAMILIES;
    const heading = h("div", h("h1", title), h("p.lede", atlasSummary(families)));
    return {
      title: "",
      element: h(
        "div.view.overview",
        h("div.head", heading, hasSearch ? familySearch(app, tiles, query.get("q") ?? "") : null),
        families.length ? list : h("p.empty", "There are no families in this atlas."),
      ),
      shown: () => [...tiles.keys()].forEach((tile) => sight.observe(tile)),
      leave: () => sight.disconnect(),
    };
  },
};

function atlasSummary(/** @type {ListedFamily[]} */ families) {
  const [curves, kept] = [sumOf(families, (one) => one.curves), sumOf(families, (one) => one.kept)];
  const pages = sumOf(families, (one) => one.pages);
  return `${formatCount(curves, "curve")} of ${formatCount(kept, "linkage")} on ${formatCount(pages, "page")}`;
}

/** @param {ListedFamily} family @param {Size} _ */
function familyTile(family, { width, height }) {
  // All that has a size is there at once: a press is no click if what is under it moves.
  const picture = h("span.tile-picture");
  picture.style.aspectRatio = `${width} / ${height}`;
  return h(
    "li.tile",
    h("a", { href: address([family.id]) }, picture, h("span.name", family.title)),
    h("p.source.note", family.source),
    h("p.note", familyCounts(family)),
    family.not_assembled ? h("p.note", notAssembledNote(family)) : null,
  );
}

/** The counts of a family: curves, pages, and linkages if their number differs from that of the curves. */
export function familyCounts(/** @type {ListedFamily} */ family) {
  const counts = [formatCount(family.curves, "curve"), formatCount(family.pages, "page")];
  if (family.kept !== family.curves) counts.push(formatCount(family.kept, "linkage"));
  return counts.join(" · ");
}

/** @param {App} app @param {HTMLElement} tile @param {string} id */
async function showFirstPage(app, tile, id) {
  const picture = elementIn(tile, ".tile-picture");
  try {
    const family = await app.atlas.family(id);
    fill(picture, pageThumbnail(app.atlas, family, 1) ?? "");
  } catch (error) {
    fill(elementIn(tile, ".source"), h("span.error", error.message));
  }
}

/**
 * A field that shows only the families whose title, linkage or id contains all its words; the address contains them.
 * @param {App} app @param {Map<HTMLElement, ListedFamily>} tiles @param {string} query
 */
function familySearch(app, tiles, query) {
  const total = tiles.size;
  const leave = (/** @type {string} */ text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    let left = 0;
    for (const [tile, { id, title, linkage }] of tiles) {
      const text = `${title} ${id} ${linkage}`.toLowerCase();
      tile.hidden = !words.every((word) => text.includes(word));
      left += tile.hidden ? 0 : 1;
    }
    return left === total ? `All ${total} families` : formatCount(left, "family", "families");
  };
  const seek = (/** @type {Heard<Event, HTMLInputElement>} */ { target }) => {
    app.announce(leave(target.value));
    app.replace(address([], { q: target.value.trim() }));
  };
  leave(query);
  const attributes = { type: "search", value: query, "aria-label": "Search families by name", oninput: seek };
  return h("div.field", h("input", { ...attributes, placeholder: `Search ${total} families` }));
}
