// The frame of the gallery: its heading, the ways to its rooms, the room itself, and what stands below.

import { address, parsedAddress } from "../data/address.js";
import { fill, h } from "./dom.js";
import { themeChoice } from "./settings.js";
import { scrollMemory } from "./shell-scroll.js";
import { footer } from "./shell-footer.js";

// A room that takes longer than this to open, in milliseconds, says that it is being opened.
const OPENING_PATIENCE = 250;

/**
 * Opens the gallery in an element. `rooms` are [{ name, label, under, opens(place), view(app, place) }]: the
 * first whose `opens` is true of an address shows it; one without a label stands `under` another. A view is,
 * perhaps in a while, { element, title, update(place), shown(), leave() }: `update`, where there is one, is
 * told of further addresses of the same room, and says whether it shows them; `shown` is called when the
 * element is in the page; `leave` ends what it began.
 */
export function openShell(app, rooms, root) {
  const main = h("main", { id: "room", tabindex: "-1" });
  const status = h("p", { class: "unseen", role: "status", "aria-live": "polite" });
  const ways = waysToRooms(app, rooms);
  const scroll = scrollMemory();
  app.say = (text) => {
    status.textContent = text;
  };
  app.go = (fragment) => {
    window.location.hash = fragment;
  };
  app.replace = (fragment) => window.history.replaceState(window.history.state, "", fragment);
  const skip = (event) => {
    event.preventDefault();
    main.focus();
  };
  fill(
    root,
    h("a", { class: "skip", href: "#room", onclick: skip }, "Skip to the content"),
    h(
      "header",
      { class: "masthead" },
      h("a", { class: "title", href: address([]) }, app.atlas.title),
      ways.element,
      themeChoice(),
    ),
    main,
    footer(app.atlas),
    status,
  );
  const show = roomShower(app, rooms, { main, ways, scroll });
  window.addEventListener("hashchange", show);
  return show();
}

/** The ways to the rooms, { element, mark(room) }; that to the pins says how many there are. */
function waysToRooms(app, rooms) {
  const count = h("span", { class: "count" });
  const links = new Map(
    rooms
      .filter(({ label }) => label)
      .map(({ name, label, way }) => [
        name,
        h("a", { href: way ? way(app) : address([name]) }, label, name === "compare" ? count : null),
      ]),
  );
  const counted = (names) =>
    fill(count, names.length ? ` ${names.length}` : "", names.length ? pinned() : null);
  const pinned = () => h("span", { class: "unseen" }, " pinned");
  app.pins.watch(counted);
  counted(app.pins.names);
  const mark = (room) => {
    for (const [name, link] of links) {
      const { way } = rooms.find((candidate) => candidate.name === name);
      if (way) link.setAttribute("href", way(app));
      if (name === (room?.under ?? room?.name)) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
  };
  app.pins.watch(() => {
    const compare = rooms.find(({ name }) => name === "compare");
    if (compare?.way) links.get("compare")?.setAttribute("href", compare.way(app));
  });
  return { element: h("nav", { class: "ways", "aria-label": "Gallery" }, [...links.values()]), mark };
}

/** A function that shows what the address says. */
function roomShower(app, rooms, { main, ways, scroll }) {
  let shown = null;
  let turn = 0;
  const entitle = (title) => {
    document.title = title ? `${title} · ${app.atlas.title}` : app.atlas.title;
  };
  const trouble = (sentence) => {
    entitle("Not found");
    app.say(sentence);
    fill(
      main,
      h(
        "p",
        { class: "trouble", role: "alert" },
        sentence,
        " ",
        h("a", { href: address([]) }, "All families"),
      ),
    );
  };
  const enter = (room, view) => {
    shown = { room, view };
    entitle(view.title);
    fill(main, view.element);
    view.shown?.();
    scroll.arrive();
    // The first view takes the focus only if it wants to; and where there is something to look at, it has it
    // already.
    if (turn === 1) return;
    if (!main.contains(document.activeElement)) main.focus({ preventScroll: true });
    app.say(view.title || app.atlas.title);
  };
  return async () => {
    const place = parsedAddress(window.location.hash);
    const room = rooms.find((candidate) => candidate.opens(place, app));
    scroll.leave();
    if (shown && shown.room === room && shown.view.update?.(place)) {
      entitle(shown.view.title);
      return;
    }
    turn += 1;
    const mine = turn;
    // What was there rests, and is seen until there is something in its place.
    shown?.view.leave?.();
    shown = null;
    ways.mark(room);
    const waiting = window.setTimeout(() => {
      main.setAttribute("aria-busy", "true");
      app.say("Opening");
    }, OPENING_PATIENCE);
    try {
      if (!room) throw new Error("There is nothing at this address.");
      const view = await room.view(app, place);
      if (mine === turn) enter(room, view);
      else view.leave?.();
    } catch (error) {
      if (mine === turn) trouble(error.message);
    } finally {
      window.clearTimeout(waiting);
      if (mine === turn) main.removeAttribute("aria-busy");
    }
  };
}
