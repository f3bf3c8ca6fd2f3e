// The results as a grid of thumbnails.

import { address } from "../../data/address.js";
import { curveCaption, curveKey } from "../../data/family.js";
import { isFullyLoaded, needCurves } from "../../data/needs.js";
import { fill, h } from "../dom.js";
import { formatCaption } from "../labels.js";
import { pointLabel } from "../page-panel.js";
import { watchPins } from "../pin-button.js";
import { TileWindow } from "../tile-window.js";
import { thumbnail } from "../thumbnail.js";
import { pinOnKey, curvePinButton } from "./curve-pin.js";

/**
 * Tiles for rows of a table, in a given order; `valueOf(row)` is the text of the value they are sorted by, or
 * null.
 */
export class ResultTiles extends TileWindow {
  constructor(app) {
    super({ count: 0, least: 150, gap: 12, aspect: 0.8, below: 58, label: "Curves" });
    Object.assign(this, { app, rows: [], table: null, valueOf: () => null });
    this.element.classList.add("results");
    this.element.addEventListener("keydown", pinOnKey);
    this.unwatch = watchPins(app, this.element);
  }

  end() {
    super.end();
    this.unwatch();
    [this.rows, this.table, this.valueOf] = [[], null, () => null];
  }

  /** Replaces the rows shown. */
  setRows(table, rows, valueOf) {
    Object.assign(this, { table, rows, valueOf, count: rows.length });
    for (const element of this.there.values()) element.remove();
    this.there.clear();
    this.queue = [];
    if (this.element.isConnected) this.measure();
  }

  tile(k) {
    const { app, table } = this;
    const row = this.rows[k];
    const family = table.families[table.family[row]];
    const curve = table.curve[row];
    const name = table.nameOf(row);
    return h(
      "li",
      {},
      h(
        "a",
        { href: address([family.id, "curve", curveKey(family, curve)]), "data-name": name },
        h("span", { class: "tile-picture" }),
        h("span", { class: "label" }),
      ),
      curvePinButton(app, name),
    );
  }

  need(k) {
    const [family, curve] = this.curveOf(k);
    return needCurves(family, [curve]);
  }

  isLoaded() {
    return !this.table || this.table.families.every(isFullyLoaded);
  }

  fillTile(element, k) {
    const [family, curve] = this.curveOf(k);
    const value = this.valueOf(this.rows[k]);
    const caption = curveCaption(family, curve) || this.table.nameOf(this.rows[k]);
    const circuit = family.curves.circuit[curve];
    const which = [pointLabel(family, curve), circuit > 1 ? `circuit ${circuit}` : ""];
    fill(
      element.querySelector(".label"),
      value ? [h("b", {}, value), " "] : null,
      formatCaption([...which, caption].filter(Boolean).join(" · ")),
    );
  }

  failed(message) {
    this.app.announce(message);
  }

  /** The family and the index of the curve of a tile. */
  curveOf(k) {
    const { table } = this;
    const row = this.rows[k];
    return [table.families[table.family[row]], table.curve[row]];
  }

  draw(element, k) {
    const [family, curve] = this.curveOf(k);
    const picture = element.querySelector(".tile-picture");
    picture.replaceChildren(thumbnail(family, [curve], this.sizeOfPicture(picture)));
  }
}
