// A grid of any number of tiles, of which only those near the window are in the page.

import { h } from "./dom.js";

// So much time of a frame, in milliseconds, goes into drawing tiles that have come into sight.
const DRAWING_TIME = 8;
// So many tiles at most, from the first, are printed.
const PRINTED_TILES = 400;

/**
 * A list of `count` tiles in columns of at least `least` pixels, each `aspect` times as high as wide, and `below` pixels more.
 * `tile(k)` makes one, an element, at once; `draw(element, k)` puts in what takes longer, when there is time. `label` names
 * the list. Returns { element, shown(), show(k), end() }: `show` brings a tile into the window and marks it.
 */
export function windowedTiles({ count, least, gap, aspect, below, label, tile, draw }) {
  const list = h("ul", { class: "window", "aria-label": label, onkeydown: (event) => typed(event) });
  const there = new Map();
  let queue = [];
  let [columns, wide, high, pending] = [1, least, least, 0];

  const measure = () => {
    const room = list.clientWidth;
    columns = Math.max(1, Math.floor((room + gap) / (Math.min(least, room) + gap)));
    wide = (room - gap * (columns - 1)) / columns;
    high = Math.round(wide * aspect) + below;
    list.style.height = `${Math.ceil(count / columns) * (high + gap) - gap}px`;
    for (const [k, element] of there) lay(element, k);
    fillWindow();
  };
  const lay = (element, k) => {
    element.style.width = `${wide}px`;
    element.style.height = `${high}px`;
    element.style.transform = `translate(${(k % columns) * (wide + gap)}px, ${Math.floor(k / columns) * (high + gap)}px)`;
  };
  const add = (k) => {
    if (there.has(k)) return;
    const element = tile(k);
    element.setAttribute("aria-setsize", count);
    element.setAttribute("aria-posinset", k + 1);
    lay(element, k);
    // In the order of the tiles, for whoever goes from one to the next.
    const after = [...there.keys()].filter((other) => other > k);
    list.insertBefore(element, after.length ? there.get(Math.min(...after)) : null);
    there.set(k, element);
    queue.push(k);
  };
  const fillWindow = () => {
    const top = -list.getBoundingClientRect().top;
    const ahead = window.innerHeight * 0.75;
    const row = (y) => Math.floor(y / (high + gap));
    const first = Math.max(0, row(top - ahead) * columns);
    const last = Math.min(count, (row(top + window.innerHeight + ahead) + 1) * columns);
    for (const [k, element] of there) {
      if ((k >= first && k < last) || element.contains(document.activeElement)) continue;
      element.remove();
      there.delete(k);
    }
    for (let k = first; k < last; k += 1) add(k);
    drawSome();
  };
  const drawSome = () => {
    const end = performance.now() + DRAWING_TIME;
    queue = queue.filter((k) => there.has(k));
    while (queue.length && performance.now() < end) {
      const k = queue.shift();
      draw(there.get(k), k);
    }
    if (queue.length) requestAnimationFrame(drawSome);
  };
  const scrolled = () => {
    pending ||= requestAnimationFrame(() => {
      pending = 0;
      if (list.isConnected) fillWindow();
    });
  };
  const reach = (k) => {
    const at = list.getBoundingClientRect().top + window.scrollY + Math.floor(k / columns) * (high + gap);
    const isSeen = at >= window.scrollY && at + high <= window.scrollY + window.innerHeight;
    if (!isSeen) window.scrollTo(0, at - (window.innerHeight - high) / 2);
    fillWindow();
    return there.get(k);
  };
  const focus = (k) => reach(Math.min(Math.max(k, 0), count - 1))?.querySelector("a").focus({ preventScroll: true });
  const typed = (event) => {
    const at = [...there].find(([, element]) => element.contains(event.target))?.[0];
    if (at === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    const screen = Math.max(1, Math.floor(window.innerHeight / (high + gap))) * columns;
    const to = {
      ArrowRight: at + 1, ArrowLeft: at - 1, ArrowDown: at + columns, ArrowUp: at - columns,
      PageDown: at + screen, PageUp: at - screen, Home: 0, End: count - 1,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    focus(to);
  };
  const printed = () => {
    for (let k = 0; k < Math.min(count, PRINTED_TILES); k += 1) add(k);
    queue.filter((k) => there.has(k)).forEach((k) => draw(there.get(k), k));
    queue = [];
  };
  const sizes = new ResizeObserver(measure);
  list.style.setProperty("--shape", `1 / ${aspect}`);
  return {
    element: list,
    shown: () => {
      measure();
      sizes.observe(list);
      window.addEventListener("scroll", scrolled, { passive: true });
      window.addEventListener("resize", scrolled);
      window.addEventListener("beforeprint", printed);
      window.addEventListener("afterprint", scrolled);
    },
    show: focus,
    end: () => {
      sizes.disconnect();
      window.removeEventListener("scroll", scrolled);
      window.removeEventListener("resize", scrolled);
      window.removeEventListener("beforeprint", printed);
      window.removeEventListener("afterprint", scrolled);
      cancelAnimationFrame(pending);
      queue = [];
    },
  };
}
