// The view of a page, with zoom and the curve under the pointer highlighted.

import { address } from "../data/address.js";
import { pageFile } from "../data/atlas.js";
import { findCurve, curveKey, pageViews } from "../data/family.js";
import { loadPage } from "../data/needs.js";
import { fill, h } from "./dom.js";
import { curvesOnPaper, nearestCurve } from "./page-curves.js";
import { CurveHighlight } from "./curve-highlight.js";
import { pageBar } from "./page-bar.js";
import { keyAction, keyHelp } from "./page-keys.js";
import { curvePanel, curveListPanel } from "./page-panel.js";
import { pageOverlay, pagePicture } from "./page-picture.js";
import { watchPins } from "./pin-button.js";
import { Zoom } from "./zoom.js";

/** The route of a page: `#/evans/3?curve=12.1.1&zoom=4&at=210,120`. */
export const pageRoute = {
  name: "page",
  parent: "families",
  matches: ({ path }) => path.length === 2 && /^[1-9][0-9]*$/.test(path[1]),
  open: async (app, target) => {
    const family = await app.atlas.family(target.path[0]);
    const listed = app.atlas.families.find(({ id }) => id === family.id);
    if (Number(target.path[1]) > listed.pages)
      throw new Error(`${family.title} has only ${listed.pages === 1 ? "1 page" : `${listed.pages} pages`}.`);
    const view = new PageView(app, family, listed);
    await view.open(target);
    return view;
  },
};

/** The view of a page. */
class PageView {
  constructor(app, family, listed) {
    Object.assign(this, { app, family, listed });
    this.viewport = h("div", {
      class: "viewport",
      tabindex: "0",
      role: "group",
      "aria-describedby": "page-keys",
      onkeydown: (event) => this.handleKey(event),
      onpointermove: (event) => this.hovered(event),
      onpointerleave: () => this.highlight.leave(),
    });
    this.sheet = h("div", { class: "page-sheet" });
    this.reading = h("div", { class: "reading", hidden: true });
    this.viewport.append(this.sheet, this.reading);
    this.panel = h("aside", { class: "page-panel", "aria-label": "Curves of this page" });
    this.bar = pageBar(listed, { go: (page) => this.go(page), zoom: () => this.zoom });
    const { width, height } = family.paper;
    this.viewport.style.aspectRatio = `${width} / ${height}`;
    this.zoom = new Zoom(this.viewport, this.sheet, {
      width,
      height,
      onchange: () => this.zoomed(),
      ontap: (event) => this.tapped(event),
    });
    this.highlight = new CurveHighlight(this);
    this.element = this.layOut();
    this.unwatch = watchPins(app, this.element);
  }

  layOut() {
    const heading = h("h1", {}, h("a", { href: address([this.family.id]) }, this.family.title));
    this.legend = h("p", { class: "note" });
    return h(
      "div",
      { class: "view wide page-view", onclick: (event) => this.followed(event) },
      h("div", { class: "head" }, h("div", { class: "page-title" }, heading, this.legend), this.bar.element),
      h("div", { class: "split" }, h("div", { class: "page-main" }, this.viewport, keyHelp()), this.panel),
    );
  }

  /** Shows the page of an address; returns false for another family. */
  update(target) {
    if (
      !pageRoute.matches(target) ||
      target.path[0] !== this.family.id ||
      Number(target.path[1]) > this.listed.pages
    )
      return false;
    this.open(target);
    return true;
  }

