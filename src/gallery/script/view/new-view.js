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
 * The address of the plate of a four-bar that has been found, on the circuit with its pose.
 * @param {Pick<App, "atlas" | "kernel">} app @param {Pick<FourBarAnswer, "record" | "pose">} answer
 */
export async function fourBarAddress({ atlas, kernel }, { record: { parameters }, pose }) {
  const [ox, oy, cx, cy, ax, ay, bx, by] = pose;
  const side = (cx - ax) * (by - ay) < (cy - ay) * (bx - ax) ? -1 : 1;
  const turned = Math.atan2(ay - oy, ax - ox) - Math.atan2(cy - oy, cx - ox);
  const family = await atlas.family("new/four-bar");
  const loaded = await kernel.load();
  const curve = loaded.curve(family, 0, Object.entries(parameters));
  const study = loaded.study(curve, { shown: 0, isRough: true });
  const { circuits } = study.answer;
  study.close();
  const has = (/** @type {Pass} */ { from, to, sides }) => {
    const beyond = (turned * 180) / Math.PI - Math.min(from, to);
    return sides[0] === side && beyond - 360 * Math.floor(beyond / 360) <= Math.abs(to - from);
  };
  const circuit = circuits.findIndex(({ passes }) => passes.some(has)) + 1;
  return newAddress("four-bar", { ...parameters, circuit: circuit > 1 ? circuit : null });
}
