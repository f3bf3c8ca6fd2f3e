// All families of the atlas.

import { address } from "../data/address.js";
import { h } from "./dom.js";

/** The room with all families. */
export const overviewRoom = {
  name: "families",
  label: "Families",
  way: () => address([]),
  opens: () => true,
  view: (app) => ({
    title: "",
    element: h("ul", { class: "families" }, app.atlas.families.map((family) => h(
      "li",
      {},
      h("a", { href: address([family.id]) }, family.title),
      ` ${family.curves} curves on ${family.pages} pages`,
    ))),
  }),
};
