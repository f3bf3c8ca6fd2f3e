// The list of the linkages that a plate can begin with.

import { matchesRoute, newAddress, routeAddress } from "../data/address.js";
import { h } from "./dom.js";

/** The route `#/new`. @type {Route} */
export const newRoute = {
  name: "new",
  label: "New",
  href: (app) => routeAddress("new", {}, app),
  matches: (target, app) => matchesRoute("new", target, app),
  open: async (/** @type {App} */ app) => {
    const linkages = await app.atlas.linkages();
    const item = (/** @type {NewLinkage} */ { id, legend }) =>
      h("li", h("a", { href: newAddress(id) }, id), h("p.note", legend));
    const lede = "A plate of a linkage of the catalogue, or of one of this atlas, with values to begin with";
    const heading = h("div", h("h1", "New"), h("p.lede", lede));
    return {
      title: "New",
      element: h("div.view.new-view", h("div.head", heading), h("ul.linkages", linkages.map(item))),
    };
  },
};

/**
 * The address of the plate of a four-bar that has been found, on its circuit; of one whose crank does not turn fully, on the first.
 * @param {Pick<FourBarAnswer, "record" | "pose">} _
 */
export function fourBarAddress({ record: { parameters, class: kind }, pose: [, , cx, cy, ax, ay, bx, by] }) {
  const isRight = (cx - ax) * (by - ay) < (cy - ay) * (bx - ax);
  const turns = kind === "crank-rocker" || kind === "drag-link";
  return newAddress("four-bar", { ...parameters, circuit: turns && isRight ? 2 : null });
}
