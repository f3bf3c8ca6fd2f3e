// A family: its description, and its pages or curves as a grid of thumbnails.

import { address } from "../data/address.js";
import { curveCaption, curveKey } from "../data/family.js";
import { isFullyLoaded, isScattered, needCurveWithKey, needCurves, needPage } from "../data/needs.js";
import { fill, h } from "./dom.js";
import { familyCounts, familySource } from "./overview.js";
import { pageLabel } from "./page-cells.js";
import { pageField } from "./page-field.js";
import { formatCaption } from "./labels.js";
import { notAssembledSummary } from "./not-assembled.js";
import { TileWindow } from "./tile-window.js";
import { formatBytes } from "./footer.js";
import { pageThumbnail } from "./page-thumbnail.js";
import { thumbnail } from "./thumbnail.js";

/**
 * The route of a family: `#/evans` its pages, `#/evans?show=curves` its curves; `?page=3` scrolls to that
 * page's tile.
 */
export const familyRoute = {
  name: "sheet",
  parent: "families",
  matches: ({ path }, app) => path.length === 1 && app.atlas.families.some(({ id }) => id === path[0]),
  open: async (app, { path: [id], query }) => {
    const family = await app.atlas.family(id);
    const listed = app.atlas.families.find((candidate) => candidate.id === id);
    // Pages are shown if they are written as files, or their layouts are in the data.
    const hasPages = listed.pages > 0 && (listed.page_format !== null || family.pageCount > 0);
    const hasCurves = query.get("show") === "curves" || !hasPages;
    const tiles = hasCurves ? curveTiles(app, family) : pageTiles(app, family, listed);
    const goal = hasCurves
      ? await needCurveWithKey(family, query.get("curve"))
      : Number(query.get("page")) - 1;
    if (goal >= 0) tiles.element.dataset.goal = goal;
    return {
      title: family.title,
      element: h(
        "div",
        { class: "view wide family-view" },
        familyHeader(family, listed),
        familyToolbar(family, listed, { hasCurves, hasPages }),
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

function familyHeader(family, listed) {
  return h(
    "div",
    { class: "head" },
    h(
      "div",
      {},
      h("h1", {}, family.title),
      h("p", { class: "lede" }, familySource(family)),
      family.legend ? h("p", { class: "lede" }, family.legend) : null,
      h(
        "p",
        { class: "note" },
        [
          familyCounts(listed),
          `linkage ${family.linkage}`,
          samplingLabel(family.sampling),
          formatBytes(listed.bytes),
        ].join(" · "),
      ),
      notAssembledSummary(family, listed),
    ),
  );
}

function samplingLabel({ step, samples, spacing }) {
  if (step !== undefined) return `a sample every ${step}° of input`;
  return `${samples} samples per circuit${spacing ? `, ${spacing} spacing` : ""}`;
}

function familyToolbar(family, listed, { hasCurves, hasPages }) {
  const way = (label, query, isHere) =>
    h(
      "a",
      { class: "button", href: address([family.id], query), "aria-current": isHere ? "true" : null },
      label,
    );
  return h(
    "div",
    { class: "toolbar no-print" },
    h(
      "div",
      { class: "segments", role: "group", "aria-label": "Show" },
      hasPages ? way("Pages", {}, !hasCurves) : null,
      way("Curves", { show: "curves" }, hasCurves),
    ),
    h("a", { class: "button", href: address(["find"], { family: family.id }) }, "Find curves"),
    listed.pages > 1 && !hasCurves ? pageJump(family, listed) : null,
  );
}

function pageJump(family, listed) {
  const go = (page) => {
    window.location.hash = address([family.id, page]);
  };
  return h("div", { class: "end" }, pageField(listed, "Go to page", go).element);
}

function pageTiles(app, family, listed) {
  const { width, height } = family.paper;
  return new TileWindow({
    count: listed.pages,
    least: listed.pages < 4 ? 340 : 230,
    gap: 20,
    aspect: height / width,
    below: 44,
    label: "Pages",
    tile: (k) =>
      h(
        "li",
        {},
        h(
          "a",
          { href: address([family.id, k + 1]) },
          h("span", { class: "tile-picture" }),
          h(
            "span",
            { class: "label" },
            h("span", { class: "visually-hidden" }, "Page "),
            h("b", {}, `${k + 1}`),
            " ",
            h("span", { class: "page-caption" }),
          ),
        ),
      ),
    need: (k) => (isScattered(family) ? null : needPage(family, k + 1)),
    isLoaded: () => isFullyLoaded(family),
    fillTile: (element, k) => {
      if (!isScattered(family))
        fill(element.querySelector(".page-caption"), formatCaption(pageLabel(family, k + 1)));
    },
    draw: (element, k) => {
      element.querySelector(".tile-picture").append(pageThumbnail(app.atlas, family, k + 1) ?? "");
    },
    failed: (message) => app.announce(message),
  });
}

function curveTiles(app, family) {
  const { count } = family.curves;
  const tiles = new TileWindow({
    count,
    least: 132,
    gap: 16,
    aspect: 0.75,
    below: 40,
    label: "Curves",
    tile: () =>
      h(
        "li",
        {},
        // A link without an address cannot have the focus.
        h(
          "a",
          { tabindex: "0" },
          h("span", { class: "tile-picture" }),
          h("span", { class: "label" }, h("span", { class: "visually-hidden" }, "Loading")),
        ),
      ),
    need: (k) => needCurves(family, [k]),
    isLoaded: () => isFullyLoaded(family),
    fillTile: (element, k) => {
      const link = element.querySelector("a");
      link.setAttribute("href", address([family.id, "curve", curveKey(family, k)]));
      link.removeAttribute("tabindex");
      const caption = formatCaption(curveCaption(family, k));
      fill(element.querySelector(".label"), h("b", {}, curveKey(family, k)), " ", caption);
    },
    failed: (message) => app.announce(message),
    draw: (element, k) => {
      const picture = element.querySelector(".tile-picture");
      picture.append(thumbnail(family, [k], tiles.sizeOfPicture(picture)));
    },
  });
  return tiles;
}
