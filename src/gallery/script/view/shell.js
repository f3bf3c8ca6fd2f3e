// The frame of the gallery: header, navigation, the current view and footer.

import { address, parseAddress } from "../data/address.js";
import { sumOf } from "../data/number.js";
import { buttonOf, fill, h, setAttributes } from "./dom.js";
import { Gestures, gestureOfKey, onKeys, showKeys } from "./keys.js";
import { themeSelect } from "./settings.js";
import { scrollMemory } from "./scroll-memory.js";
import { formatBytes, formatCount } from "./labels.js";

// The time in milliseconds after which opening a view is announced.
const BUSY_DELAY = 250;

/**
 * Opens the gallery in an element. The first route that matches an address opens it.
 * @param {Pick<App, "atlas" | "kernel" | "pins">} parts @param {Route[]} routes @param {HTMLElement} root
 */
export function openShell(parts, routes, root) {
  const main = h("main", { id: "content", tabindex: "-1" });
  const ignored = h("output.note.ignored");
  const status = h("p.visually-hidden", { role: "status", "aria-live": "polite" });
  /** @type {App} */ const app = {
    ...parts,
    announce: (text) => {
      status.textContent = text;
    },
    go: (fragment) => {
      window.location.hash = fragment;
    },
    replace: (fragment) => {
      // A link that was just followed takes precedence over a view's update: its event is pending.
      if (window.location.hash !== router.fragment) return;
      window.history.replaceState(window.history.state, "", fragment);
      router.fragment = window.location.hash;
    },
    commit: (fragment) => {
      const before = router.fragment;
      app.replace(fragment);
      if (router.fragment === before) return;
      router.gestures.record(before);
      router.query = null;
      fill(ignored);
    },
  };
  const nav = navigation(app, routes);
  const skip = (/** @type {Event} */ event) => {
    event.preventDefault();
    main.focus();
  };
  const { atlas } = app;
  const { plate } = atlas;
  if (plate && !window.location.hash) window.history.replaceState(null, "", plate.address);
  const title = h("a.title", { href: plate?.address ?? address([]) }, atlas.title);
  const masthead = h("header.masthead", title, plate ? null : nav.element, themeSelect());
  const toContent = h("a.skip", { href: "#content", onclick: skip }, "Skip to content");
  const end = footer(atlas, () => router.showKeys());
  onKeys(end, "In all views", [["?", "list the keys", () => router.showKeys()]], window);
  fill(root, toContent, masthead, ignored, main, end, status);
  const router = new Router(app, routes, { main, nav, ignored, scroll: scrollMemory() });
  window.addEventListener("hashchange", () => router.navigate());
  window.addEventListener("keydown", (event) => {
    const way = gestureOfKey(event);
    if (way === 0) return;
    event.preventDefault();
    router.retrace(way);
  });
  return router.navigate();
}

/** The navigation, { element, mark(route) }, with the number of pins. */
function navigation(/** @type {App} */ app, /** @type {Route[]} */ routes) {
  const count = h("span.count");
  const links = routes.flatMap((route) => {
    const { name, label, href } = route;
    if (!label || !href) return [];
    const link = h("a", { href: href(app) }, label, name === "compare" ? count : null);
    return [{ name, link, update: () => setAttributes(link, { href: href(app) }) }];
  });
  const update = () => {
    const { length } = app.pins.names;
    fill(count, length ? [` ${length}`, h("span.visually-hidden", " pinned")] : null);
    links.forEach((link) => link.update());
  };
  app.pins.watch(update);
  update();
  const mark = (/** @type {Route | undefined} */ route) => {
    update();
    for (const { name, link } of links)
      setAttributes(link, { "aria-current": name === (route?.parent ?? route?.name) ? "page" : null });
  };
  const shown = links.map(({ link }) => link);
  return { element: h("nav.site-nav", { "aria-label": "Gallery" }, shown), mark };
}

/** Opens the view of the current address. */
class Router {
  /** @type {{ route: Route, view: View } | null} */ shown = null;
  turn = 0;
  fragment = "";
  /** The query that is shown. @type {AddressQuery | null} */ query = null;
  /** What can be undone in the view that is shown. */ gestures = new Gestures();

  /**
   * @param {App} app @param {Route[]} routes @param {{ main: HTMLElement, nav: ReturnType<typeof navigation>, ignored: HTMLElement, scroll: ReturnType<typeof scrollMemory> }} _
   */
  constructor(app, routes, { main, nav, ignored, scroll }) {
    this.app = app;
    this.routes = routes;
    this.main = main;
    this.nav = nav;
    this.ignored = ignored;
    this.scroll = scroll;
  }

