// The view that finds curves by shape.

import { findCurve, curvePoints } from "../../data/family.js";
import { queryShape } from "../../shape/query-shape.js";
import { decodeShape, encodeShape } from "../../shape/encode.js";
import { searchByShape } from "../../shape/search.js";
import { fill, h } from "../dom.js";
import { familyChooser } from "../find/families.js";
import { requestedFamilies, loadFamilies } from "../find/loading.js";
import { watchPins } from "../pin-button.js";
import { matchesRoute, routeAddress } from "../route-address.js";
import { shapeIndex } from "./indexes.js";
import { matchItem } from "./match-item.js";
import { shapeOptions } from "./options.js";
import { DrawingPad } from "./pad.js";
import { pasteField } from "./paste.js";
import { formatShapeQuery, parseShapeQuery } from "./query.js";
import { runInSlices } from "./slices.js";

const MAX_RESULTS = 36;

/**
 * The route `#/shape?d=…` or `?like=evans:12.1.1`, with `part`, `least`, `mirror=no`, `by=greatest`,
 * `family`.
 */
export const shapeRoute = {
  name: "shape",
  label: "By shape",
  href: (app) => routeAddress("shape", {}, app),
  matches: (target, app) => matchesRoute("shape", target, app),
  open: async (app, { query }) => {
    const view = new ShapeView(app, query);
    await view.start();
    return {
      title: "By shape",
      element: view.element,
      update: (target) => view.update(target.query),
      leave: () => view.leave(),
    };
  },
};

class ShapeView {
  constructor(app, query) {
    this.app = app;
    this.turn = 0;
    this.indexes = [];
    this.pad = new DrawingPad(
      (points, closed) => this.setDrawnShape(points, closed),
      (text) => app.announce(text),
    );
    this.status = h("p", { class: "counted" }, "Draw or paste a curve, or start from a curve of the atlas");
    this.results = h("ol", { class: "matches" });
    this.families = h("div", {});
    this.query = parseShapeQuery(query);
    this.options = shapeOptions(this.query, () => this.submit());
    this.element = this.buildElement();
  }

  buildElement() {
    const clear = () => {
      this.pad.clear();
      this.pad.element.focus();
    };
    const use = ({ points, closed, said }) => {
      this.pad.show(points, closed);
      this.setDrawnShape(points, closed);
      this.app.announce(`${said} read`);
    };
    return h(
      "div",
      { class: "view wide shape-view" },
      h("div", { class: "head" }, h("div", {}, h("h1", {}, "By shape"), this.status)),
      h(
        "div",
        { class: "shape-split" },
        h(
          "div",
          { class: "panel" },
          this.pad.element,
          this.pad.help,
          h("div", { class: "toolbar" }, h("button", { type: "button", onclick: clear }, "Clear")),
          this.options.element,
          pasteField(use),
          this.families,
        ),
        this.results,
      ),
    );
  }

  async start() {
    await this.loadShape();
    const { app, query } = this;
    this.unwatch ??= watchPins(app, this.element);
    this.stop?.();
    const listed = requestedFamilies(app.atlas, query.families);
    fill(
      this.families,
      familyChooser(app.atlas, listed, (families) => {
        query.families = families;
        this.writeAddress();
        this.start();
      }),
    );
    this.stop = loadFamilies(
      app.atlas,
      listed,
      (families, done, all) => {
        this.loaded = families;
        this.isWhole = done === all;
        this.search();
      },
      (sentence) => app.announce(sentence),
    );
  }

  /** Loads the shape of the address: a drawn one, or a curve of the atlas. */
  async loadShape() {
    const { query, app } = this;
    const drawn = query.d && decodeShape(query.d);
    if (drawn) this.setShape(drawn.points, drawn.closed);
    if (drawn || !query.like) return;
    const [id, key] = query.like.split(":");
    const family = await app.atlas.family(id);
    const curve = findCurve(family, key ?? "");
    if (curve === undefined) throw new Error(`There is no curve ${key} in the family ${id}.`);
    this.setShape(curvePoints(family, curve), family.curves.closed[curve] === 1);
  }

  setShape(points, closed) {
    this.pad.show(points, closed);
    this.shape = queryShape(points, closed);
    this.query.part ??= !closed;
    this.options.mark();
  }

  setDrawnShape(points, closed) {
    this.shape = queryShape(points, closed);
    if (!this.shape) return;
    Object.assign(this.query, { d: encodeShape(this.shape.points, closed), like: null, part: !closed });
    this.options.mark();
    this.submit();
  }

  /** Searches the loaded families; a later search stops an earlier one. */
  async search() {
    if (!this.shape || !this.loaded) return;
    this.turn += 1;
    const turn = this.turn;
    const stopped = () => turn !== this.turn;
    const { part, least, mirror, by } = this.query;
    this.results.setAttribute("aria-busy", "true");
    const indexes = [];
    for (const family of this.loaded) {
      fill(this.status, "Searching ", family.title);
      const index = await shapeIndex(family, part ? least : null, stopped);
      if (!index) return;
      indexes.push(index);
    }
    const began = performance.now();
    const found = await runInSlices(
      searchByShape(indexes, this.shape, { part: part === true, least, mirror, by }),
      stopped,
    );
    if (!found) return;
    this.element.dataset.milliseconds = (performance.now() - began).toFixed(0);
    this.show(found.slice(0, MAX_RESULTS));
    // Prepares the index for partial curves while idle.
    if (!part && this.isWhole)
      for (const family of this.loaded) if (!(await shapeIndex(family, least, stopped))) return;
  }

  show(found) {
    const { by } = this.query;
    const count = this.loaded.reduce((sum, { curves }) => sum + curves.count, 0);
    const ranked = `ranked by ${by} deviation in % of the shape’s extent`;
    const nearest = found.length === 1 ? "nearest" : `${found.length} nearest`;
    const sentence = found.length
      ? `The ${nearest} of ${count.toLocaleString("en")} curves, ${ranked}`
      : "No similar curve found";
    fill(this.status, sentence);
    this.app.announce(sentence);
    this.results.removeAttribute("aria-busy");
    fill(
      this.results,
      found.map((one) => matchItem(this.app, one, this.shape, this.query)),
    );
  }

  /** Updates the address and the results after a change of the query. */
  submit() {
    this.writeAddress();
    this.search();
  }

  writeAddress() {
    this.app.replace(routeAddress("shape", formatShapeQuery(this.query), this.app));
  }

  /** An address with another shape opens a new view. */
  update() {
    return false;
  }

  leave() {
    this.turn += 1;
    this.unwatch?.();
    this.stop?.();
  }
}
