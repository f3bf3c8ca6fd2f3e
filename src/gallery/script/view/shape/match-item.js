// A result of the search by shape.

import { address } from "../../data/address.js";
import { curveCaption, curveKey } from "../../data/family.js";
import { h } from "../dom.js";
import { formatCaption } from "../labels.js";
import { pinButton } from "../pin-button.js";
import { matchPicture } from "./match-picture.js";

/** The list item of a result of `searchByShape` for a shape with the options of a query (query.js). */
export function matchItem(app, one, shape, { by, part }) {
  const { family, curve, name } = one;
  const caption = curveCaption(family, curve);
  const other = by === "rms" ? "greatest" : "rms";
  const percent = (measure) => `${(100 * one[measure]).toFixed(2)} % ${measure}`;
  const share = part ? `, ${Math.round(100 * (one.to - one.from))} % of the curve` : "";
  return h(
    "li",
    {},
    h(
      "a",
      { href: address([family.id, "curve", curveKey(family, curve)]), "data-name": name },
      matchPicture(one, shape, { width: 220, height: 170 }),
      h("span", { class: "label" }, h("b", {}, percent(by)), ` ${percent(other)}${share}`),
      h("span", { class: "label" }, formatCaption(caption || name)),
    ),
    h(
      "span",
      { class: "acts" },
      h("a", { href: address(["shape"], { like: name }) }, "Find similar"),
      pinButton(app, name, { class: "quiet" }, "Pin", h("span", { class: "visually-hidden" }, ` ${name}`)),
    ),
  );
}
