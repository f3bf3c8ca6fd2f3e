// The view of a page, with zoom and the curve under the pointer highlighted.

import { address, curveAddress } from "../data/address.js";
import { listedFamily } from "../data/atlas.js";
import { findCurve, curveKey, pageViews } from "../data/family.js";
import { loadPage } from "../data/needs.js";
import { fill, h } from "./dom.js";
import { CurveHighlight } from "./curve-highlight.js";
import { pageAddress, pageBar, readPageZoom } from "./page-bar.js";
import { keyHelp, watchPageKeys } from "./page-keys.js";
import { curvePanel, curveListPanel } from "./page-panel.js";
import { pageOverlay, pagePicture, prefetchPages, curvesOnPaper, nearestCurve } from "./page-picture.js";
import { Zoom } from "./zoom.js";
import { watchPins } from "./pins.js";

/** The route of a page: `#/evans/3?curve=12.1.1&zoom=4&at=210,120`. @type {Route} */
export const pageRoute = {
  name: "page",
  parent: "families",
  matches: ({ path }) => path.length === 2 && /^[1-9][0-9]*$/.test(path[1]),
  open: async (app, target) => {
    const family = await app.atlas.family(target.path[0]);
    const listed = listedFamily(app.atlas, family.id);
    if (Number(target.path[1]) > listed.pages)
      throw new Error(`${family.title} has only ${listed.pages === 1 ? "1 page" : `${listed.pages} pages`}.`);
    const view = new PageView(app, family, listed);
    await view.open(target);
    return view;
  },
};

/** The view of a page. */
export class PageView {
  /** The number of the page. */ page = 0;
  title = "";
  /** @type {AddressQuery} */ query;
  /** @type {DrawnCurve[]} */ drawn = [];
  /** @type {ReturnType<typeof pageOverlay> | null} */ overlay = null;
  hasLeft = false;
  hasPosition = false;
  /** @type {string | null} */ announcedPercent = null;
  remembering = 0;
  /** Releases the data of the page. */ release = () => {};

  constructor(/** @type {App} */ app, /** @type {Family} */ family, /** @type {ListedFamily} */ listed) {
    this.app = app;
    this.family = family;
    this.listed = listed;
    this.viewport = h("div.viewport", {
      tabindex: "0",
      role: "group",
      "aria-describedby": "page-keys",
      onpointermove: (event) => this.hovered(event),
      onpointerleave: () => this.highlight.leave(),
    });
    this.sheet = h("div.page-sheet");
    this.reading = h("div.reading", { hidden: true });
    this.viewport.append(this.sheet, this.reading);
    watchPageKeys(this);
    this.panel = h("aside.page-panel", { "aria-label": "Curves of this page" });
    this.bar = pageBar(listed, { go: (page) => this.go(page), zoom: () => this.zoom });
    const { width, height } = family.paper;
    this.viewport.style.aspectRatio = `${width} / ${height}`;
    this.zoom = new Zoom(this.viewport, this.sheet, family.paper, this);
    this.highlight = new CurveHighlight(this);
    this.legend = h("p.note");
    const heading = h("h1", h("a", { href: address([family.id]) }, family.title));
    this.element = h(
      "div.view.wide.page-view",
      { onclick: (event) => this.followed(event) },
      h("div.head", h("div.page-title", heading, this.legend), this.bar.element),
      h("div.split", h("div.page-main", this.viewport, keyHelp()), this.panel),
    );
    this.unwatch = watchPins(app, this.element);
  }

  /** Shows the page of an address; returns false for another family. @param {Target} target */
  update(target) {
    const [id, page] = target.path;
    if (!pageRoute.matches(target, this.app) || id !== this.family.id || Number(page) > this.listed.pages)
      return false;
    this.open(target);
    return true;
  }

  async open(/** @type {Target} */ { path, query }) {
    ["curve", "zoom", "at"].forEach((name) => query.get(name));
    const page = Number(path[1]);
    const isOther = page !== this.page;
    this.page = page;
    this.title = `${this.family.title}, page ${page} of ${this.listed.pages}`;
    if (isOther) {
      this.viewport.setAttribute("aria-label", `Page ${page} of ${this.listed.pages}`);
      const release = await loadPage(this.family, page);
      const picture = await pagePicture(this.app, this.family, page, this.title);
      if (page !== this.page || this.hasLeft) {
        release();
        return;
      }
      this.release();
      this.release = release;
      this.setPicture(picture);
      this.app.announce(this.title);
    }
    this.query = query;
    if (this.element.isConnected) this.applyQuery(query);
  }

  /** Called when the view has a size: sets the position and takes the focus, so that keys work. */
  shown() {
    this.applyQuery(this.query);
    this.viewport.focus({ preventScroll: true });
  }

