// The list of the linkages that a plate can begin with.

import { matchesRoute, newAddress, routeAddress } from "../data/address.js";
import { h } from "./dom.js";

/** The route `#/new`. */
export const newRoute = {
  name: "new",
  label: "New",
  href: (app) => routeAddress("new", {}, app),
  matches: (target, app) => matchesRoute("new", target, app),
  open: async (/** @type {App} */ app) => {
    const linkages = await app.atlas.linkages();
    const item = ({ id, legend }) => h("li", h("a", { href: newAddress(id) }, id), h("p.note", legend));
    const lede = "A plate of a linkage of the catalogue, or of one of this atlas, with values to begin with";
    const heading = h("div", h("h1", "New"), h("p.lede", lede));
    return {
      title: "New",
      element: h("div.view.new-view", h("div.head", heading), h("ul.linkages", linkages.map(item))),
    };
  },
};