  /** Shows the address in the current view if it handles it, otherwise in a new one; one that was shown before if a gesture is retraced. */
  async navigate(isRetraced = false) {
    this.fragment = window.location.hash;
    const target = parseAddress(this.fragment);
    const route = this.routes.find((candidate) => candidate.matches(target, this.app));
    this.scroll.leave();
    if (this.shown && this.shown.route === route && this.shown.view.update?.(target, isRetraced)) {
      this.setTitle(this.shown.view.title);
      this.sayIgnored(target);
      return;
    }
    this.query = null;
    fill(this.ignored);
    this.turn += 1;
    const turn = this.turn;
    this.gestures = new Gestures();
    // The previous view stays visible until the next one is ready.
    this.shown?.view.leave?.();
    this.shown = null;
    this.nav.mark(route);
    const waiting = window.setTimeout(() => this.showBusy(), BUSY_DELAY);
    try {
      const isPlate = this.app.atlas.plate !== undefined;
      if (!route)
        throw new Error(isPlate ? "This file has only one plate." : "There is no page at this address.");
      const view = await route.open(this.app, target);
      if (turn === this.turn) {
        this.showView(route, view);
        this.sayIgnored(target);
      } else view.leave?.();
    } catch (error) {
      if (turn === this.turn) this.showError(error.message, target);
    } finally {
      window.clearTimeout(waiting);
      if (turn === this.turn) this.main.removeAttribute("aria-busy");
    }
  }

  /** Undoes (-1) or repeats (1) a gesture: shows the address before or after it. */
  retrace(/** @type {number} */ way) {
    const { gestures, app } = this;
    const fragment = way < 0 ? gestures.undo(this.fragment) : gestures.redo(this.fragment);
    if (fragment === undefined) {
      app.announce(way < 0 ? "Nothing to undo" : "Nothing to redo");
      return;
    }
    window.history.replaceState(window.history.state, "", fragment);
    app.announce(way < 0 ? "Undone" : "Redone");
    this.navigate(true);
  }

  /** Says what of an address is ignored, now and when more is. @param {Target} target */
  sayIgnored({ query }) {
    this.query = query;
    query.onignore = () => this.query === query && fill(this.ignored, query.ignored);
    query.onignore();
  }

  /** Lists the keys; those of gestures if there is one. */
  showKeys() {
    const { past, future } = this.gestures;
    showKeys(past.length || future.length ? [["Ctrl+Z Ctrl+Shift+Z", "undo; repeat what was undone"]] : []);
  }

  showBusy() {
    this.main.setAttribute("aria-busy", "true");
    this.app.announce("Loading");
  }

  showView(/** @type {Route} */ route, /** @type {View} */ view) {
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
  showError(/** @type {string} */ message, /** @type {Target} */ { path: [id] }) {
    const sentence = `${message[0].toUpperCase()}${message.slice(1)}`.replace(/[^.]$/, "$&.");
    this.setTitle("Not found");
    this.app.announce(sentence);
    const family = this.app.atlas.families.find((candidate) => candidate.id === id);
    const own = family ? [h("a", { href: address([id]) }, family.title), ", "] : null;
    const { plate } = this.app.atlas;
    const href = plate?.address ?? address([]);
    const all = h("a", { href }, plate ? "The plate" : "All families");
    fill(this.main, h("h1", "Not found"), h("p.error", { role: "alert" }, sentence, " ", own, all));
  }

  setTitle(/** @type {string} */ title) {
    document.title = title ? `${title} · ${this.app.atlas.title}` : this.app.atlas.title;
  }
}

/** The footer of the gallery. @param {Atlas} atlas */
function footer(atlas, /** @type {() => void} */ listKeys) {
  const { families } = atlas;
  const [pages, curves] = [sumOf(families, (one) => one.pages), sumOf(families, (one) => one.curves)];
  const bytes = sumOf(families, (one) => one.bytes);
  const facts = [
    formatCount(families.length, "family", "families"),
    formatCount(pages, "page"),
    formatCount(curves, "curve"),
    `${formatBytes(bytes)} of data, loaded by family`,
  ];
  const books = atlas.book.map((file) => [h("a", { href: file }, `Book: ${file}`), " · "]);
  const keys = buttonOf("Keys", listKeys, { class: "quiet", "aria-keyshortcuts": "?" });
  const words = atlas.plate
    ? "One plate of the atlas, with all that it needs in this file"
    : facts.join(" · ");
  return h("footer.footer", h("p", words), h("p", books, `Generated by ${atlas.program}`, keys));
}
