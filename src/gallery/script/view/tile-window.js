// A grid of any number of tiles, of which only those near the window are in the page.

import { h } from "./dom.js";
import { printedCountNote, onPrint } from "./printing.js";

// So much time of a frame, in milliseconds, goes into drawing tiles that have come into sight.
const DRAWING_TIME = 8;
// So much of a window's height above and below it is kept ready.
const TILES_AHEAD = 0.75;
// So many tiles at most, from the first, are printed.
const PRINTED_TILES = 400;

/**
 * A list of `count` tiles in columns of at least `least` pixels, `gap` apart, each `aspect` times as high as
 * wide, and `below` pixels more. `tile(k)` makes one, an element with a link in it, at once; `draw(element,
 * k)` puts in what takes longer, when there is time. `label` names the list.
 */
export class TileWindow {
  constructor(options) {
    Object.assign(this, options);
    this.element = h("ul", {
      class: "window",
      "aria-label": this.label,
      onkeydown: (event) => this.typed(event),
    });
    this.element.style.setProperty("--shape", `1 / ${this.aspect}`);
    this.element.style.setProperty("--least", `${this.least}px`);
    this.there = new Map();
    this.queue = [];
    this.pending = 0;
    this.sizes = new ResizeObserver(() => this.measure());
    const later = () => this.later();
    this.listeners = { scroll: later, resize: later };
  }

  /** The list is in the page, and has a width. */
  shown() {
    this.measure();
    this.sizes.observe(this.element);
    for (const [name, act] of Object.entries(this.listeners))
      window.addEventListener(name, act, { passive: true });
    this.paper = onPrint(
      this.element,
      () => this.printed(),
      () => this.fill(),
    );
  }

  /** Ends what watches the window. */
  end() {
    this.sizes.disconnect();
    this.paper?.end();
    for (const [name, act] of Object.entries(this.listeners)) window.removeEventListener(name, act);
    cancelAnimationFrame(this.pending);
    this.queue = [];
  }

  /** Brings a tile into the window and gives it the focus. */
  show(k) {
    const row = Math.floor(k / this.columns) * this.pitch;
    const at = this.element.getBoundingClientRect().top + window.scrollY + row;
    const isSeen = at >= window.scrollY && at + this.high <= window.scrollY + window.innerHeight;
    if (!isSeen) window.scrollTo(0, at - (window.innerHeight - this.high) / 2);
    this.fill();
    this.there.get(k)?.querySelector("a").focus({ preventScroll: true });
  }

  /** From the top of a row to that of the next, in pixels. */
  get pitch() {
    return this.high + this.gap;
  }

  measure() {
    const { gap, count } = this;
    const room = this.element.clientWidth;
    this.columns = Math.max(1, Math.floor((room + gap) / (Math.min(this.least, room) + gap)));
    this.wide = (room - gap * (this.columns - 1)) / this.columns;
    this.high = Math.round(this.wide * this.aspect) + this.below;
    this.element.style.height = `${Math.ceil(count / this.columns) * this.pitch - gap}px`;
    for (const [k, element] of this.there) this.lay(element, k);
    this.fill();
  }

  /** The size of a tile's picture in pixels: alike of all, since to ask each would lay the page out each time. */
  sizeOfLeaf(picture) {
    if (this.sizedAt !== this.wide) {
      this.sizedAt = this.wide;
      this.leafSize = { width: Math.max(picture.clientWidth, 40), height: Math.max(picture.clientHeight, 40) };
    }
    return this.leafSize;
  }

  lay({ style }, k) {
    style.width = `${this.wide}px`;
    style.height = `${this.high}px`;
    const [x, y] = [(k % this.columns) * (this.wide + this.gap), Math.floor(k / this.columns) * this.pitch];
    style.transform = `translate(${x}px, ${y}px)`;
  }

  later() {
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      if (this.element.isConnected) this.fill();
    });
  }

  /** Has the tiles near the window in the page, and no others but one with the focus. */
  fill() {
    if (this.paper?.isPrinting) return;
    const top = -this.element.getBoundingClientRect().top;
    const ahead = window.innerHeight * TILES_AHEAD;
    const row = (y) => Math.floor(y / this.pitch);
    const first = Math.max(0, row(top - ahead) * this.columns);
    const last = Math.min(this.count, (row(top + window.innerHeight + ahead) + 1) * this.columns);
    for (const [k, element] of this.there) {
      if ((k >= first && k < last) || element.contains(document.activeElement)) continue;
      element.remove();
      this.there.delete(k);
    }
    for (let k = first; k < last; k += 1) this.add(k);
    this.drawSome();
  }

  add(k) {
    if (this.there.has(k)) return;
    const element = this.tile(k);
    element.setAttribute("aria-setsize", this.count);
    element.setAttribute("aria-posinset", k + 1);
    this.lay(element, k);
    // In the order of the tiles, for whoever goes from one to the next.
    const after = Math.min(...[...this.there.keys()].filter((other) => other > k));
    this.element.insertBefore(element, this.there.get(after) ?? null);
    this.there.set(k, element);
    this.queue.push(k);
  }

  drawSome(time = DRAWING_TIME) {
    const end = performance.now() + time;
    this.queue = this.queue.filter((k) => this.there.has(k));
    while (this.queue.length && performance.now() < end) {
      const k = this.queue.shift();
      this.draw(this.there.get(k), k);
    }
    if (this.queue.length) requestAnimationFrame(() => this.drawSome());
  }

  /** Has the first tiles in the page and no others, as they are on paper. */
  printed() {
    const last = Math.min(this.count, PRINTED_TILES);
    for (const [k, element] of this.there) {
      if (k < last) continue;
      element.remove();
      this.there.delete(k);
    }
    for (let k = 0; k < last; k += 1) this.add(k);
    this.drawSome(Infinity);
    return printedCountNote(last, this.count, this.label.toLowerCase());
  }

  typed(event) {
    const at = [...this.there].find(([, element]) => element.contains(event.target))?.[0];
    if (at === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    const screen = Math.max(1, Math.floor(window.innerHeight / this.pitch)) * this.columns;
    const to = {
      ArrowRight: at + 1,
      ArrowLeft: at - 1,
      ArrowDown: at + this.columns,
      ArrowUp: at - this.columns,
      PageDown: at + screen,
      PageUp: at - screen,
      Home: 0,
      End: this.count - 1,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.show(Math.min(Math.max(to, 0), this.count - 1));
  }
}
