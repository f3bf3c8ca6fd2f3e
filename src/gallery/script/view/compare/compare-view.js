// The view that compares pinned curves.

import { curveAddress, matchesRoute, parameterWord, routeAddress } from "../../data/address.js";
import { curveCaption } from "../../data/family.js";
import { buttonOf, fill, h, keepFocus, selectOf } from "../dom.js";
import { formatCaption, formatChanges } from "../labels.js";
import { exportMenu } from "../export/menu.js";
import { alignCurve, ALIGNMENTS, MAX_COMPARED } from "./align.js";
import { formatComparisonQuery, parseComparisonQuery, loadComparedCurve } from "./align.js";
import { factsTable } from "./facts.js";
import { Store } from "../store.js";
import { letterOf, overlaidPicture, sideBySidePictures, strokeSample, refinePicture } from "./picture.js";

/** The route `#/compare?c=evans:12.1.1,watt:3.1.1&view=side|over&align=…`; without names, one's own pins. @type {Route} */
export const compareRoute = {
  name: "compare",
  label: "Compare",
  href: (app) => routeAddress("compare", { c: app.pins.names.join(",") }, app),
  matches: (target, app) => matchesRoute("compare", target, app),
  open: async (app, { query }) => {
    const view = new CompareView(app, query);
    await view.refresh();
    return view;
  },
};

class CompareView {
  title = "Compare";
  /** Whether one's own pins are compared, which follow. */ isOwn = true;
  /** The curves by their names. @type {Map<string, Awaited<ReturnType<typeof loadComparedCurve>>>} */
  loaded = new Map();
  /** Stopped by what is shown next. */ refining = new AbortController();

  constructor(/** @type {App} */ app, /** @type {AddressQuery} */ query) {
    this.app = app;
    this.store = new Store(app, this.stateOf(query), (state) =>
      routeAddress("compare", formatComparisonQuery(state), app),
    );
    app.replace(this.store.address(this.query));
    this.body = h("div.comparison");
    this.tools = h("div.toolbar");
    this.exportSlot = h("div");
    this.count = h("p.lede");
    const head = h("div.head", h("div", h("h1", "Compare"), this.count), this.exportSlot);
    this.element = h("div.view.wide.compare-view", head, this.tools, this.body);
    this.store.watch((_, before) => before && this.refresh());
    this.unwatch = app.pins.watch((names) => {
      if (this.isOwn && String(names) !== String(this.query.names)) this.store.note({ names: [...names] });
    });
  }

  /** What is compared, and how. */
  get query() {
    return this.store.state;
  }

  /** The state of an address, which may be that of one's own pins. */
  stateOf(/** @type {AddressQuery} */ query) {
    const pinned = [...this.app.pins.names];
    const { names, ...state } = parseComparisonQuery(query);
    this.isOwn = names === null || String(names) === String(pinned);
    return { ...state, names: names ?? pinned };
  }

  /** Shows the curves. */
  async refresh() {
    const { app } = this;
    const names = this.query.names;
    for (const name of names) {
      if (!this.loaded.has(name)) this.loaded.set(name, await loadComparedCurve(app, name));
    }
    // Without the kernel, curves are shown without their deviations.
    const kernel = await app.kernel.load().catch(() => null);
    // Others may have been chosen meanwhile.
    if (names !== this.query.names) return;
    const found = names.map((name) => this.loaded.get(name));
    const there = found.filter((one) => one !== undefined && "family" in one);
    const missing = found.filter((one) => one !== undefined && "reason" in one);
    const focused = keepFocus(this.element);
    this.render(kernel, there, missing);
    focused();
  }

  update(/** @type {Target} */ { query }, isRetraced = false) {
    const { isOwn } = this;
    const state = this.stateOf(query);
    if (isRetraced) this.isOwn = isOwn;
    this.store.show(state);
    if (isRetraced) this.pinOwn();
    else this.app.replace(this.store.address(state));
    return true;
  }

  /** Changes which curves are compared. */
  choose(/** @type {string[]} */ names) {
    this.store.change({ names });
    this.pinOwn();
  }

  pinOwn() {
    if (this.isOwn) this.app.pins.set(this.query.names);
  }

