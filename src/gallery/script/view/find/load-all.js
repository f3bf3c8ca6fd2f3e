// Says how many curves are not loaded, and offers to load them.

import { fill, h } from "../dom.js";
import { formatBytes, formatCount } from "../footer.js";

/**
 * A line { element, show(state), text(state) } below the count of a search: how many of `state.total` curves
 * are not among its `state.curves`, and a button that calls `load()`. Empty while `state.done` is false, or
 * if all are loaded. `state.bytes` is the size of the data of all.
 */
export function loadAllLine(load) {
  const element = h("p", { class: "load-all toolbar", hidden: true });
  const text = ({ curves, total }) => `${formatCount(total - curves, "curve is", "curves are")} not loaded`;
  const show = (state) => {
    element.hidden = !state?.done || state.curves >= state.total;
    if (element.hidden) return fill(element);
    const { total, bytes } = state;
    const words = `Load all ${formatCount(total, "curve", "curves")} (${formatBytes(bytes)})`;
    const button = h("button", { type: "button", onclick: load }, words);
    return fill(element, h("span", { class: "note" }, text(state)), " ", button);
  };
  return { element, show, text };
}
