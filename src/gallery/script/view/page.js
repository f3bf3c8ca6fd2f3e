// A page of a family, near or far, with the curve that is pointed at brought forward.

import { address } from "../data/address.js";
import { pageFile } from "../data/atlas.js";
import { findCurve, curveKey } from "../data/family.js";
import { fill, h } from "./dom.js";
import { curvesOnPaper, nearestCurve } from "./page-curves.js";
import { CurveHighlight } from "./curve-highlight.js";
import { pageBar } from "./page-bar.js";
import { keyAction, keyHelp } from "./page-keys.js";
import { curvePanel, curveListPanel } from "./page-panel.js";
import { pageOverlay, pagePicture } from "./page-picture.js";
import { watchPins } from "./pin-button.js";
import { Zoom } from "./zoom.js";

/** The room of a page: `#/evans/3?curve=12.1.1&zoom=4&at=210,120`. */
export const pageRoute = {
  name: "page",
  under: "families",
  opens: ({ path }) => path.length === 2 && /^[1-9][0-9]*$/.test(path[1]),
  view: async (app, place) => {
    const family = await app.atlas.family(place.path[0]);
    const listed = app.atlas.families.find(({ id }) => id === family.id);
    if (Number(place.path[1]) > listed.pages)
      throw new Error(`${family.title} has ${listed.pages === 1 ? "1 page" : `${listed.pages} pages`} only.`);
    const desk = new PageView(app, family, listed);
    await desk.open(place);
    return desk;
  },
};

