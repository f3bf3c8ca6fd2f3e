// The target: the shape that is searched for, drawn and changed here, with axes and the four-bars that are found for it.

import { bending, handlesOf, looksClosed, resampled, withoutHandle } from "../../shape/outline.js";
import { placedData } from "../../draw/path-data.js";
import { boxOfPoints, fittedView, planePoint, roundBelow, screenPoint } from "../../draw/plane-view.js";
import { fill, h, s, setAttributes } from "../dom.js";
import { directionOfKey, focusOne, handleKey, onKeys } from "../keys.js";
import { formatNumber } from "../labels.js";
import { axisLines } from "./axes.js";
import { fourBarDrawing } from "./match-item.js";

const FRAME = { width: 520, height: 420 };
const MARGIN = 90;
// What is seen before there is a shape, in units of the plane.
const EMPTY_BOX = [0, 0, 100, 80];

/** The plane of the shape. `on.drawn(outline)` is called with a finished shape, `on.live(outline, isDragged)` while it changes, `on.cleared()` when there is none any more. */
export class TargetPlane {
  /** @type {Outline} */ outline = { points: new Float64Array(), closed: false };
  view = fittedView(EMPTY_BOX, FRAME);
  /** @type {Point} */ pen = [50, 40];
  /** The box of the pivots. @type {number[] | null} */ corners = null;
  /** Whether the points are set by keys. */ isByKeys = false;

