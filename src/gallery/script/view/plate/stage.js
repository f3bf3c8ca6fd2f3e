// The stage of a plate: a static layer with the curves and the ground, and above it a layer with the moving
// linkage, so that each frame repaints the linkage only. Line widths are in screen pixels at any zoom.

import { fittedView, interpolatedView, screenPoint, zoomedView } from "../../draw/plane-view.js";
import { fill, h } from "../dom.js";
import { MovingLayer } from "./moving-layer.js";
import { StaticLayer } from "./static-layer.js";

const STAGE_MARGIN = 44;

/** A stage. Put `element` into the document, then call `observe()`. Calls `onview` when its view has changed. */
export class Stage {
  constructor() {
    this.size = { width: 0, height: 0 };
    this.view = { scale: 1, x: 0, y: 0 };
    this.isZoomed = false;
    /** Whether the view stays while a handle is dragged. */ this.isHeld = false;
    /** What is fitted: the area swept by the linkage, extended by overlays. @type {Box | null} */ this.box =
      null;
    this.study = null;
    this.still = new StaticLayer();
    this.moving = new MovingLayer();
    this.summary = h("p.visually-hidden", { id: "plate-summary" });
    this.reason = h("p.reason.error", { hidden: true });
    const attributes = {
      role: "img",
      "aria-describedby": "plate-summary",
      "aria-label": "The linkage on its curve",
    };
    this.picture = h("div.scene", attributes, this.still.element, this.moving.element);
    this.element = h("div.stage", this.picture, this.reason, this.summary);
    this.observer = new ResizeObserver(() => this.#measured());
    this.onview = () => {};
    this.aim = this.view;
    this.gliding = 0;
  }

  observe() {
    this.observer.observe(this.element);
    this.#measured();
  }

  leave() {
    this.#stay();
    this.observer.disconnect();
  }

  /** Shows a study and the path data of its curve, { dashes, lead, others, band }, in the plane. */
  show(/** @type {Study} */ study, /** @type {CurveData} */ paths) {
    const isFirst = !this.study;
    this.study = study;
    this.still.show(study, paths);
    this.moving.show(study);
    this.box = study.box;
    if (isFirst) this.fit();
    else this.#place();
  }

  /** Shows why a linkage cannot be assembled, or moved; the previous linkage stays visible, dimmed. */
  impossible(/** @type {string | null} */ reason, what = "Cannot be assembled") {
    this.element.classList.toggle("impossible", reason !== null);
    this.reason.hidden = reason === null;
    fill(this.reason, reason === null ? [] : `${what}: ${reason.replace(/\x60([^\x60]*)\x60/g, "“$1”")}`);
  }

  /** Moves the linkage into a pose [x0, y0, …] of the plane. @param {Float64Array} pose */
  pose(pose) {
    this.moving.pose(pose, this.view);
  }

  /** Fits the swept area into the frame. */
  fit() {
    this.#stay();
    this.isZoomed = false;
    if (this.box) this.view = this.#fitted(this.box);
    this.#place();
  }

  /** While lengths are changing, the view stays unless the linkage leaves it or becomes small in it. */
  keepInFrame() {
    if (this.isZoomed || this.isHeld || !this.box) return;
    const fitted = this.#fitted(this.box);
    const [x0, y0, x1, y1] = this.box;
    const [left, low] = screenPoint(this.view, [x0, y0]);
    const [right, high] = screenPoint(this.view, [x1, y1]);
    const { width, height } = this.size;
    const isInside = Math.min(left, high, width - right, height - low) >= 0.5 * this.#margin();
    if (!isInside || this.view.scale < 0.55 * fitted.scale) this.#glideTo(fitted);
  }

  zoom(/** @type {number} */ factor, /** @type {Point} */ at = [this.size.width / 2, this.size.height / 2]) {
    if (!this.box) return;
    this.#stay();
    const least = this.#fitted(this.box).scale;
    const scale = Math.min(Math.max(this.view.scale * factor, 0.2 * least), 400 * least);
    this.view = zoomedView(this.view, scale / this.view.scale, at);
    this.isZoomed = true;
    this.#place();
  }

  pan(/** @type {number} */ dx, /** @type {number} */ dy) {
    this.#stay();
    this.view = { ...this.view, x: this.view.x + dx, y: this.view.y + dy };
    this.isZoomed = true;
    this.#place();
  }

  // Animated, so that the eye can follow, unless reduced motion is preferred.
  #glideTo(/** @type {Placement} */ view) {
    if (window.matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.view = view;
      this.#place();
      return;
    }
    this.aim = view;
    this.gliding ||= window.requestAnimationFrame(() => this.#glide());
  }

  #glide() {
    const { view, aim } = this;
    const isThere =
      Math.abs(aim.scale / view.scale - 1) < 2e-3 && Math.hypot(aim.x - view.x, aim.y - view.y) < 0.5;
    this.view = isThere ? aim : interpolatedView(view, aim, 0.22);
    this.gliding = isThere ? 0 : window.requestAnimationFrame(() => this.#glide());
    this.#place();
  }

  #stay() {
    window.cancelAnimationFrame(this.gliding);
    this.gliding = 0;
  }

  #fitted(/** @type {Box} */ box) {
    return fittedView(box, { ...this.size, margin: this.#margin() });
  }

  #margin() {
    return Math.min(STAGE_MARGIN, 0.1 * Math.min(this.size.width, this.size.height) + 8);
  }

  #measured() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0 || (width === this.size.width && height === this.size.height)) return;
    const before = this.size;
    this.size = { width, height };
    for (const sheet of this.element.querySelectorAll(".sheet"))
      sheet.setAttribute("viewBox", `0 0 ${width} ${height}`);
    if (this.isZoomed) this.pan((width - before.width) / 2, (height - before.height) / 2);
    else this.fit();
  }

  #place() {
    if (!this.study) return;
    this.still.place(this.view, this.size);
    this.moving.place(this.view);
    this.onview();
  }
}
