// The frame of the gallery: its heading, the ways to its rooms, the room itself, and what stands below.

import { address, parseAddress } from "../data/address.js";
import { fill, h } from "./dom.js";
import { themeSelect } from "./settings.js";
import { scrollMemory } from "./scroll-memory.js";
import { footer } from "./footer.js";

// A room that takes longer than this to open, in milliseconds, says that it is being opened.
const BUSY_DELAY = 250;

/**
 * Opens the gallery in an element. `rooms` are [{ name, label, way(app), under, opens(place, app),
 * view(app, place) }]: the first whose `opens` is true of an address shows it; `way` is the address of one
 * with a label, and one without stands `under` another. A view is, perhaps in a while, { element, title,
 * update(place), shown(), leave() }: `update`, where there is one, is told of further addresses of the same
 * room, and says whether it shows them; `shown` is called when the element is in the page; `leave` ends what
 * it began.
 */
export function openShell(app, rooms, root) {
  const main = h("main", { id: "content", tabindex: "-1" });
  const status = h("p", { class: "visually-hidden", role: "status", "aria-live": "polite" });
  const ways = navigation(app, rooms);
  app.say = (text) => {
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
    h("a", { class: "skip", href: "#content", onclick: skip }, "Skip to the content"),
    h(
      "header",
      { class: "masthead" },
      h("a", { class: "title", href: address([]) }, app.atlas.title),
      ways.element,
      themeSelect(),
    ),
    main,
    footer(app.atlas),
    status,
  );
  const shower = new Router(app, rooms, { main, ways, scroll: scrollMemory() });
  app.replace = (fragment) => {
    // A link that was just followed goes before what a view still has to remember: its event is to come.
    if (window.location.hash !== shower.fragment) return;
    window.history.replaceState(window.history.state, "", fragment);
    shower.fragment = window.location.hash;
  };
  window.addEventListener("hashchange", () => shower.show());
  return shower.show();
}

/** The ways to the rooms, { element, mark(room) }; that to the pins says how many there are. */
function navigation(app, rooms) {
  const count = h("span", { class: "count" });
  const links = new Map(
    rooms
      .filter(({ label }) => label)
      .map(({ name, label, way }) => [
        name,
        h("a", { href: way(app) }, label, name === "compare" ? count : null),
      ]),
  );
  const counted = (names) =>
    fill(count, names.length ? ` ${names.length}` : "", names.length ? pinned() : null);
  const pinned = () => h("span", { class: "visually-hidden" }, " pinned");
  app.pins.watch(counted);
  counted(app.pins.names);
  const mark = (room) => {
    for (const [name, link] of links) {
      link.setAttribute("href", rooms.find((candidate) => candidate.name === name).way(app));
      if (name === (room?.under ?? room?.name)) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
  };
  app.pins.watch(() => {
    const compare = rooms.find(({ name }) => name === "compare");
    links.get("compare").setAttribute("href", compare.way(app));
  });
  return { element: h("nav", { class: "site-nav", "aria-label": "Gallery" }, [...links.values()]), mark };
}

/** What shows the room that the address says. */
class Router {
  constructor(app, rooms, { main, ways, scroll }) {
    Object.assign(this, { app, rooms, main, ways, scroll });
    [this.shown, this.turn, this.fragment] = [null, 0, null];
  }

  /** Shows what the address says, in the view that is there if it can, or else in a new one. */
  async show() {
    this.fragment = window.location.hash;
    const place = parseAddress(this.fragment);
    const room = this.rooms.find((candidate) => candidate.opens(place, this.app));
    this.scroll.leave();
    if (this.shown && this.shown.room === room && this.shown.view.update?.(place)) {
      this.entitle(this.shown.view.title);
      return;
    }
    this.turn += 1;
    const mine = this.turn;
    // What was there rests, and is seen until there is something in its place.
    this.shown?.view.leave?.();
    this.shown = null;
    this.ways.mark(room);
    const waiting = window.setTimeout(() => this.wait(), BUSY_DELAY);
    try {
      if (!room) throw new Error("There is nothing at this address.");
      const view = await room.view(this.app, place);
      if (mine === this.turn) this.enter(room, view);
      else view.leave?.();
    } catch (error) {
      if (mine === this.turn) this.trouble(error.message, place);
    } finally {
      window.clearTimeout(waiting);
      if (mine === this.turn) this.main.removeAttribute("aria-busy");
    }
  }

  wait() {
    this.main.setAttribute("aria-busy", "true");
    this.app.say("Opening");
  }

  enter(room, view) {
    this.shown = { room, view };
    this.entitle(view.title);
    fill(this.main, view.element);
    view.shown?.();
    this.scroll.arrive();
    // The first view takes the focus only if it wants to; and where there is something to look at, it has it
    // already.
    if (this.turn === 1) return;
    if (!this.main.contains(document.activeElement)) this.main.focus({ preventScroll: true });
    this.app.say(view.title || this.app.atlas.title);
  }

  /** Says what is wrong with an address, and where to go on from there. */
  trouble(message, { path: [id] }) {
    const sentence = `${message[0].toUpperCase()}${message.slice(1)}`.replace(/[^.]$/, "$&.");
    this.entitle("Not found");
    this.app.say(sentence);
    const family = this.app.atlas.families.find((candidate) => candidate.id === id);
    const own = family ? [h("a", { href: address([id]) }, family.title), ", "] : null;
    const all = h("a", { href: address([]) }, "All families");
    fill(this.main, h("p", { class: "error", role: "alert" }, sentence, " ", own, all));
  }

  entitle(title) {
    document.title = title ? `${title} · ${this.app.atlas.title}` : this.app.atlas.title;
  }
}
