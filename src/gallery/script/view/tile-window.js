// A grid of any number of tiles, of which only those near the window are in the document.

import { whenLoaded } from "../data/needs.js";
import { h, setAttributes } from "./dom.js";
import { onKeys } from "./keys.js";
import { MAX_HEIGHT, scrollScale, printedCountNote, onPrint } from "./long-list.js";

// The time per frame, in milliseconds, for drawing tiles that have become visible.
const DRAWING_TIME = 8;
// The fraction of the window's height above and below it that is kept ready.
const TILES_AHEAD = 0.75;
// While the list is scrolled further than this, in window heights, nothing is loaded until it has rested.
const LONG_JUMP = 4;
const JUMP_DELAY = 100;
// The maximum number of tiles printed.
const PRINTED_TILES = 400;

/** A grid of tiles; `count` may change before `measure()`. */
export class TileWindow {
  /** The tiles in the document, by their index. @type {Map<number, HTMLElement>} */ there = new Map();
  /** The tiles to be drawn. @type {number[]} */ queue = [];
  listening = new AbortController();
  pending = 0;
  drawing = 0;
  postponed = 0;
  scale = 1;
  /** The height by which tiles are moved up. */ shifted = 0;
  columns = 1;
  /** The size of a tile, in pixels. */ wide = 0;
  high = 0;
  /** The height of the text below the pictures: that of the highest one so far. */ below = 0;
  filledAt = window.scrollY;
  /** @type {ReturnType<typeof onPrint> | null} */ paper = null;

  constructor(/** @type {TileOptions} */ options) {
    this.count = options.count;
    this.options = options;
    this.element = h("ul.window", { "aria-label": options.label });
    const typed = (/** @type {KeyboardEvent} */ event) => this.typed(event);
    onKeys(this.element, `In ${options.label.toLowerCase()}`, [
      ["ArrowLeft ArrowRight ArrowUp ArrowDown PageUp PageDown Home End", "go to another one", typed],
    ]);
    this.element.style.setProperty("--shape", `1 / ${options.aspect}`);
    this.element.style.setProperty("--least", `${options.least}px`);
    this.sizes = new ResizeObserver(() => this.measure());
  }

  /** Called when the list is in the document and has a width. */
  shown() {
    this.measure();
    this.sizes.observe(this.element);
    const { signal } = this.listening;
    for (const name of ["scroll", "resize"])
      window.addEventListener(name, () => this.later(), { passive: true, signal });
    this.paper = onPrint(this);
  }

  /** Stops observing the window. */
  end() {
    this.sizes.disconnect();
    this.paper?.end();
    this.listening.abort();
    window.clearTimeout(this.postponed);
    cancelAnimationFrame(this.pending);
    cancelAnimationFrame(this.drawing);
    this.there.clear();
    this.queue = [];
  }

  /** Scrolls to a tile and focuses it. */
  show(/** @type {number} */ k) {
    const row = Math.floor(k / this.columns) * this.pitch;
    const top = this.element.getBoundingClientRect().top;
    const at = top + row - this.shift(-top);
    const isSeen = at >= 0 && at + this.high <= window.innerHeight;
    const ahead = Math.max(row - (window.innerHeight - this.high) / 2, -top - window.scrollY);
    if (!isSeen) window.scrollTo(0, top + window.scrollY + ahead / (ahead > 0 ? this.scale : 1));
    this.fill();
    this.there.get(k)?.querySelector("a")?.focus({ preventScroll: true });
  }

  /** The vertical distance of rows, in pixels. */
  get pitch() {
    return this.high + this.options.gap;
  }

  /** The height by which tiles are moved up when the list is scrolled by `top` pixels, if it is too high. */
  shift(/** @type {number} */ top) {
    return Math.max(top, 0) * (this.scale - 1);
  }

  measure() {
    const { count } = this;
    const { gap, least, aspect, below } = this.options;
    const width = this.element.clientWidth;
    const wide = this.wide;
    this.columns = Math.max(1, Math.floor((width + gap) / (Math.min(least, width) + gap)));
    this.wide = (width - gap * (this.columns - 1)) / this.columns;
    this.below = this.wide === wide ? Math.max(this.below, below) : below;
    this.high = Math.round(this.wide * aspect) + this.below;
    const height = Math.ceil(count / this.columns) * this.pitch - gap;
    this.scale = scrollScale(height, window.innerHeight);
    this.element.style.height = `${Math.min(height, MAX_HEIGHT)}px`;
    for (const [k, element] of this.there) this.lay(element, k);
    this.fill();
  }

