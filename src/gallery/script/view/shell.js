// The frame of the gallery: its heading, the ways to its rooms, and the room itself.

import { address, parsedAddress } from "../data/address.js";
import { fill, h } from "./dom.js";

/**
 * Opens the gallery in an element. `rooms` are [{ name, label, opens(place) , view(app, place) }]: the first whose `opens` is
 * true of an address shows it. A view is, perhaps in a while, { element, title, update(place), leave() }: `update`, where
 * there is one, is told of further addresses of the same room, and says whether it shows them; `leave` ends what it began.
 */
export function openShell(app, rooms, root) {
  const main = h("main", { id: "room", tabindex: "-1" });
  const status = h("p", { class: "unseen", role: "status", "aria-live": "polite" });
  const ways = h("nav", { class: "ways", "aria-label": "Gallery" });
  const count = h("span", { class: "count" });
  app.say = (text) => { status.textContent = text; };
  app.go = (fragment) => { window.location.hash = fragment; };
  app.replace = (fragment) => window.history.replaceState(null, "", fragment);
  fill(
    root,
    h("a", { class: "skip", href: "#room", onclick: (event) => { event.preventDefault(); main.focus(); } }, "Skip to the content"),
    h("header", { class: "masthead" }, h("a", { class: "title", href: address([]) }, app.atlas.title), ways),
    main,
    status,
  );
  app.pins.watch((names) => fill(count, names.length ? ` ${names.length}` : ""));
  let shown = null;
  let turn = 0;
  const show = async () => {
    const place = parsedAddress(window.location.hash);
    const room = rooms.find((candidate) => candidate.opens(place));
    if (shown?.room === room && shown.view.update?.(place)) return;
    turn += 1;
    const mine = turn;
    shown?.view.leave?.();
    shown = null;
    fill(ways, rooms.filter(({ label }) => label).map(({ name, label, way }) => h(
      "a",
      { href: way ? way(app) : address([name]), "aria-current": room.name === name ? "page" : null },
      label,
      name === "compare" ? count : null,
    )));
    try {
      const view = await room.view(app, place);
      if (mine !== turn) return;
      shown = { room, view };
      document.title = view.title ? `${view.title} · ${app.atlas.title}` : app.atlas.title;
      fill(main, view.element);
    } catch (error) {
      if (mine === turn) fill(main, h("p", { class: "trouble", role: "alert" }, error.message));
    }
  };
  window.addEventListener("hashchange", show);
  return show();
}
