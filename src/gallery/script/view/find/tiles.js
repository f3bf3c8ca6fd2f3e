// The results as a grid of thumbnails.

import { curveAddress } from "../../data/address.js";
import { curveCaption, curveKey } from "../../data/family.js";
import { isFullyLoaded, needCurves } from "../../data/needs.js";
import { elementIn, fill, h } from "../dom.js";
import { formatCaption } from "../labels.js";
import { pointLabel } from "../page-panel.js";
import { TileWindow } from "../tile-window.js";
import { thumbnail } from "../thumbnail.js";
import { watchPins, pinOnKey, curvePinButton } from "../pins.js";

/** Tiles for rows of a table, in a given order; `valueOf(row)` is the text of the value they are sorted by, or null. */
export class ResultTiles extends TileWindow {
  /** @type {Uint32Array | number[]} */ rows = [];
  /** @type {CurveTable | null} */ table = null;
  /** @type {(row: number) => string | null | undefined} */ valueOf = () => null;

  constructor(/** @type {App} */ app) {
    const size = { count: 0, least: 150, gap: 12, aspect: 0.8, below: 58, label: "Curves" };
    super({
      ...size,
      tile: (k) => this.tile(k),
      need: (k) => needCurves(this.curveOf(k).family, [this.curveOf(k).curve]),
      isLoaded: () => !this.table || this.table.families.every(isFullyLoaded),
      fillTile: (element, k) => this.fillTile(element, k),
      draw: (element, k) => {
        const { family, curve } = this.curveOf(k);
        fill(elementIn(element, ".tile-picture"), thumbnail(family, [curve], this.pictureSize));
      },
      failed: (message) => app.announce(message),
    });
    this.app = app;
    this.element.classList.add("results");
    pinOnKey(this.element);
    this.unwatch = watchPins(app, this.element);
  }

  end() {
    super.end();
    this.unwatch();
    this.rows = [];
    this.table = null;
  }

  /** Replaces the rows shown. @param {CurveTable} table @param {Uint32Array} rows @param {(row: number) => string | null | undefined} valueOf */
  setRows(table, rows, valueOf) {
    this.table = table;
    this.rows = rows;
    this.valueOf = valueOf;
    this.count = rows.length;
    this.keep(() => false);
    this.queue = [];
    if (this.element.isConnected) this.measure();
  }

  tile(/** @type {number} */ k) {
    const { family, curve, name } = this.curveOf(k);
    const attributes = { href: curveAddress(family.id, curveKey(family, curve)), "data-name": name };
    const link = h("a", attributes, h("span.tile-picture"), h("span.label"));
    return h("li", link, curvePinButton(this.app, name));
  }

  fillTile(/** @type {Element} */ element, /** @type {number} */ k) {
    const { family, curve, name } = this.curveOf(k);
    const value = this.valueOf(this.rows[k]);
    const caption = curveCaption(family, curve) || name;
    const circuit = family.curves.circuit[curve];
    const which = [pointLabel(family, curve), circuit > 1 ? `circuit ${circuit}` : ""];
    fill(
      elementIn(element, ".label"),
      value ? [h("b", value), " "] : null,
      formatCaption([...which, caption].filter(Boolean).join(" · ")),
    );
  }

  /** The curve of a tile, with its name. */
  curveOf(/** @type {number} */ k) {
    if (!this.table) throw new Error("there are no results");
    return this.table.curveOf(this.rows[k]);
  }
}
