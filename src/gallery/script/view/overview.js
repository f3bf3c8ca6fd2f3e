// All families of the atlas, each with its first page.

import { address } from "../data/address.js";
import { fill, h } from "./dom.js";
import { formatCount } from "./footer.js";
import { notAssembledNote } from "./not-assembled.js";
import { onceVisible } from "./once-visible.js";
import { pageThumbnail } from "./page-thumbnail.js";

// From this many families on, there is a search field.
const MANY_FAMILIES = 8;
// Fewer families than this are shown large.
const FEW_FAMILIES = 4;

/** The route of all families; `#/?q=straight` shows those that match the words. */
export const overviewRoute = {
  name: "families",
  label: "Families",
  href: () => address([]),
  matches: ({ path }) => path.length === 0,
  open: (app, { query }) => {
    const { families, title } = app.atlas;
    const tiles = new Map(families.map((family) => [familyTile(family), family]));
    const sight = onceVisible((tile) => showFirstPage(app, tiles.get(tile), tile));
    const list = h("ul", { class: families.length < FEW_FAMILIES ? "families few" : "families" }, [
      ...tiles.keys(),
    ]);
    return {
      title: "",
      element: h(
        "div",
        { class: "view overview" },
        h(
          "div",
          { class: "head" },
          h("div", {}, h("h1", {}, title), h("p", { class: "lede" }, atlasSummary(families))),
          families.length >= MANY_FAMILIES ? familySearch(app, tiles, query.get("q") ?? "") : null,
        ),
        families.length ? list : h("p", { class: "empty" }, "There are no families in this atlas."),
      ),
      shown: () => [...tiles.keys()].forEach((tile) => sight.watch(tile)),
      leave: () => sight.end(),
    };
  },
};

function atlasSummary(families) {
  const sum = (of) => families.reduce((total, family) => total + of(family), 0);
  return `${formatCount(
    sum((f) => f.curves),
    "curve",
    "curves",
  )} of ${formatCount(
    sum((f) => f.kept),
    "linkage",
    "linkages",
  )} on ${formatCount(
    sum((f) => f.pages),
    "page",
    "pages",
  )}`;
}

function familyTile(family) {
  return h(
    "li",
    { class: "tile" },
    h(
      "a",
      { href: address([family.id]) },
      h("span", { class: "tile-picture" }),
      h("span", { class: "name" }, family.title),
    ),
    h("p", { class: "source note" }),
    h("p", { class: "note" }, familyCounts(family)),
    family.not_assembled ? h("p", { class: "note" }, notAssembledNote(family)) : null,
  );
}

/** The counts of a family: curves, pages, and linkages if their number differs from that of the curves. */
export function familyCounts(family) {
  return [
    formatCount(family.curves, "curve", "curves"),
    formatCount(family.pages, "page", "pages"),
    family.kept === family.curves ? null : formatCount(family.kept, "linkage", "linkages"),
  ]
    .filter(Boolean)
    .join(" · ");
}

/** The source of a family, without the legend that its pages append to it. */
export function familySource({ source, legend }) {
  const ending = ` · ${legend}`;
  return legend && source?.endsWith(ending) ? source.slice(0, -ending.length) : (source ?? "");
}

async function showFirstPage(app, { id }, tile) {
  const picture = tile.querySelector(".tile-picture");
  try {
    const family = await app.atlas.family(id);
    picture.style.aspectRatio = `${family.paper.width} / ${family.paper.height}`;
    fill(picture, pageThumbnail(app.atlas, family, 1) ?? "");
    fill(tile.querySelector(".source"), familySource(family));
  } catch (error) {
    fill(tile.querySelector(".source"), h("span", { class: "error" }, error.message));
  }
}

/**
 * A field that shows only the families whose title, linkage or id contains all its words; the address
 * contains them.
 */
function familySearch(app, tiles, query) {
  const total = tiles.size;
  const leave = (text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    let left = 0;
    for (const [tile, { id, title, linkage }] of tiles) {
      const text = `${title} ${id} ${linkage}`.toLowerCase();
      tile.hidden = !words.every((word) => text.includes(word));
      left += tile.hidden ? 0 : 1;
    }
    return left === total ? `All ${total} families` : formatCount(left, "family", "families");
  };
  const seek = (event) => {
    app.announce(leave(event.target.value));
    app.replace(address([], { q: event.target.value.trim() }));
  };
  leave(query);
  return h(
    "div",
    { class: "field" },
    h("input", {
      type: "search",
      value: query,
      "aria-label": "Search families by name",
      placeholder: `Search ${total} families`,
      oninput: seek,
    }),
  );
}
