// The frame of the gallery: header, navigation, the current view and footer.

import { address, parseAddress } from "../data/address.js";
import { fill, h } from "./dom.js";
import { themeSelect } from "./settings.js";
import { scrollMemory } from "./scroll-memory.js";
import { footer } from "./footer.js";

// The time in milliseconds after which opening a view is announced.
const BUSY_DELAY = 250;

/**
 * Opens the gallery in an element. `routes` are [{ name, label, href(app), parent, matches(target, app),
 * open(app, target) }]: the first whose `matches` is true for an address opens it. A route with a label is in
 * the navigation, with the link `href`; one without belongs to its `parent`. `open` returns a view, or a
 * promise of one: { element, title, update(target), shown(), leave() }. The optional `update` is called with
 * further addresses of the same route and returns whether it handles them; `shown` is called when the element
 * is in the document; `leave` releases resources.
 */
export function openShell(app, routes, root) {
  const main = h("main", { id: "content", tabindex: "-1" });
  const status = h("p", { class: "visually-hidden", role: "status", "aria-live": "polite" });
  const nav = navigation(app, routes);
  app.announce = (text) => {
    status.textContent = text;
  };
  app.go = (fragment) => {
    window.location.hash = fragment;
  };
  const skip = (event) => {
    event.preventDefault();
    main.focus();
  };
  fill(
    root,
    h("a", { class: "skip", href: "#content", onclick: skip }, "Skip to content"),
    h(
      "header",
      { class: "masthead" },
      h("a", { class: "title", href: address([]) }, app.atlas.title),
      nav.element,
      themeSelect(),
    ),
    main,
    footer(app.atlas),
    status,
  );
  const router = new Router(app, routes, { main, nav, scroll: scrollMemory() });
  app.replace = (fragment) => {
    // A link that was just followed takes precedence over a view's update: its event is pending.
    if (window.location.hash !== router.fragment) return;
    window.history.replaceState(window.history.state, "", fragment);
    router.fragment = window.location.hash;
  };
  window.addEventListener("hashchange", () => router.navigate());
  return router.navigate();
}

/** The navigation, { element, mark(route) }, with the number of pins. */
function navigation(app, routes) {
  const count = h("span", { class: "count" });
  const links = new Map(
    routes
      .filter(({ label }) => label)
      .map(({ name, label, href }) => [
        name,
        h("a", { href: href(app) }, label, name === "compare" ? count : null),
      ]),
  );
  const showCount = (names) =>
    fill(count, names.length ? ` ${names.length}` : "", names.length ? pinned() : null);
  const pinned = () => h("span", { class: "visually-hidden" }, " pinned");
  app.pins.watch(showCount);
  showCount(app.pins.names);
  const mark = (route) => {
    for (const [name, link] of links) {
      link.setAttribute("href", routes.find((candidate) => candidate.name === name).href(app));
      if (name === (route?.parent ?? route?.name)) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
  };
  app.pins.watch(() => {
    const compare = routes.find(({ name }) => name === "compare");
    links.get("compare").setAttribute("href", compare.href(app));
  });
  return { element: h("nav", { class: "site-nav", "aria-label": "Gallery" }, [...links.values()]), mark };
}

/** Opens the view of the current address. */
class Router {
  constructor(app, routes, { main, nav, scroll }) {
    Object.assign(this, { app, routes, main, nav, scroll });
    [this.shown, this.turn, this.fragment] = [null, 0, null];
  }

  /** Shows the address in the current view if it handles it, otherwise in a new one. */
  async navigate() {
    this.fragment = window.location.hash;
    const target = parseAddress(this.fragment);
    const route = this.routes.find((candidate) => candidate.matches(target, this.app));
    this.scroll.leave();
    if (this.shown && this.shown.route === route && this.shown.view.update?.(target)) {
      this.setTitle(this.shown.view.title);
      return;
    }
    this.turn += 1;
    const turn = this.turn;
    // The previous view stays visible until the next one is ready.
    this.shown?.view.leave?.();
    this.shown = null;
    this.nav.mark(route);
    const waiting = window.setTimeout(() => this.showBusy(), BUSY_DELAY);
    try {
      if (!route) throw new Error("There is no page at this address.");
      const view = await route.open(this.app, target);
      if (turn === this.turn) this.showView(route, view);
      else view.leave?.();
    } catch (error) {
      if (turn === this.turn) this.showError(error.message, target);
    } finally {
      window.clearTimeout(waiting);
      if (turn === this.turn) this.main.removeAttribute("aria-busy");
    }
  }

  showBusy() {
    this.main.setAttribute("aria-busy", "true");
    this.app.announce("Loading");
  }

  showView(route, view) {
    this.shown = { route, view };
    this.setTitle(view.title);
    fill(this.main, view.element);
    view.shown?.();
    this.scroll.arrive();
    // The first view does not take the focus; later ones do, unless they have set it.
    if (this.turn === 1) return;
    if (!this.main.contains(document.activeElement)) this.main.focus({ preventScroll: true });
    this.app.announce(view.title || this.app.atlas.title);
  }

  /** Shows what is wrong with an address, with links to continue. */
  showError(message, { path: [id] }) {
    const sentence = `${message[0].toUpperCase()}${message.slice(1)}`.replace(/[^.]$/, "$&.");
    this.setTitle("Not found");
    this.app.announce(sentence);
    const family = this.app.atlas.families.find((candidate) => candidate.id === id);
    const own = family ? [h("a", { href: address([id]) }, family.title), ", "] : null;
    const all = h("a", { href: address([]) }, "All families");
    fill(this.main, h("p", { class: "error", role: "alert" }, sentence, " ", own, all));
  }

  setTitle(title) {
    document.title = title ? `${title} · ${this.app.atlas.title}` : this.app.atlas.title;
  }
}
