// The view that finds curves by shape.

import { curvePoints } from "../../data/family.js";
import { needCurveWithKey, needCurves } from "../../data/needs.js";
import { queryShape } from "../../shape/query-shape.js";
import { decodeShape, encodeShape } from "../../shape/encode.js";
import { addCandidates, rankCandidates } from "../../shape/search.js";
import { fill, h } from "../dom.js";
import { MAX_AUTOLOAD_BYTES, requestedFamilies, loadAllLine, familyChooser } from "../find/loading.js";
import { needPart, releaseIndexes, searchedParts, shapeIndex, runInSlices } from "./indexes.js";
import { shapeLayout } from "./layout.js";
import { matchItem } from "./match-item.js";
import { DrawingPad } from "./pad.js";
import { formatShapeQuery, parseShapeQuery, shapeOptions } from "./query.js";
import { matchesRoute, routeAddress } from "../../data/address.js";
import { watchPins } from "../pins.js";

const MAX_RESULTS = 36;

/** The route `#/shape?d=…` or `?like=evans:12.1.1`, with `part`, `least`, `mirror=no`, `by=greatest`, `family`. */
export const shapeRoute = {
  name: "shape",
  label: "By shape",
  href: (app) => routeAddress("shape", {}, app),
  matches: (target, app) => matchesRoute("shape", target, app),
  open: async (app, { query }) => {
    const view = new ShapeView(app, query);
    await view.start();
    return view;
  },
};

export class ShapeView {
  title = "By shape";
  /** @type {Shape | null} */ shape = null;
  /** What is searched, and how much of all that is. @type {SearchedPart[]} */
  parts = [];
  /** @type {LoadState} */ state = { done: false, curves: 0, total: 0, bytes: 0 };
  /** A later turn stops what an earlier one does. */
  turn = 0;
  limit = MAX_AUTOLOAD_BYTES;
  unwatch = () => {};

  constructor(/** @type {App} */ app, /** @type {Query} */ query) {
    this.app = app;
    this.loadAll = loadAllLine(() => {
      this.limit = Infinity;
      this.open();
    });
    this.pad = new DrawingPad((points, closed) => this.setDrawnShape(points, closed), app.announce);
    this.status = h("p.counted", "Draw or paste a curve, or start from a curve of the atlas");
    this.results = h("ol.matches");
    this.families = h("div");
    this.query = parseShapeQuery(query);
    this.options = shapeOptions(this.query, () => this.submit());
    this.element = shapeLayout(this);
  }

  async start() {
    await this.loadShape();
    this.unwatch = watchPins(this.app, this.element);
    this.open();
  }

  /** Opens the requested families and searches them; a later call, or leaving, stops it. */
  async open() {
    const { app, query } = this;
    this.turn += 1;
    const turn = this.turn;
    const listed = requestedFamilies(app.atlas, query.families);
    const choose = (ids) => {
      query.families = ids;
      this.writeAddress();
      this.open();
    };
    fill(this.families, familyChooser(app.atlas, listed, choose));
    const families = [];
    for (const { id } of listed) {
      try {
        families.push(await app.atlas.family(id));
      } catch (error) {
        app.announce(error.message);
      }
      if (turn !== this.turn) return;
    }
    this.parts = searchedParts(families, this.limit);
    this.state = {
      done: true,
      curves: this.parts.reduce((sum, { count }) => sum + count, 0),
      total: listed.reduce((sum, { curves }) => sum + curves, 0),
      bytes: listed.reduce((sum, { bytes }) => sum + bytes, 0),
    };
    if (this.shape) await this.search();
    else await this.prepare();
  }

  /** Loads what will be searched, before there is a shape. */
  async prepare() {
    this.showState();
    const turn = this.turn;
    for (const part of this.parts.filter(({ isKept }) => isKept)) {
      await needPart(part)?.catch((error) => this.app.announce(error.message));
      if (turn !== this.turn) return;
    }
  }

  /** Says what is not searched, or that there is nothing to search. */
  showState() {
    this.loadAll.show(this.state);
    if (this.state.curves > 0) return;
    fill(this.status, "No curves are loaded; select families");
    fill(this.results);
    this.results.removeAttribute("aria-busy");
  }