/** A page on the desk. */
class PageView {
  constructor(app, family, listed) {
    Object.assign(this, { app, family, listed });
    this.viewport = h("div", {
      class: "viewport",
      tabindex: "0",
      role: "group",
      "aria-describedby": "page-keys",
      onkeydown: (event) => this.typed(event),
      onpointermove: (event) => this.hovered(event),
      onpointerleave: () => this.forward.leave(),
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
    this.forward = new CurveHighlight(this);
    this.element = this.room();
    this.unwatch = watchPins(app, this.element);
  }

  room() {
    const heading = h("h1", {}, h("a", { href: address([this.family.id]) }, this.family.title));
    this.legend = h("p", { class: "note" });
    return h(
      "div",
      { class: "view wide page-view", onclick: (event) => this.followed(event) },
      h("div", { class: "head" }, h("div", { class: "page-title" }, heading, this.legend), this.bar.element),
      h("div", { class: "split" }, h("div", { class: "page-main" }, this.viewport, keyHelp()), this.panel),
    );
  }

  /** Shows what an address says; of another family it is another view's. */
  update(place) {
    if (
      !pageRoute.opens(place) ||
      place.path[0] !== this.family.id ||
      Number(place.path[1]) > this.listed.pages
    )
      return false;
    this.open(place);
    return true;
  }

  async open({ path, query }) {
    const page = Number(path[1]);
    const isOther = page !== this.page;
    this.page = page;
    this.title = `${this.family.title}, page ${page} of ${this.listed.pages}`;
    if (isOther) {
      this.viewport.setAttribute("aria-label", `Page ${page} of ${this.listed.pages}`);
      const picture = await pagePicture(this.app, this.family, page, this.title);
      if (page !== this.page) return;
      this.put(picture);
      this.app.say(this.title);
    }
    this.query = query;
    if (this.element.isConnected) this.look(query);
  }

  /** The desk is in the window, and has a size: now there is somewhere to look, and its keys work at once. */
  shown() {
    this.look(this.query);
    this.viewport.focus({ preventScroll: true });
  }

  /** Lays a page's picture on the desk, with its curves over it. */
  put(picture) {
    const { views } = this.family.pages[this.page - 1] ?? { views: [] };
    const hadFocus = this.sheet.contains(document.activeElement);
    this.drawn = curvesOnPaper(this.family, views);
    this.overlay = pageOverlay(this.family, this.drawn, {
      onfocus: (curve) => this.forward.focus(curve),
      onblur: () => this.forward.leave(),
    });
    this.forward.turn();
    fill(this.sheet, picture, this.overlay.element);
    this.overlay.links.values().next().value?.setAttribute("tabindex", "0");
    if (hadFocus) this.viewport.focus({ preventScroll: true });
    this.beside();
    this.prefetch();
  }

  /** What an address says beyond the page: a curve, and where to look. */
  look(query) {
    const [near, at] = [Number(query.get("zoom")), (query.get("at") ?? "").split(",").map(Number)];
    if (near > 1 && at.length === 2 && at.every(Number.isFinite)) this.zoom.showAt(near, at);
    else if (this.wasLooked === undefined) this.zoom.fit();
    this.wasLooked = true;
    const curve = query.has("curve") ? findCurve(this.family, query.get("curve")) : undefined;
    if (this.drawn.some((candidate) => candidate.curve === curve)) this.forward.choose(curve);
    else {
      this.forward.choose(null);
      this.beside();
    }
    // A page that is turned stays as near as the one before, and its address says so.
    this.zoomed();
  }

  /** The curves of the page beside it, or the one that is forward. */
  beside(curve = null) {
    const all = () => {
      this.forward.choose(null);
      this.beside();
      this.viewport.focus({ preventScroll: true });
    };
    const enter = { onenter: (other) => this.forward.glance(other), onleave: () => this.forward.leave() };
    fill(
      this.panel,
      curve === null
        ? curveListPanel(this.family, this.page, this.drawn, enter)
        : curvePanel(this.app, this.family, curve, { onall: all }),
    );
    fill(this.legend, this.family.legend ?? "");
  }

  /** Has the pages before and after at hand. */
  prefetch() {
    for (const page of [this.page + 1, this.page - 1]) {
      const file = page >= 1 && pageFile(this.app.atlas, this.family.id, page);
      if (file) new Image().src = file;
    }
  }

  hovered(event) {
    if (event.pointerType === "touch" || this.zoom.isDragging || !this.drawn) return;
    const place = this.zoom.placeOf(event);
    this.forward.hover(nearestCurve(this.drawn, place, this.reach(8)), place);
  }

  tapped(event) {
    const place = this.zoom.placeOf(event);
    const found = nearestCurve(this.drawn, place, this.reach(event.pointerType === "touch" ? 20 : 8));
    if (!found) {
      this.forward.choose(null);
      this.beside();
    } else if (event.pointerType !== "touch" || this.forward.chosen === found.curve) {
      this.choose(found.curve);
      this.app.go(address([this.family.id, "curve", curveKey(this.family, found.curve)]));
      return;
    } else {
      this.forward.choose(found.curve, place);
    }
    this.remember();
  }

  /** Whoever comes back from a plate finds its curve forward. */
  followed({ target }) {
    const key = target.closest('a[href*="/curve/"]')?.getAttribute("href").split("/").at(-1);
    const curve = key && findCurve(this.family, key);
    if (this.drawn.some((candidate) => candidate.curve === curve)) this.choose(curve);
  }

  choose(curve) {
    this.forward.choose(curve);
    this.remember();
  }

  /**
   * How far from a curve a pointer may be, in millimetres: some pixels, or 3 mm where these are few pixels
   * too.
   */
  reach(pixels) {
    return Math.max(pixels, Math.min(3 * this.zoom.scale, 2 * pixels)) / this.zoom.scale;
  }

  typed(event) {
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
    this.tell();
    this.forward.zoomed();
    window.clearTimeout(this.remembering);
    this.remembering = window.setTimeout(() => this.settled(), 400);
  }

  /** The zoom has come to rest. */
  settled() {
    const percent = `${Math.round(this.zoom.nearness * 100)} %`;
    if (this.saidPercent !== undefined && percent !== this.saidPercent) this.app.say(`Zoom ${percent}`);
    this.saidPercent = percent;
    this.remember();
  }

  tell() {
    this.bar.tell({ page: this.page, nearness: this.zoom.nearness, isFit: this.zoom.isFit });
  }

  /** Keeps in the address what is looked at. */
  remember() {
    if (this.hasLeft || this.page === undefined) return;
    const { isFit, nearness, middle } = this.zoom;
    this.app.replace(
      address([this.family.id, this.page], {
        curve: this.forward.chosen === null ? null : curveKey(this.family, this.forward.chosen),
        zoom: isFit ? null : nearness.toFixed(2),
        at: isFit ? null : middle.map((mm) => mm.toFixed(1)).join(","),
      }),
    );
  }

  leave() {
    this.hasLeft = true;
    this.unwatch();
    window.clearTimeout(this.remembering);
    this.zoom.end();
  }
}
