// Zooms and pans a page by wheel, drag, pinch, keys and buttons.
//
// The page is resized, not scaled, so that it is redrawn sharply at each size.

// The maximum magnification.
const NEAREST = 32;
// The margin around a page that fits the window, in pixels.
const FIT_MARGIN = 12;
// Pointers that move less than this, in pixels, are taps.
const TAP_SLACK = 5;

/**
 * The position of a page of `width` × `height` millimetres in a viewport: `scale` in pixels per millimetre,
 * and the page's corner at `x`, `y` pixels. Calls `on.zoomed()` when it has moved, at most once per frame.
 */
export class Zoom {
  scale = 1;
  x = 0;
  y = 0;
  isFit = true;
  isTap = false;
  pending = 0;
  /** The pointers that are down, where they are and were first. @type {Map<number, Record<"x" | "y" | "startX" | "startY", number>>} */
  pointers = new Map();
  constrainedTo = { width: 0, height: 0 };

  /** @param {HTMLElement} viewport @param {HTMLElement} sheet @param {Size} _ @param {Pick<PageView, "zoomed" | "tapped">} on */
  constructor(viewport, sheet, { width, height }, on) {
    this.viewport = viewport;
    this.sheet = sheet;
    this.width = width;
    this.height = height;
    this.on = on;
    this.resizes = new ResizeObserver(() => this.resized());
    this.resizes.observe(viewport);
    viewport.addEventListener("wheel", (event) => this.wheeled(event), { passive: false });
    viewport.addEventListener("pointerdown", (event) => this.pressed(event));
    viewport.addEventListener("pointermove", (event) => this.moved(event));
    viewport.addEventListener("pointerup", (event) => this.released(event, true));
    viewport.addEventListener("pointercancel", (event) => this.released(event, false));
  }

  /** Stops observing the viewport. */
  end() {
    this.resizes.disconnect();
    cancelAnimationFrame(this.pending);
  }

  /** The pixels per millimetre at which the whole page is visible. */
  get fitScale() {
    const { clientWidth, clientHeight } = this.viewport;
    const [width, height] = [clientWidth - 2 * FIT_MARGIN, clientHeight - 2 * FIT_MARGIN];
    return Math.max(Math.min(width / this.width, height / this.height), 0.05);
  }

  /** The scale relative to the scale that fits. */
  get magnification() {
    return this.scale / this.fitScale;
  }

  /** The position on the page, in millimetres, at the centre of the viewport. */
  get middle() {
    return this.placeAt(this.viewport.clientWidth / 2, this.viewport.clientHeight / 2);
  }

  /** The position on the page, in millimetres, at pixels of the viewport. @returns {Point} */
  placeAt(/** @type {number} */ x, /** @type {number} */ y) {
    return [(x - this.x) / this.scale, (y - this.y) / this.scale];
  }

  /** The position on the page, in millimetres, of a pointer event. */
  placeOf(/** @type {MouseEvent} */ event) {
    return this.placeAt(...this.pixelOf(event.clientX, event.clientY));
  }

  /** The pixels of the viewport, inside its border, at pixels of the window. @returns {Point} */
  pixelOf(/** @type {number} */ x, /** @type {number} */ y) {
    const { left, top } = this.viewport.getBoundingClientRect();
    return [x - left - this.viewport.clientLeft, y - top - this.viewport.clientTop];
  }

  /** Shows the whole page. */
  fit() {
    this.isFit = true;
    this.scale = this.fitScale;
    this.x = (this.viewport.clientWidth - this.scale * this.width) / 2;
    this.y = (this.viewport.clientHeight - this.scale * this.height) / 2;
    this.constrain();
  }

  /** Centres a position of the page at a magnification. */
  showAt(/** @type {number} */ magnification, /** @type {Point} */ [x, y]) {
    this.isFit = false;
    this.scale = this.fitScale * Math.min(Math.max(magnification, 1), NEAREST);
    this.x = this.viewport.clientWidth / 2 - this.scale * x;
    this.y = this.viewport.clientHeight / 2 - this.scale * y;
    this.constrain();
  }

  /** Zooms by a factor about a point in pixels of the viewport (default: its centre). @param {number} factor */
  zoom(factor, [x, y] = [this.viewport.clientWidth / 2, this.viewport.clientHeight / 2]) {
    const fit = this.fitScale;
    const scale = Math.min(Math.max(this.scale * factor, fit), NEAREST * fit);
    if (scale <= fit * 1.001) {
      this.fit();
      return;
    }
    const [atX, atY] = this.placeAt(x, y);
    this.isFit = false;
    this.scale = scale;
    this.x = x - scale * atX;
    this.y = y - scale * atY;
    this.constrain();
  }