  /** Loads the shape of the address: a drawn one, or a curve of the atlas. */
  async loadShape() {
    const { query, app } = this;
    const drawn = query.d && decodeShape(query.d);
    if (drawn) this.setShape(drawn.points, drawn.closed);
    if (drawn || !query.like) return;
    const [id, key] = query.like.split(":");
    const family = await app.atlas.family(id);
    const curve = await needCurveWithKey(family, key ?? "");
    if (curve === undefined) throw new Error(`There is no curve ${key} in the family ${id}.`);
    await needCurves(family, [curve]);
    this.setShape(curvePoints(family, curve), family.curves.closed[curve] === 1);
  }

  setShape(/** @type {Float64Array} */ points, closed) {
    this.pad.show(points, closed);
    this.shape = queryShape(points, closed);
    this.query.part ??= !closed;
    this.options.mark();
  }

  setDrawnShape(/** @type {Float64Array} */ points, closed) {
    this.shape = queryShape(points, closed);
    if (!this.shape) return;
    Object.assign(this.query, { d: encodeShape(this.shape.points, closed), like: null, part: !closed });
    this.options.mark();
    this.submit();
  }

  /** Searches all parts, one after another; a later search stops an earlier one. */
  async search() {
    const { shape } = this;
    if (!shape || !this.state.done) return;
    this.turn += 1;
    const turn = this.turn;
    const stopped = () => turn !== this.turn;
    this.showState();
    if (this.state.curves === 0) return;
    const { part, least, mirror, by } = this.query;
    const options = { part: part === true, least, mirror, by };
    this.results.setAttribute("aria-busy", "true");
    const began = performance.now();
    const candidates = await this.candidates(shape, options, stopped);
    const found = candidates && (await runInSlices(rankCandidates(candidates, shape, options), stopped));
    if (!found) return;
    this.element.dataset.milliseconds = (performance.now() - began).toFixed(0);
    const items = [];
    // Each is drawn as soon as its points are loaded: those of all may be more than are kept.
    for (const one of found.slice(0, MAX_RESULTS)) {
      await needCurves(one.family, [one.curve]);
      if (stopped()) return;
      items.push(matchItem(this.app, one, shape, this.query));
    }
    this.show(items);
    // Prepares the index for partial curves while idle.
    if (part) return;
    for (const one of this.parts.filter(({ isKept }) => isKept)) {
      await needPart(one);
      if (!(await shapeIndex(one, least, stopped))) return;
    }
  }

  /** The candidates of all parts; null if stopped. @param {SearchOptions} options */
  async candidates(/** @type {Shape} */ shape, /** @type {SearchOptions} */ options, stopped) {
    /** @type {Candidate[]} */ let candidates = [];
    let searched = 0;
    // The points of one part may be dropped while another one is searched.
    const isTransient = this.parts.some(({ isKept }) => !isKept);
    for (const one of this.parts) {
      const share = `${searched.toLocaleString("en")} of ${this.state.curves.toLocaleString("en")} curves`;
      fill(this.status, "Searching ", one.family.title, this.parts.length > 1 ? `: ${share}` : "");
      try {
        await needPart(one);
      } catch (error) {
        this.app.announce(error.message);
        continue;
      }
      if (stopped()) return null;
      const index = await shapeIndex(one, options.part ? options.least : null, stopped);
      if (!index) return null;
      const search = addCandidates(candidates, index, shape, options, isTransient);
      candidates = await runInSlices(search, stopped);
      if (!candidates) return null;
      searched += one.count;
    }
    return candidates;
  }

  /** Shows list items of results. */
  show(items) {
    const { by } = this.query;
    const ranked = `ranked by ${by} deviation in % of the shape’s extent`;
    const nearest = items.length === 1 ? "nearest" : `${items.length} nearest`;
    const sentence = items.length
      ? `The ${nearest} of ${this.state.curves.toLocaleString("en")} curves, ${ranked}`
      : "No similar curve found";
    const rest = this.state.curves < this.state.total ? `; ${this.loadAll.text(this.state)}` : "";
    fill(this.status, sentence);
    this.app.announce(`${sentence}${rest}`);
    this.results.removeAttribute("aria-busy");
    fill(this.results, items);
  }

  /** Updates the address and the results after a change of the query. */
  submit() {
    this.writeAddress();
    this.search();
  }

  writeAddress() {
    this.app.replace(routeAddress("shape", formatShapeQuery(this.query), this.app));
  }

  leave() {
    this.turn += 1;
    this.unwatch();
    // The index of a large family is built again when it is searched again.
    const isLarge = this.parts.some(({ isKept }) => !isKept) || this.state.curves < this.state.total;
    if (isLarge) releaseIndexes(this.parts);
  }
}