  /** The size of a tile's picture inside its border, in pixels. */
  get pictureSize() {
    return { width: Math.max(this.wide - 2, 40), height: Math.max(this.wide * this.options.aspect - 2, 40) };
  }

  lay(/** @type {HTMLElement} */ { style }, /** @type {number} */ k) {
    style.width = `${this.wide}px`;
    style.height = `${this.high}px`;
    const x = (k % this.columns) * (this.wide + this.options.gap);
    const y = Math.floor(k / this.columns) * this.pitch - this.shifted;
    style.transform = `translate(${x}px, ${y}px)`;
  }

  /** Fills the list in the next frame; after a long jump, which is often one of many, when it is over. */
  later() {
    window.clearTimeout(this.postponed);
    const jump = Math.abs(window.scrollY - this.filledAt);
    if (jump > LONG_JUMP * window.innerHeight && !this.options.isLoaded())
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
    const row = (/** @type {number} */ y) => Math.floor(y / this.pitch);
    const first = Math.max(0, row(top - ahead) * this.columns);
    const last = Math.min(this.count, (row(top + window.innerHeight + ahead) + 1) * this.columns);
    this.keep((k, element) => (k >= first && k < last) || element.contains(document.activeElement));
    if (isShifted) for (const [k, element] of this.there) this.lay(element, k);
    for (let k = first; k < last; k += 1) this.add(k);
    this.drawSome();
  }

  /** Removes the tiles from the document that are not to be kept. */
  keep(/** @type {(k: number, element: HTMLElement) => boolean} */ isKept) {
    for (const [k, element] of this.there) {
      if (isKept(k, element)) continue;
      element.remove();
      this.there.delete(k);
    }
  }

  add(/** @type {number} */ k) {
    if (this.there.has(k)) return;
    const element = this.options.tile(k);
    setAttributes(element, { "aria-setsize": this.count, "aria-posinset": k + 1 });
    this.lay(element, k);
    // In tile order, for keyboard navigation.
    const after = Math.min(...[...this.there.keys()].filter((other) => other > k));
    this.element.insertBefore(element, this.there.get(after) ?? null);
    this.there.set(k, element);
    this.prepare(element, k);
  }

  /** Fills a tile and queues it to be drawn: at once, or when what it shows has been loaded. */
  prepare(/** @type {HTMLElement} */ element, /** @type {number} */ k) {
    const act = () => {
      if (this.there.get(k) !== element) return;
      // What was loaded first may have been dropped while the rest was loaded.
      if (this.options.need(k) !== null) return;
      this.options.fillTile(element, k);
      this.queue.push(k);
      this.drawSoon();
    };
    whenLoaded(this.options.need(k), act, this.options.failed);
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
    this.makeRoom();
    while (this.queue.length && performance.now() < end) {
      const k = this.queue.shift() ?? 0;
      const element = this.there.get(k);
      if (!element) continue;
      // The points may have been dropped since the tile was queued.
      if (this.options.need(k) === null) this.options.draw(element, k);
      else this.prepare(element, k);
    }
    if (this.queue.length) this.drawSoon();
  }

  /** Makes all tiles as high as the highest text needs; the row at the top of the window stays there. */
  makeRoom() {
    const heights = this.queue.map((k) => this.there.get(k)?.querySelector(".label")?.scrollHeight ?? 0);
    const more = Math.max(0, ...heights) - this.below;
    if (more <= 0 || this.paper?.isPrinting) return;
    const row = Math.floor(-this.element.getBoundingClientRect().top / this.pitch);
    this.below += more;
    this.measure();
    if (row > 0 && this.scale === 1) window.scrollBy(0, row * more);
  }

  /** Puts the first tiles into the document, and no others, for printing. */
  printed() {
    const last = Math.min(this.count, PRINTED_TILES);
    this.keep((k) => k < last);
    this.shifted = 0;
    for (const [k, element] of this.there) this.lay(element, k);
    for (let k = 0; k < last; k += 1) this.add(k);
    this.drawSome(Infinity);
    return printedCountNote(last, this.count, this.options.label.toLowerCase());
  }

  typed(/** @type {KeyboardEvent} */ event) {
    const at = [...this.there].find(
      ([, element]) => event.target instanceof Node && element.contains(event.target),
    )?.[0];
    if (at === undefined) return false;
    const screen = Math.max(1, Math.floor(window.innerHeight / this.pitch)) * this.columns;
    const down = { ArrowDown: this.columns, ArrowUp: -this.columns, PageDown: screen, PageUp: -screen };
    const by = { ArrowRight: 1, ArrowLeft: -1, Home: -this.count, End: this.count, ...down }[event.key];
    return this.show(Math.min(Math.max(at + (by ?? 0), 0), this.count - 1));
  }
}
