// The view that finds curves by shape.

import { curveOutline } from "../../data/family.js";
import { needCurveWithKey, needCurves } from "../../data/needs.js";
import { queryShape } from "../../shape/query-shape.js";
import { decodeShape, encodeShape } from "../../shape/encode.js";
import { fill, h } from "../dom.js";
import { MAX_AUTOLOAD_BYTES, requestedFamilies, loadAllLine, familyChooser } from "../find/loading.js";
import { Slices } from "../slices.js";
import { FourBarSection } from "./four-bars.js";
import { needPart, releaseIndexes, searchedParts } from "./indexes.js";
import { shapeLayout } from "./layout.js";
import { matchItems, matchesText } from "./match-item.js";
import { nearestCurves } from "./matches.js";
import { mergedMatches } from "./merged.js";
import { DrawingPad } from "./pad.js";
import { formatShapeQuery, parseShapeQuery, shapeOptions } from "./query.js";
import { matchesRoute, routeAddress } from "../../data/address.js";
import { watchPins } from "../pins.js";

const MAX_RESULTS = 36;
const WITHOUT_SHAPE = "Draw or paste a curve, or start from a curve of the atlas";

/** The route `#/shape?d=…` or `?like=evans:12.1.1`, with `part`, `least`, `mirror=no`, `by=greatest`, `family`, `input=any`, `max-link`. */
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
  fourBarTurn = 0;
  limit = MAX_AUTOLOAD_BYTES;
  unwatch = () => {};

  constructor(/** @type {App} */ app, /** @type {Query} */ query) {
    this.app = app;
    this.loadAll = loadAllLine(() => {
      this.limit = Infinity;
      this.open();
    });
    const drawn = (points, closed) => this.setDrawnShape(points, closed);
    this.pad = new DrawingPad(drawn, () => this.clearShape(WITHOUT_SHAPE), app.announce);
    this.status = h("p.counted", WITHOUT_SHAPE);
    this.results = h("ol.matches");
    this.families = h("div");
    this.query = parseShapeQuery(query);
    this.options = shapeOptions(this.query, () => this.submit());
    this.fourBars = new FourBarSection(app, this.query, () => {
      this.writeAddress();
      this.findFourBars();
    });
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

  /** Loads what will be searched, and prepares the search for four-bars, before there is a shape. */
  async prepare() {
    this.showState();
    const turn = this.turn;
    for (const part of this.parts.filter(({ isKept }) => isKept)) {
      await needPart(part)?.catch((error) => this.app.announce(error.message));
      if (turn !== this.turn) return;
    }
    const slices = new Slices(() => turn !== this.turn);
    // Without the kernel, a search says so.
    await this.app.kernel.load().then(
      (kernel) => kernel.fourBars.prepare(slices),
      () => {},
    );
  }

  /** Says what is not searched, or that there is nothing to search. */
  showState() {
    this.loadAll.show(this.state);
    if (this.state.curves === 0) this.showNone("No curves are loaded; select families");
  }

  /** Says why there are no results. */
  showNone(why) {
    fill(this.status, why);
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
    const { points, closed } = curveOutline(family, curve);
    this.setShape(points, closed);
  }

  setShape(/** @type {Float64Array} */ points, closed) {
    this.pad.show(points, closed);
    this.shape = queryShape(points, closed);
    this.query.part ??= !closed;
    this.options.mark();
  }

  setDrawnShape(/** @type {Float64Array} */ points, closed) {
    this.shape = queryShape(points, closed);
    if (!this.shape) return this.clearShape("This is too small to be a curve: draw a longer one");
    Object.assign(this.query, { d: encodeShape(this.shape.points, closed), like: null, part: !closed });
    this.options.mark();
    this.submit();
  }

  /** Leaves no shape and no answers, and says why. */
  clearShape(why) {
    // Before all is opened, no search is running.
    if (this.state.done) this.turn += 1;
    this.fourBarTurn += 1;
    this.fourBars.clear();
    this.shape = null;
    Object.assign(this.query, { d: null, like: null, part: null });
    this.options.mark();
    this.showNone(why);
    this.writeAddress();
  }

  /** Searches for curves of the atlas, and for four-bars; a later search stops an earlier one. */
  search() {
    if (!this.shape || !this.state.done) return;
    return Promise.all([this.findCurves(this.shape), this.findFourBars()]);
  }

  /** Searches all parts, one after another. */
  async findCurves(/** @type {Shape} */ shape) {
    this.turn += 1;
    const turn = this.turn;
    const slices = new Slices(() => turn !== this.turn);
    this.showState();
    if (this.state.curves === 0) return;
    const { part, least, mirror, by } = this.query;
    this.results.setAttribute("aria-busy", "true");
    const began = performance.now();
    const progress = ({ family }, searched) => {
      const share = `${searched.toLocaleString("en")} of ${this.state.curves.toLocaleString("en")} curves`;
      fill(this.status, "Searching ", family.title, this.parts.length > 1 ? `: ${share}` : "");
    };
    try {
      const options = { isPart: part === true, least, mirror, by };
      const found = await nearestCurves(this.app, this.parts, shape, options, slices, progress);
      if (!found) return;
      const merged = await mergedMatches(this.app, found, MAX_RESULTS, mirror, slices);
      if (!merged) return;
      this.element.dataset.milliseconds = (performance.now() - began).toFixed(0);
      const items = await matchItems(this.app, merged, shape, this.query, slices);
      if (items) this.show(items);
    } catch (error) {
      if (!slices.stopped()) this.showNone(error.message);
    }
  }

  findFourBars() {
    this.fourBarTurn += 1;
    const turn = this.fourBarTurn;
    if (!this.shape) return undefined;
    return this.fourBars.search(this.shape, new Slices(() => turn !== this.fourBarTurn));
  }

  /** Shows list items of results. */
  show(items) {
    const sentence = matchesText(items.length, this.state.curves, this.query.by);
    const rest = this.state.curves < this.state.total ? `; ${this.loadAll.text(this.state)}` : "";
    fill(this.status, sentence);
    this.app.announce(`${sentence}${rest}`);
    this.results.removeAttribute("aria-busy");
    fill(this.results, items);
  }

  submit() {
    this.writeAddress();
    this.search();
  }

  /** A change of the query is a gesture: undoing it opens the address before. */
  writeAddress() {
    this.app.commit(routeAddress("shape", formatShapeQuery(this.query), this.app));
  }

  leave() {
    this.turn += 1;
    this.fourBarTurn += 1;
    this.unwatch();
    // The index of a large family is built again when it is searched again.
    const isLarge = this.parts.some(({ isKept }) => !isKept) || this.state.curves < this.state.total;
    const { kernel } = this.app.kernel;
    if (isLarge && kernel) releaseIndexes(kernel.curveSearch, this.parts);
  }
}