  /** Moves the page by pixels. */
  pan(/** @type {number} */ dx, /** @type {number} */ dy) {
    if (this.isFit) return;
    this.x += dx;
    this.y += dy;
    this.constrain();
  }

  /** Moves the page so that a box, [x0, y0, x1, y1] in millimetres, is visible. */
  reveal(/** @type {Box} */ [x0, y0, x1, y1]) {
    const [left, top] = this.placeAt(0, 0);
    const [right, bottom] = this.placeAt(this.viewport.clientWidth, this.viewport.clientHeight);
    if (x0 >= left && x1 <= right && y0 >= top && y1 <= bottom) return;
    this.pan((this.scale * (left + right - x0 - x1)) / 2, (this.scale * (top + bottom - y0 - y1)) / 2);
  }

  /** Keeps the centre of the viewport when it is resized, within the zoom limits. */
  resized() {
    if (this.isFit) {
      this.fit();
      return;
    }
    const { clientWidth, clientHeight } = this.viewport;
    this.x += (clientWidth - this.constrainedTo.width) / 2;
    this.y += (clientHeight - this.constrainedTo.height) / 2;
    this.zoom(1);
  }

  /** Keeps a part of the page visible, and schedules the update for the next frame. */
  constrain() {
    const { clientWidth, clientHeight } = this.viewport;
    this.constrainedTo = { width: clientWidth, height: clientHeight };
    /** @param {number} at @param {number} size @param {number} available */
    const within = (at, size, available) => Math.min(Math.max(at, available / 2 - size), available / 2);
    if (!this.isFit) {
      this.x = within(this.x, this.scale * this.width, clientWidth);
      this.y = within(this.y, this.scale * this.height, clientHeight);
    }
    if (!this.pending) this.pending = requestAnimationFrame(() => this.apply());
  }

  apply() {
    this.pending = 0;
    const { style } = this.sheet;
    style.width = `${this.scale * this.width}px`;
    style.height = `${this.scale * this.height}px`;
    style.transform = `translate(${this.x}px, ${this.y}px)`;
    this.viewport.classList.toggle("near", !this.isFit);
    this.on.zoomed();
  }

  wheeled(/** @type {WheelEvent} */ event) {
    event.preventDefault();
    const unit = [1, 16, this.viewport.clientHeight][event.deltaMode];
    const [dx, dy] = [event.deltaX * unit, event.deltaY * unit];
    if (event.shiftKey || Math.abs(dx) > Math.abs(dy)) {
      this.pan(-(dx || dy), event.shiftKey ? 0 : -dy);
      return;
    }
    // A pinch on a touchpad is reported as a wheel event with the control key, in small steps.
    const rate = event.ctrlKey ? 0.01 : 0.0016;
    const factor = Math.exp(-rate * Math.min(Math.max(dy, -300), 300));
    this.zoom(factor, this.pixelOf(event.clientX, event.clientY));
  }

  pressed(/** @type {PointerEvent} */ event) {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    const { clientX: x, clientY: y } = event;
    this.pointers.set(event.pointerId, { x, y, startX: x, startY: y });
    this.isTap = this.pointers.size === 1;
  }

  moved(/** @type {PointerEvent} */ event) {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return;
    const away = Math.hypot(event.clientX - pointer.startX, event.clientY - pointer.startY);
    if (this.isTap && away < TAP_SLACK) return;
    if (this.isTap) this.viewport.setPointerCapture(event.pointerId);
    this.isTap = false;
    const [other] = [...this.pointers.values()].filter((one) => one !== pointer);
    const before = this.pixelOf(pointer.x, pointer.y);
    [pointer.x, pointer.y] = [event.clientX, event.clientY];
    const after = this.pixelOf(pointer.x, pointer.y);
    if (!other) this.pan(after[0] - before[0], after[1] - before[1]);
    else pinch(this, this.pixelOf(other.x, other.y), before, after);
  }

  released(/** @type {PointerEvent} */ event, /** @type {boolean} */ isUp) {
    const wasDown = this.pointers.delete(event.pointerId);
    if (wasDown && isUp && this.isTap) this.on.tapped(event);
    if (this.pointers.size === 0) this.isTap = false;
  }

  /** Whether a pointer drags the page. */
  get isDragging() {
    return this.pointers.size > 0 && !this.isTap;
  }
}

/** Zooms and pans a view while one finger stays and another moves. @param {Pick<Zoom, "zoom" | "pan">} view @param {Point} still @param {Point} before @param {Point} after */
export function pinch(view, still, before, after) {
  const apart = (/** @type {Point} */ [x, y]) => Math.hypot(x - still[0], y - still[1]) || 1;
  view.zoom(apart(after) / apart(before), [(after[0] + still[0]) / 2, (after[1] + still[1]) / 2]);
  view.pan((after[0] - before[0]) / 2, (after[1] - before[1]) / 2);
}
