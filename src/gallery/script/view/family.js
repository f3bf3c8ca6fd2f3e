// A family: its description, and its pages or curves as a grid of thumbnails.

import { address, curveAddress } from "../data/address.js";
import { listedFamily } from "../data/atlas.js";
import { curveCaption, curveKey } from "../data/family.js";
import { isFullyLoaded, isScattered, needCurveWithKey, needCurves, needPage } from "../data/needs.js";
import { elementIn, fill, h } from "./dom.js";
import { familyCounts } from "./overview.js";
import { formatCaption, formatBytes } from "./labels.js";
import { notAssembledSummary } from "./not-assembled.js";
import { TileWindow } from "./tile-window.js";
import { pageThumbnail, thumbnail } from "./thumbnail.js";
import { pageField } from "./page-bar.js";
import { pageLabel } from "./page-panel.js";

/** The route of a family: `#/evans` its pages, `#/evans?show=curves` its curves; `?page=3` scrolls to that page's tile. @type {Route} */
export const familyRoute = {
  name: "sheet",
  parent: "families",
  matches: ({ path }, app) => path.length === 1 && app.atlas.families.some(({ id }) => id === path[0]),
  open: async (app, { path: [id], query }) => {
    const family = await app.atlas.family(id);
    const listed = listedFamily(app.atlas, id);
    // Pages are shown if they are written as files, or their layouts are in the data.
    const hasPages = listed.pages > 0 && (listed.page_format !== null || family.pageCount > 0);
    const hasCurves = query.word("show", ["curves", "pages"]) === "curves" || !hasPages;
    const tiles = hasCurves ? curveTiles(app, family) : pageTiles(app, family, listed);
    const [page = 0, key] = [query.number("page", 1), query.get("curve")];
    const found = hasCurves ? await needCurveWithKey(family, key) : page - 1;
    if (found === undefined && key !== undefined) query.ignore("curve", "there is no such curve");
    const goal = found ?? -1;
    if (goal >= 0) tiles.element.dataset.goal = String(goal);
    return {
      title: family.title,
      element: h(
        "div.view.wide.family-view",
        familyHeader(family, listed),
        familyToolbar(app, family, listed, { hasCurves, hasPages }),
        tiles.element,
      ),
      shown: () => {
        tiles.shown();
        if (goal >= 0) tiles.show(goal);
      },
      leave: () => tiles.end(),
    };
  },
};

function familyHeader(/** @type {Family} */ family, /** @type {ListedFamily} */ listed) {
  const { linkage, sampling } = family;
  const facts = [
    familyCounts(listed),
    `linkage ${linkage}`,
    samplingLabel(sampling),
    formatBytes(listed.bytes),
  ];
  const parts = [
    h("h1", family.title),
    h("p.lede", family.source),
    family.legend ? h("p.lede", family.legend) : null,
    h("p.note", facts.join(" · ")),
    notAssembledSummary(family, listed),
  ];
  return h("div.head", h("div", parts));
}

function samplingLabel(/** @type {Family["sampling"]} */ { step, samples, spacing }) {
  if (step !== undefined) return `a sample every ${step}° of input`;
  return `${samples} samples per circuit${spacing ? `, ${spacing} spacing` : ""}`;
}

/** @param {App} app @param {Family} family @param {ListedFamily} listed @param {Record<"hasCurves" | "hasPages", boolean>} _ */
function familyToolbar(app, family, listed, { hasCurves, hasPages }) {
  /** @param {string} label @param {Record<string, string>} query @param {boolean} isHere */
  const way = (label, query, isHere) =>
    h("a.button", { href: address([family.id], query), "aria-current": isHere ? "true" : null }, label);
  const go = (/** @type {number} */ page) => app.go(address([family.id, page]));
  const ways = [hasPages ? way("Pages", {}, !hasCurves) : null, way("Curves", { show: "curves" }, hasCurves)];
  return h(
    "div.toolbar.no-print",
    h("div.segments", { role: "group", "aria-label": "Show" }, ways),
    h("a.button", { href: address(["find"], { family: family.id }) }, "Find curves"),
    listed.pages > 1 && !hasCurves ? h("div.end", pageField(listed, "Go to page", go).element) : null,
  );
}

function pageTiles(/** @type {App} */ app, /** @type {Family} */ family, /** @type {ListedFamily} */ listed) {
  const { width, height } = family.paper;
  return new TileWindow({
    count: listed.pages,
    least: listed.pages < 4 ? 340 : 230,
    gap: 20,
    aspect: height / width,
    below: 44,
    label: "Pages",
    tile: (k) => {
      const words = [h("span.visually-hidden", "Page "), h("b", `${k + 1}`), " ", h("span.page-caption")];
      const parts = [h("span.tile-picture"), h("span.label", words)];
      const link = h("a", { href: address([family.id, k + 1]) }, parts);
      return h("li", link);
    },
    need: (k) => (isScattered(family) ? null : needPage(family, k + 1)),
    isLoaded: () => isFullyLoaded(family),
    fillTile: (element, k) => {
      if (!isScattered(family))
        fill(elementIn(element, ".page-caption"), formatCaption(pageLabel(family, k + 1)));
    },
    draw: (element, k) => {
      elementIn(element, ".tile-picture").append(pageThumbnail(app.atlas, family, k + 1) ?? "");
    },
    failed: (message) => app.announce(message),
  });
}

function curveTiles(/** @type {App} */ app, /** @type {Family} */ family) {
  const { count } = family.curves;
  const tiles = new TileWindow({
    count,
    least: 132,
    gap: 16,
    aspect: 0.75,
    below: 40,
    label: "Curves",
    tile: () => {
      const label = h("span.label", h("span.visually-hidden", "Loading"));
      // A link without an address cannot have the focus.
      return h("li", h("a", { tabindex: "0" }, h("span.tile-picture"), label));
    },
    need: (k) => needCurves(family, [k]),
    isLoaded: () => isFullyLoaded(family),
    fillTile: (element, k) => {
      const link = elementIn(element, "a");
      link.setAttribute("href", curveAddress(family.id, curveKey(family, k)));
      link.removeAttribute("tabindex");
      const caption = formatCaption(curveCaption(family, k));
      fill(elementIn(element, ".label"), h("b", curveKey(family, k)), " ", caption);
    },
    failed: (message) => app.announce(message),
    draw: (element, k) => {
      elementIn(element, ".tile-picture").append(thumbnail(family, [k], tiles.pictureSize));
    },
  });
  return tiles;
}