  /** @param {{ name: string, reason: string }[]} missing */
  render(/** @type {Kernel | null} */ kernel, /** @type {ComparedCurve[]} */ all, missing) {
    const curves = all.slice(0, MAX_COMPARED);
    const { query, app, isOwn } = this;
    const beyond = all.length - curves.length;
    const none = "No curves are pinned. Pin curves in Find (p), By shape, on a page or on a plate.";
    const words = [
      all.length ? `${all.length} ${isOwn ? "pinned" : "curves, which are not your pins"}` : none,
    ];
    if (beyond) words.push(`the first ${MAX_COMPARED} are compared`);
    words.push(...missing.map(({ name, reason }) => `skipped ${name}: ${reason}`));
    fill(this.count, words.join("; "));
    fill(this.exportSlot, all.length ? exportMenu(app, () => all.map(({ name }) => name)) : null);
    fill(this.tools, all.length ? this.controls() : null);
    const aligned = curves.map((one, k) => alignCurve(kernel, curves[0], one, k > 0 ? query.align : "none"));
    const labels = curves.map(({ name }, k) => `${letterOf(k)} ${name}`);
    this.refining.abort();
    this.refining = new AbortController();
    const isOver = query.view === "over" && curves.length > 1;
    const picture = isOver
      ? overlaidPicture(aligned, `${labels.join(", ")}; alignment: ${ALIGNMENTS[query.align]}`)
      : sideBySidePictures(aligned);
    refinePicture(kernel, picture, curves, aligned, this.refining.signal);
    const entries = curves.map((one, k) => {
      const drawn = isOver ? strokeSample(k) : h("div.tile-picture", picture.elements?.[k]);
      return this.entry(one, k, curves.length, aligned[k].fit, drawn);
    });
    const list = h(isOver ? "ol.pinned-list" : "ol.pinned-tiles", entries);
    const facts = curves.length ? factsTable(curves, app.atlas.measures, labels) : null;
    fill(this.body, picture.element, list, facts);
  }

  controls() {
    const { query, store } = this;
    const view = (/** @type {ComparisonQuery["view"]} */ name, /** @type {string} */ label) =>
      buttonOf(label, () => store.change({ view: name }), { "aria-pressed": String(query.view === name) });
    const attributes = { id: "compare-align", onchange: () => store.change({ align: align.value }) };
    const align = selectOf(attributes, Object.entries(ALIGNMENTS), query.align);
    const views = [view("side", "Side by side"), view("over", "Overlay")];
    return [
      h("div.segments", { role: "group", "aria-label": "Show" }, views),
      h("span.field.row", h("label", { for: "compare-align" }, "Alignment"), align),
      this.isOwn
        ? buttonOf("Unpin all", () => this.choose([]), { class: "quiet end" })
        : buttonOf("Pin all", () => this.pinAll(), { class: "quiet end" }),
    ];
  }

  /** @param {number} k @param {number} count @param {Element} picture */
  entry(/** @type {ComparedCurve} */ one, k, count, /** @type {Fit | null} */ fit, picture) {
    const { name, family, curve, key, changes } = one;
    const letter = letterOf(k);
    const leave = this.isOwn ? "Unpin" : "Remove";
    /** @param {string} label @param {string} words @param {() => void} onclick */
    const act = (label, words, onclick, disabled = false) =>
      buttonOf(label, onclick, { class: "quiet", "aria-label": words, disabled });
    const percent = (/** @type {number} */ value) => `${(100 * value).toFixed(2)} %`;
    const away = fit ? `${percent(fit.rms)} rms from A, ${percent(fit.greatest)} maximum` : null;
    // The change "circuit" is that of a plate unless it is a parameter.
    const word = (/** @type {string} */ other) =>
      family.names.includes(other) ? parameterWord(other) : other;
    const words = new Map([...changes].map(([other, value]) => [word(other), value]));
    const named = [
      h("b", letter),
      " ",
      h("a", { href: curveAddress(family.id, key, words) }, `${family.title}, ${key}`),
      h("p.caption", formatCaption(curveCaption(family, curve))),
      changes.size ? h("p.tag", formatCaption(formatChanges(changes))) : null,
      k > 0 && away ? h("p.deviation", away) : null,
    ];
    const acts = [
      act("←", `Move ${letter} forward`, () => this.move(k, -1), k === 0),
      act("→", `Move ${letter} back`, () => this.move(k, 1), k + 1 === count),
      act(leave, `${leave} ${letter}`, () => this.choose(this.query.names.filter((other) => other !== name))),
    ];
    return h("li", picture, h("div.named", named), h("div.acts", acts));
  }

  move(/** @type {number} */ k, /** @type {number} */ by) {
    const names = [...this.query.names];
    names.splice(k + by, 0, ...names.splice(k, 1));
    this.choose(names);
    this.app.announce(`${names[k + by]} is now ${letterOf(k + by)}`);
  }

  /** Pins the curves too, after one's own, and compares them all. */
  pinAll() {
    const names = [...new Set([...this.app.pins.names, ...this.query.names])];
    this.isOwn = true;
    this.choose(names);
  }

  leave() {
    this.unwatch();
    this.store.leave();
    this.refining.abort();
    for (const one of this.loaded.values()) if ("release" in one) one.release();
  }
}