  /** @param {{ drawn(outline: Outline): void, live(outline: Outline, isDragged: boolean): void, cleared(): void }} on @param {App["announce"]} announce */
  constructor(on, announce) {
    this.on = on;
    this.announce = announce;
    const [axes, box, found, dots] = ["axes", "pivot-box", "found", "dots"].map((name) => s(`g.${name}`));
    this.parts = { axes, box, found, dots };
    this.line = s("path.drawn");
    this.cross = s("path.pen", { d: "M-7 0h14M0-7v14" });
    this.element = s(
      "svg.pad",
      {
        viewBox: `0 0 ${FRAME.width} ${FRAME.height}`,
        tabindex: "0",
        role: "application",
        "aria-label": "Drawing pad",
        "aria-describedby": "pad-help",
        onpointerdown: (event) => this.#press(event),
      },
      [axes, box, found, this.line, dots, this.cross],
    );
    onKeys(dots, "On a dot of the pad", [
      ["ArrowLeft ArrowRight ArrowUp ArrowDown", "move it; with Shift ten times as far"],
      ["PageUp PageDown", "another dot"],
      ["Delete", "remove it", ({ target }) => this.#remove(this.#dots.findIndex((dot) => dot === target))],
    ]);
    onKeys(this.element, "On the pad", [
      [
        "ArrowLeft ArrowRight ArrowUp ArrowDown",
        "move the pen; with Shift further",
        (event) => this.#move(event),
      ],
      ["Enter Space", "add a point", () => this.#addPoint()],
      ["Backspace", "remove the last point", () => this.#removePoint()],
      ["c", "close the curve", () => this.#finish(true)],
      ["Escape", "clear", () => this.on.cleared()],
    ]);
    const help = "Draw in one stroke, and drag the dots; ? lists the keys.";
    this.help = h("p.note", { id: "pad-help" }, help);
    this.render();
  }

  /** Shows a shape, or none: null. */
  show(/** @type {Outline | null} */ outline) {
    this.outline = outline ?? { points: new Float64Array(), closed: false };
    this.isByKeys = false;
    const box = outline ? boxOfPoints(outline.points) : EMPTY_BOX;
    this.pen = [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
    this.view = fittedView(box, { ...FRAME, margin: outline ? MARGIN : 0 });
    this.showFound([]);
    this.render();
  }

  /** Shows the box of the pivots, or none. @param {number[] | null} corners */
  showBox(corners) {
    this.corners = corners;
    if (!corners) return fill(this.parts.box);
    const [x0, y0, x1, y1] = boxOfPoints(corners);
    const [[x, y], [right, bottom]] = [screenPoint(this.view, [x0, y1]), screenPoint(this.view, [x1, y0])];
    return fill(this.parts.box, s("rect", { x, y, width: right - x, height: bottom - y }));
  }

  /** Shows four-bars with their curves, the nearest last; at rest its joints are in view, if they are not far. @param {FourBarAnswer[]} answers */
  showFound(answers, isAtRest = false) {
    const { points } = this.outline;
    if (isAtRest && points.length && !this.element.onpointermove) {
      const frame = { ...FRAME, margin: MARGIN / 3 };
      const joints = fittedView(boxOfPoints(points, answers[0]?.pose ?? []), frame);
      const alone = fittedView(boxOfPoints(points), { ...FRAME, margin: MARGIN });
      this.view = joints.scale < alone.scale / 3 ? alone : joints;
      this.render();
    }
    const drawings = answers.map((answer, k) => fourBarDrawing(answer, this.view, k + 1));
    fill(this.parts.found, drawings.reverse());
  }

  render() {
    const { points, closed } = this.outline;
    this.line.setAttribute("d", placedData(points, closed && points.length > 4, this.view));
    const places = handlesOf(this.outline);
    // A dot that has the focus stays.
    const dots = places.map((_, k) => this.#dot(k));
    if (dots.length !== this.#dots.length) fill(this.parts.dots, dots);
    places.forEach((place, k) => {
      const [cx, cy] = screenPoint(this.view, place);
      setAttributes(this.#dots[k], { cx, cy, "aria-label": `Dot ${k + 1} of ${places.length}` });
    });
    const [x, y] = screenPoint(this.view, this.pen);
    this.cross.setAttribute("transform", `translate(${x} ${y})`);
    fill(this.parts.axes, axisLines(this.view, FRAME));
    this.showBox(this.corners);
  }

  get #dots() {
    return /** @type {SVGElement[]} */ ([...this.parts.dots.children]);
  }

  #dot(/** @type {number} */ k) {
    const tabindex = k === 0 ? "0" : "-1";
    const onkeydown = (/** @type {KeyboardEvent} */ event) =>
      handleKey(event, this.#dots, k, ([right, up]) => {
        this.outline = bending(this.outline, k)([right / this.view.scale, up / this.view.scale]);
        this.render();
        this.on.live(this.outline, true);
      });
    const onkeyup = (/** @type {KeyboardEvent} */ event) =>
      directionOfKey(event) && this.#finish(this.outline.closed);
    return s("circle", { r: 5, "data-handle": k, role: "button", tabindex, onkeydown, onkeyup });
  }

  /** @param {PointerEvent} _ @returns {Point} */
  #placeOf({ clientX, clientY }) {
    const { left, top, width, height } = this.element.getBoundingClientRect();
    const scale = Math.min(width / FRAME.width, height / FRAME.height);
    return planePoint(this.view, [
      (clientX - left - (width - scale * FRAME.width) / 2) / scale,
      (clientY - top - (height - scale * FRAME.height) / 2) / scale,
    ]);
  }

  /** Begins a stroke, or to drag a handle. */
  #press(/** @type {PointerEvent} */ event) {
    if (event.button) return;
    event.preventDefault();
    const target = /** @type {SVGElement} */ (event.target);
    const { handle } = target.dataset;
    (handle === undefined ? this.element : target).focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    const move = handle === undefined ? this.#stroke(event) : this.#drag(event, Number(handle));
    this.element.onpointermove = (moved) => {
      move(moved);
      this.render();
      this.on.live(this.outline, handle !== undefined);
    };
    this.element.onlostpointercapture = () => {
      [this.element.onpointermove, this.element.onlostpointercapture] = [null, null];
      this.#finish(handle === undefined ? null : this.outline.closed);
    };
  }

  #stroke(/** @type {PointerEvent} */ event) {
    const stroke = [...this.#placeOf(event)];
    this.isByKeys = false;
    this.showFound([]);
    return (/** @type {PointerEvent} */ moved) => {
      const seen = moved.getCoalescedEvents?.() ?? [];
      for (const one of seen.length ? seen : [moved]) stroke.push(...this.#placeOf(one));
      this.outline = { points: Float64Array.from(stroke), closed: false };
    };
  }

  #drag(/** @type {PointerEvent} */ event, /** @type {number} */ handle) {
    const [x, y] = this.#placeOf(event);
    const bent = bending(this.outline, handle);
    return (/** @type {PointerEvent} */ moved) => {
      const [toX, toY] = this.#placeOf(moved);
      this.outline = bent([toX - x, toY - y]);
    };
  }

  /** Removes a handle with the shape around it; a shape has three points. */
  #remove(/** @type {number} */ handle) {
    const left = withoutHandle(this.outline, handle);
    if (left.points.length < 6) return;
    this.outline = left;
    this.render();
    focusOne(this.#dots, Math.min(handle, this.#dots.length - 1));
    this.#finish(left.closed);
  }

  /** Ends a change; a stroke is closed if it looks so. */
  #finish(/** @type {boolean | null} */ closed) {
    const { points } = this.outline;
    if (points.length < 4) return;
    const isClosed = closed ?? looksClosed(points);
    const few = points.length > 600 ? resampled(points, isClosed, 300) : points;
    this.outline = { points: few, closed: isClosed };
    this.on.drawn(this.outline);
  }

  #move(/** @type {KeyboardEvent} */ event) {
    const step = roundBelow(30 / this.view.scale) * (event.shiftKey ? 5 : 1) * 0.5;
    const [right, up] = directionOfKey(event) ?? [0, 0];
    this.pen = [this.pen[0] + right * step, this.pen[1] + up * step];
    this.announce(this.pen.map((value) => formatNumber(value)).join(", "));
    this.render();
  }

  #addPoint() {
    const before = this.isByKeys ? this.outline.points : [];
    this.isByKeys = true;
    this.#setKeyed([...before, ...this.pen]);
    this.announce(`Point ${this.outline.points.length / 2}`);
  }

  #removePoint() {
    this.#setKeyed([...this.outline.points].slice(0, -2));
    if (this.outline.points.length === 4) this.on.cleared();
  }

  /** Shows points that keys set; a shape has three of them. @param {number[]} points */
  #setKeyed(points) {
    this.outline = { points: Float64Array.from(points), closed: false };
    this.render();
    if (points.length > 4) this.#finish(false);
  }
}
