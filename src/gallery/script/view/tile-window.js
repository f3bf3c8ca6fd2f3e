// A grid of any number of tiles, of which only those near the window are in the document.

import { h } from "./dom.js";
import { printedCountNote, onPrint } from "./printing.js";

// The time per frame, in milliseconds, for drawing tiles that have become visible.
const DRAWING_TIME = 8;
// The fraction of the window's height above and below it that is kept ready.
const TILES_AHEAD = 0.75;
// The maximum number of tiles printed.
const PRINTED_TILES = 400;

/**
 * A list of `count` tiles in columns of at least `least` pixels, `gap` apart, with pictures of aspect ratio
 * `aspect` (height to width) and `below` pixels for text. `tile(k)` creates a tile, an element with a link in
 * it; `draw(element, k)` adds what takes longer, when there is time. `label` names the list.
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

  /** Called when the list is in the document and has a width. */
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

  /** Stops observing the window. */
  end() {
    this.sizes.disconnect();
    this.paper?.end();
    for (const [name, act] of Object.entries(this.listeners)) window.removeEventListener(name, act);
    cancelAnimationFrame(this.pending);
    this.queue = [];
  }

  /** Scrolls to a tile and focuses it. */
  show(k) {
    const row = Math.floor(k / this.columns) * this.pitch;
    const at = this.element.getBoundingClientRect().top + window.scrollY + row;
    const isSeen = at >= window.scrollY && at + this.high <= window.scrollY + window.innerHeight;
    if (!isSeen) window.scrollTo(0, at - (window.innerHeight - this.high) / 2);
    this.fill();
    this.there.get(k)?.querySelector("a").focus({ preventScroll: true });
  }

  /** The vertical distance of rows, in pixels. */
  get pitch() {
    return this.high + this.gap;
  }

  measure() {
    const { gap, count } = this;
    const width = this.element.clientWidth;
    this.columns = Math.max(1, Math.floor((width + gap) / (Math.min(this.least, width) + gap)));
    this.wide = (width - gap * (this.columns - 1)) / this.columns;
    this.high = Math.round(this.wide * this.aspect) + this.below;
    this.element.style.height = `${Math.ceil(count / this.columns) * this.pitch - gap}px`;
    for (const [k, element] of this.there) this.lay(element, k);
    this.fill();
  }

  /** The size of a tile's picture in pixels. All are alike, and measuring each would force a layout. */
  sizeOfPicture(picture) {
    if (this.sizedAt !== this.wide) {
      this.sizedAt = this.wide;
      this.pictureSize = {
        width: Math.max(picture.clientWidth, 40),
        height: Math.max(picture.clientHeight, 40),
      };
    }
    return this.pictureSize;
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

  /** Puts the tiles near the window into the document, and removes others except one with the focus. */
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
    // In tile order, for keyboard navigation.
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

  /** Puts the first tiles into the document, and no others, for printing. */
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