  /** Puts a page's picture and the overlay of its curves into the view. */
  setPicture(/** @type {Element} */ picture) {
    const views = pageViews(this.family, this.page);
    const hadFocus = this.sheet.contains(document.activeElement);
    this.drawn = curvesOnPaper(this.family, views);
    this.overlay = pageOverlay(this.family, this.drawn, {
      onfocus: (curve) => this.highlight.focus(curve),
      onblur: () => this.highlight.leave(),
    });
    this.highlight.reset();
    fill(this.sheet, picture, this.overlay.element);
    this.overlay.links.values().next().value?.setAttribute("tabindex", "0");
    if (hadFocus) this.viewport.focus({ preventScroll: true });
    this.showPanel();
    prefetchPages(this.app, this.family, this.page);
  }

  /** Applies the rest of the address: a curve, and the zoom position. @param {AddressQuery} query */
  applyQuery(query) {
    const enlarged = readPageZoom(query);
    if (enlarged) this.zoom.showAt(enlarged.near, enlarged.place);
    else if (!this.hasPosition) this.zoom.fit();
    this.hasPosition = true;
    const found = this.drawnWithKey(query.get("curve"));
    if (found) this.highlight.select(found.curve);
    else {
      if (query.has("curve")) query.ignore("curve", "not on this page");
      this.highlight.select(null);
      this.showPanel();
    }
    // Another page keeps the zoom of the previous one, and its address contains it.
    this.zoomed();
  }

  /** Shows the list of curves, or one curve, in the panel. */
  showPanel(/** @type {number | null} */ curve = null) {
    const { app, family, page, drawn, highlight } = this;
    const onenter = (/** @type {number} */ other) => highlight.preview(other);
    const panel =
      curve === null
        ? curveListPanel(family, page, drawn, { onenter, onleave: () => highlight.leave() })
        : curvePanel(app, family, curve, { onall: () => this.showAll() });
    fill(this.panel, panel);
    fill(this.legend, this.family.legend ?? "");
  }

  /** Shows the list of curves instead of one curve. */
  showAll() {
    this.highlight.select(null);
    this.showPanel();
    this.viewport.focus({ preventScroll: true });
  }

  deselect() {
    this.highlight.select(null);
    this.showPanel();
    this.remember();
  }

  hovered(/** @type {PointerEvent} */ event) {
    if (event.pointerType === "touch" || this.zoom.isDragging) return;
    const place = this.zoom.placeOf(event);
    this.highlight.hover(nearestCurve(this.drawn, place, this.reach(8)), place);
  }

  tapped(/** @type {PointerEvent} */ event) {
    const place = this.zoom.placeOf(event);
    const found = nearestCurve(this.drawn, place, this.reach(event.pointerType === "touch" ? 20 : 8));
    if (!found) this.deselect();
    else if (event.pointerType !== "touch" || this.highlight.selected === found.curve) {
      this.choose(found.curve);
      this.app.go(curveAddress(this.family.id, curveKey(this.family, found.curve)));
    } else this.choose(found.curve, place);
  }

  /** Selects the curve of a link that is followed, so that it is highlighted on return. */
  followed(/** @type {{ target: Element }} */ { target }) {
    const href = target.closest('a[href*="/curve/"]')?.getAttribute("href");
    const found = this.drawnWithKey(href?.split("/").at(-1));
    if (found) this.choose(found.curve);
  }

  drawnWithKey(/** @type {string | undefined} */ key) {
    const curve = findCurve(this.family, key);
    return this.drawn.find((candidate) => candidate.curve === curve);
  }

  choose(/** @type {number} */ curve, /** @type {Point | null} */ place = null) {
    this.highlight.select(curve, place);
    this.remember();
  }

  /** The pointer tolerance in millimetres: a number of pixels, or 3 mm if that is not much more. */
  reach(/** @type {number} */ pixels) {
    return Math.max(pixels, Math.min(3 * this.zoom.scale, 2 * pixels)) / this.zoom.scale;
  }

  go(/** @type {number} */ page) {
    if (page >= 1 && page <= this.listed.pages && page !== this.page)
      this.app.go(address([this.family.id, page]));
  }

  zoomed() {
    const { magnification, isFit } = this.zoom;
    this.bar.update({ page: this.page, magnification, isFit });
    this.highlight.updateZoom();
    window.clearTimeout(this.remembering);
    this.remembering = window.setTimeout(() => this.settled(), 400);
  }

  /** Handles the end of a zoom. */
  settled() {
    const percent = `${Math.round(this.zoom.magnification * 100)} %`;
    if (this.announcedPercent !== null && percent !== this.announcedPercent)
      this.app.announce(`Zoom ${percent}`);
    this.announcedPercent = percent;
    this.remember();
  }

  /** Writes the current state to the address. */
  remember() {
    if (this.hasLeft || this.page === 0) return;
    this.app.replace(pageAddress(this));
  }

  leave() {
    this.hasLeft = true;
    this.unwatch();
    this.highlight.reset();
    this.release();
    window.clearTimeout(this.remembering);
    this.zoom.end();
  }
}
