// The view that finds curves by shape.

import { requestCollection } from "../../data/packed.js";
import { encodeShape, lengthsAlong } from "../../shape/outline.js";
import { fill, h } from "../dom.js";
import { MAX_AUTOLOAD_BYTES, requestedFamilies, loadAllLine, familyChooser } from "../find/loading.js";
import { Store } from "../store.js";
import { FourBarSection } from "./four-bars.js";
import { loadStateOf, releaseIndexes, searchedParts, shapeIndex } from "./indexes.js";
import { shapeLayout } from "./options.js";
import { matchItem, matchesText } from "./match-item.js";
import { mergedMatches, nearestCurves } from "./matches.js";
import { formatShapeQuery, outlineOfState, parseShapeQuery } from "./query.js";
import { TargetPlane } from "./target.js";
import { matchesRoute, routeAddress } from "../../data/address.js";
import { watchPins } from "../pins.js";

const MAX_RESULTS = 36;
const WITHOUT_SHAPE = "Draw or paste a curve, or start from a curve of the atlas";

/** The route `#/shape?d=…` or `?like=evans:12.1.1`, with what parseShapeQuery reads. @type {Route} */
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
  /** @type {Outline | null} */ shape = null;
  /** The last shape that was drawn or read, with its word: the address has it with fewer points. */
  given = { word: "", outline: /** @type {Outline | null} */ (null), name: "the drawn path" };
  /** What is searched, and how much of all that is. @type {SearchedPart[]} */ parts = [];
  /** @type {LoadState} */ loaded = { done: false, curves: 0, total: 0, bytes: 0 };
  /** Stopped by what is opened or searched for next. */ searching = new AbortController();
  limit = MAX_AUTOLOAD_BYTES;
  unwatch = () => {};

  constructor(/** @type {App} */ app, /** @type {Query} */ query) {
    this.app = app;
    const address = (/** @type {ShapeQuery} */ state) => routeAddress("shape", formatShapeQuery(state), app);
    this.store = new Store(app, parseShapeQuery(query), address);
    this.loadAll = loadAllLine(() => {
      this.limit = Infinity;
      this.open();
    });
    const live = (/** @type {Outline} */ outline, /** @type {boolean} */ isDragged) => {
      this.fourBars.follow(outline, this.store.state, isDragged);
    };
    const drawn = (/** @type {Outline} */ outline) => this.setShape(outline, "the drawn path");
    this.target = new TargetPlane({ drawn, live, cleared: () => this.clear() }, app.announce);
    this.fourBars = new FourBarSection(app, (...found) => this.target.showFound(...found));
    this.status = h("p.counted", WITHOUT_SHAPE);
    this.results = h("ol.matches");
    this.families = h("div");
    this.element = shapeLayout(this);
    this.store.watch((state, before) => this.#changed(state, before));
  }

  async start() {
    await this.#loadShape();
    this.unwatch = watchPins(this.app, this.element);
    this.open();
  }

  /** Shows the state of another address. */
  update(/** @type {Target} */ { query }) {
    this.store.show(parseShapeQuery(query));
    return true;
  }

  /** Shows a state, and searches again for what has changed. @param {ShapeQuery} state @param {ShapeQuery | null} before */
  #changed(state, before) {
    this.target.showBox(state.pivots);
    if (!before) return;
    /** @param {...(keyof ShapeQuery)} names */
    const isOther = (...names) => names.some((name) => String(state[name]) !== String(before[name]));
    if (isOther("d", "place", "like")) {
      this.#loadShape().then(
        () => (isOther("families") ? this.open() : this.search()),
        (error) => this.showNone(error.message),
      );
    } else {
      const isOtherPart = before.part !== null && isOther("part");
      if (isOtherPart || isOther("fullTurn", "maxLink", "mu", "pivots")) this.findFourBars();
      if (isOther("families")) this.open();
      else if (isOtherPart || isOther("least", "mirror", "by")) this.findCurves();
    }
  }

  /** Stops what is searched for; the signal for what follows. */
  #begin() {
    this.searching.abort();
    this.searching = new AbortController();
    return this.searching.signal;
  }

  /** Opens the requested families and searches them; a later call, or leaving, stops it. */
  async open() {
    const { app } = this;
    const signal = this.#begin();
    const listed = requestedFamilies(app.atlas, this.store.state.families);
    const choose = (/** @type {string[] | null} */ families) => this.store.change({ families });
    fill(this.families, familyChooser(app.atlas, listed, choose));
    const families = [];
    for (const { id } of listed) {
      try {
        families.push(await app.atlas.family(id));
      } catch (error) {
        app.announce(error.message);
      }
      if (signal.aborted) return;
    }
    this.parts = searchedParts(families, this.limit);
    this.loaded = loadStateOf(listed, this.parts);
    if (this.shape) await this.search();
    else await this.prepare(signal);
  }

  /** Prepares the searches before there is a shape. */
  async prepare(/** @type {AbortSignal} */ signal) {
    this.showState();
    // Without the kernel, a search says so.
    const kernel = await this.app.kernel.load().catch(() => null);
    if (!kernel) return;
    for (const part of this.parts.filter(({ isKept }) => isKept)) {
      await shapeIndex(kernel.curveSearch, part, signal).catch((error) => this.app.announce(error.message));
      if (signal.aborted) return;
    }
    await kernel.fourBars.prepare(signal);
  }

  /** Says what is not searched, or that there is nothing to search. */
  showState() {
    this.loadAll.show(this.loaded);
    if (this.loaded.curves === 0) this.showNone("No curves are loaded; select families");
  }

  /** Leaves no results, and says why. */
  showNone(/** @type {string} */ why) {
    fill(this.status, why);
    fill(this.results);
    this.results.removeAttribute("aria-busy");
  }

  /** Takes the shape of the state: a drawn one, or a curve of the atlas. */
  async #loadShape() {
    const { state } = this.store;
    const { word, outline: given } = this.given;
    const outline = state.d && state.d === word ? given : await outlineOfState(this.app, state);
    if (state !== this.store.state) return;
    this.shape = outline;
    if (!outline) return this.#showNoShape();
    if (this.target.outline !== outline) this.target.show(outline);
    this.target.render();
    if (state.part === null) this.store.note({ part: !outline.closed });
  }

  #showNoShape() {
    // Before all is opened, no search is running.
    if (this.loaded.done) this.#begin();
    this.fourBars.clear();
    if (!this.target.isByKeys) this.target.show(null);
    this.showNone(WITHOUT_SHAPE);
  }

  /** Searches for a shape that was drawn or read. @param {Outline} outline */
  setShape(outline, /** @type {string} */ name) {
    if (!((lengthsAlong(outline.points, false).at(-1) ?? 0) > 0)) {
      this.clear();
      return this.showNone("This is too small to be a curve: draw a longer one");
    }
    const { word, place } = encodeShape(outline.points, outline.closed);
    this.given = { word, outline, name };
    this.store.change({ d: word, place, like: null, part: !outline.closed });
  }

  /** Leaves no shape and no answers. */
  clear() {
    this.target.show(null);
    this.store.change({ d: null, place: null, like: null, part: null });
  }

  /** Searches for curves of the atlas, and for four-bars; a later search stops an earlier one. */
  async search() {
    if (this.loaded.done) await Promise.all([this.findCurves(), this.findFourBars()]);
  }

  /** Searches all parts, one after another. */
  async findCurves() {
    const { shape } = this;
    if (!shape || !this.loaded.done) return;
    const signal = this.#begin();
    this.showState();
    if (this.loaded.curves === 0) return;
    const { state } = this.store;
    const { part, least, mirror, by } = state;
    this.results.setAttribute("aria-busy", "true");
    const began = performance.now();
    const progress = (/** @type {SearchedPart} */ { family }, /** @type {number} */ searched) => {
      const share = `${searched.toLocaleString("en")} of ${this.loaded.curves.toLocaleString("en")} curves`;
      fill(this.status, "Searching ", family.title, this.parts.length > 1 ? `: ${share}` : "");
    };
    try {
      const options = { isPart: part === true, least, mirror, by };
      const found = await nearestCurves(this.app, this.parts, shape, options, signal, progress);
      if (!found) return;
      const merged = await mergedMatches(this.app, found, MAX_RESULTS, mirror, signal);
      if (!merged) return;
      this.element.dataset.milliseconds = (performance.now() - began).toFixed(0);
      const sentence = matchesText(merged, this.loaded.curves, by);
      this.showNone(sentence);
      const items = merged.map((one) => matchItem(this.app, one, shape, state));
      fill(this.results, items);
      requestCollection();
      const isAll = this.loaded.curves >= this.loaded.total;
      this.app.announce(isAll ? sentence : `${sentence}; ${this.loadAll.text(this.loaded)}`);
    } catch (error) {
      if (!signal.aborted) this.showNone(error.message);
    }
  }

  findFourBars() {
    const { state } = this.store;
    if (this.shape) this.fourBars.search(this.shape, state, state.like ?? this.given.name);
  }

  leave() {
    this.searching.abort();
    this.fourBars.stop();
    this.store.leave();
    this.unwatch();
    // The index of a large family is built again when it is searched again.
    const isLarge = this.parts.some(({ isKept }) => !isKept) || this.loaded.curves < this.loaded.total;
    const { kernel } = this.app.kernel;
    if (isLarge && kernel) releaseIndexes(kernel.curveSearch, this.parts);
  }
}