  async open({ path, query }) {
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
      this.release?.();
      this.release = release;
      this.setPicture(picture);
      this.app.announce(this.title);
    }
    this.query = query;
    if (this.element.isConnected) this.applyQuery(query);
  }

  /**
   * Called when the view is in the document and has a size: sets the position and takes the focus, so that
   * keys work.
   */
  shown() {
    this.applyQuery(this.query);
    this.viewport.focus({ preventScroll: true });
  }

  /** Puts a page's picture and the overlay of its curves into the view. */
  setPicture(picture) {
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
    this.prefetch();
  }

  /** Applies the rest of the address: a curve, and the zoom position. */
  applyQuery(query) {
    const [near, at] = [Number(query.get("zoom")), (query.get("at") ?? "").split(",").map(Number)];
    if (near > 1 && at.length === 2 && at.every(Number.isFinite)) this.zoom.showAt(near, at);
    else if (this.hasPosition === undefined) this.zoom.fit();
    this.hasPosition = true;
    const curve = query.has("curve") ? findCurve(this.family, query.get("curve")) : undefined;
    if (this.drawn.some((candidate) => candidate.curve === curve)) this.highlight.select(curve);
    else {
      this.highlight.select(null);
      this.showPanel();
    }
    // Another page keeps the zoom of the previous one, and its address contains it.
    this.zoomed();
  }

  /** Shows the list of curves, or one curve, in the panel. */
  showPanel(curve = null) {
    const all = () => {
      this.highlight.select(null);
      this.showPanel();
      this.viewport.focus({ preventScroll: true });
    };
    const listeners = {
      onenter: (other) => this.highlight.preview(other),
      onleave: () => this.highlight.leave(),
    };
    fill(
      this.panel,
      curve === null
        ? curveListPanel(this.family, this.page, this.drawn, listeners)
        : curvePanel(this.app, this.family, curve, { onall: all }),
    );
    fill(this.legend, this.family.legend ?? "");
  }

  /** Prefetches the previous and the next page. */
  prefetch() {
    for (const page of [this.page + 1, this.page - 1]) {
      const file = page >= 1 && pageFile(this.app.atlas, this.family.id, page);
      if (file) new Image().src = file;
    }
  }

  hovered(event) {
    if (event.pointerType === "touch" || this.zoom.isDragging || !this.drawn) return;
    const place = this.zoom.placeOf(event);
    this.highlight.hover(nearestCurve(this.drawn, place, this.reach(8)), place);
  }

  tapped(event) {
    const place = this.zoom.placeOf(event);
    const found = nearestCurve(this.drawn, place, this.reach(event.pointerType === "touch" ? 20 : 8));
    if (!found) {
      this.highlight.select(null);
      this.showPanel();
    } else if (event.pointerType !== "touch" || this.highlight.selected === found.curve) {
      this.choose(found.curve);
      this.app.go(address([this.family.id, "curve", curveKey(this.family, found.curve)]));
      return;
    } else {
      this.highlight.select(found.curve, place);
    }
    this.remember();
  }

  /** Selects the curve of a link that is followed, so that it is highlighted on return. */
  followed({ target }) {
    const key = target.closest('a[href*="/curve/"]')?.getAttribute("href").split("/").at(-1);
    const curve = key && findCurve(this.family, key);
    if (this.drawn.some((candidate) => candidate.curve === curve)) this.choose(curve);
  }

  choose(curve) {
    this.highlight.select(curve);
    this.remember();
  }

  /** The pointer tolerance in millimetres: a number of pixels, or 3 mm if that is not much more. */
  reach(pixels) {
    return Math.max(pixels, Math.min(3 * this.zoom.scale, 2 * pixels)) / this.zoom.scale;
  }

  handleKey(event) {
    const act = keyAction(event, this);
    if (!act) return;
    event.preventDefault();
    act();
  }

  go(page) {
    if (page >= 1 && page <= this.listed.pages && page !== this.page)
      this.app.go(address([this.family.id, page]));
  }

  zoomed() {
    this.updateBar();
    this.highlight.updateZoom();
    window.clearTimeout(this.remembering);
    this.remembering = window.setTimeout(() => this.settled(), 400);
  }

  /** Handles the end of a zoom. */
  settled() {
    const percent = `${Math.round(this.zoom.magnification * 100)} %`;
    if (this.announcedPercent !== undefined && percent !== this.announcedPercent)
      this.app.announce(`Zoom ${percent}`);
    this.announcedPercent = percent;
    this.remember();
  }

  updateBar() {
    this.bar.update({ page: this.page, magnification: this.zoom.magnification, isFit: this.zoom.isFit });
  }

  /** Writes the current state to the address. */
  remember() {
    if (this.hasLeft || this.page === undefined) return;
    const { isFit, magnification, middle } = this.zoom;
    this.app.replace(
      address([this.family.id, this.page], {
        curve: this.highlight.selected === null ? null : curveKey(this.family, this.highlight.selected),
        zoom: isFit ? null : magnification.toFixed(2),
        at: isFit ? null : middle.map((mm) => mm.toFixed(1)).join(","),
      }),
    );
  }

  leave() {
    this.hasLeft = true;
    this.unwatch();
    this.release?.();
    window.clearTimeout(this.remembering);
    this.zoom.end();
  }
}
