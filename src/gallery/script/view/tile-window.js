// A grid of any number of tiles, of which only those near the window are in the document.

import { whenLoaded } from "../data/needs.js";
import { h } from "./dom.js";
import { MAX_HEIGHT, scrollScale } from "./long-scroll.js";
import { printedCountNote, onPrint } from "./printing.js";

// The time per frame, in milliseconds, for drawing tiles that have become visible.
const DRAWING_TIME = 8;
// The fraction of the window's height above and below it that is kept ready.
const TILES_AHEAD = 0.75;
// While the list is scrolled further than this at a time, in window heights, as by its scroll bar, nothing is
// loaded until it has rested for as many milliseconds.
const LONG_JUMP = 4;
const JUMP_DELAY = 100;
// The maximum number of tiles printed.
const PRINTED_TILES = 400;

/**
 * A list of `count` tiles in columns of at least `least` pixels, `gap` apart, with pictures of aspect ratio
 * `aspect` (height to width) and `below` pixels for text. `tile(k)` creates a tile, an element with a link in
 * it. `need(k)` loads what a tile shows: null if it is there, else a promise (data/needs.js); then
 * `fillTile(element, k)` adds its text, and `draw(element, k)` what takes longer, when there is time.
 * `failed(message)` is called if something cannot be loaded. `label` names the list.
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
    this.drawing = 0;
    [this.scale, this.shifted] = [1, 0];
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
    window.clearTimeout(this.postponed);
    cancelAnimationFrame(this.pending);
    cancelAnimationFrame(this.drawing);
    this.there.clear();
    this.queue = [];
  }

  /** Scrolls to a tile and focuses it. */
  show(k) {
    const row = Math.floor(k / this.columns) * this.pitch;
    const top = this.element.getBoundingClientRect().top;
    const at = top + row - this.shift(-top);
    const isSeen = at >= 0 && at + this.high <= window.innerHeight;
    const ahead = Math.max(row - (window.innerHeight - this.high) / 2, -top - window.scrollY);
    if (!isSeen) window.scrollTo(0, top + window.scrollY + ahead / (ahead > 0 ? this.scale : 1));
    this.fill();
    this.there.get(k)?.querySelector("a").focus({ preventScroll: true });
  }

  /** The vertical distance of rows, in pixels. */
  get pitch() {
    return this.high + this.gap;
  }

  /** The height by which tiles are moved up when the list is scrolled by `top` pixels, if it is too high. */
  shift(top) {
    return Math.max(top, 0) * (this.scale - 1);
  }

  measure() {
    const { gap, count } = this;
    const width = this.element.clientWidth;
    this.columns = Math.max(1, Math.floor((width + gap) / (Math.min(this.least, width) + gap)));
    this.wide = (width - gap * (this.columns - 1)) / this.columns;
    this.high = Math.round(this.wide * this.aspect) + this.below;
    const height = Math.ceil(count / this.columns) * this.pitch - gap;
    this.scale = scrollScale(height, window.innerHeight);
    this.element.style.height = `${Math.min(height, MAX_HEIGHT)}px`;
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
    const x = (k % this.columns) * (this.wide + this.gap);
    const y = Math.floor(k / this.columns) * this.pitch - this.shifted;
    style.transform = `translate(${x}px, ${y}px)`;
  }

  /** Fills the list in the next frame; after a long jump, which is often one of many, when it is over. */
  later() {
    window.clearTimeout(this.postponed);
    const jump = Math.abs(window.scrollY - (this.filledAt ?? window.scrollY));
    if (jump > LONG_JUMP * window.innerHeight && !this.isLoaded())
      this.postponed = window.setTimeout(() => this.soon(), JUMP_DELAY);
    else this.soon();
  }

  soon() {
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      if (this.element.isConnected) this.fill();
    });
  }

  /** Puts the tiles near the window into the document, and removes others except one with the focus. */
  fill() {
    if (this.paper?.isPrinting) return;
    this.filledAt = window.scrollY;
    const scrolled = -this.element.getBoundingClientRect().top;
    const isShifted = this.shifted !== this.shift(scrolled);
    this.shifted = this.shift(scrolled);
    const top = scrolled + this.shifted;
    const ahead = window.innerHeight * TILES_AHEAD;
    const row = (y) => Math.floor(y / this.pitch);
    const first = Math.max(0, row(top - ahead) * this.columns);
    const last = Math.min(this.count, (row(top + window.innerHeight + ahead) + 1) * this.columns);
    for (const [k, element] of this.there) {
      if ((k >= first && k < last) || element.contains(document.activeElement)) continue;
      element.remove();
      this.there.delete(k);
    }
    if (isShifted) for (const [k, element] of this.there) this.lay(element, k);
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
    this.prepare(element, k);
  }

  /** What a tile shows is there, unless an option says otherwise. */
  need() {
    return null;
  }

  /** Whether no tile needs anything to be loaded. */
  isLoaded() {
    return true;
  }

  fillTile() {}

  failed() {}

  /** Fills a tile and queues it to be drawn: at once, or when what it shows has been loaded. */
  prepare(element, k) {
    const act = () => {
      if (this.there.get(k) !== element) return;
      // What was loaded first may have been dropped while the rest was loaded.
      if (this.need(k) !== null) return;
      this.fillTile(element, k);
      this.queue.push(k);
      this.drawSoon();
    };
    const need = this.need(k);
    if (need === null) act();
    else whenLoaded(need, act, (message) => this.failed(message));
  }

  drawSoon() {
    this.drawing ||= requestAnimationFrame(() => {
      this.drawing = 0;
      this.drawSome();
    });
  }

  drawSome(time = DRAWING_TIME) {
    const end = performance.now() + time;
    this.queue = this.queue.filter((k) => this.there.has(k));
    while (this.queue.length && performance.now() < end) {
      const k = this.queue.shift();
      // The points may have been dropped since the tile was queued.
      if (this.need(k) === null) this.draw(this.there.get(k), k);
      else this.prepare(this.there.get(k), k);
    }
    if (this.queue.length) this.drawSoon();
  }

  /** Puts the first tiles into the document, and no others, for printing. */
  printed() {
    const last = Math.min(this.count, PRINTED_TILES);
    for (const [k, element] of this.there) {
      if (k < last) continue;
      element.remove();
      this.there.delete(k);
    }
    this.shifted = 0;
    for (const [k, element] of this.there) this.lay(element, k);
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
