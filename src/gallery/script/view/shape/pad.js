// The drawing pad.

import { simplified } from "../../shape/encode.js";
import { looksClosed } from "../../shape/outline.js";
import { boxOfPoints, fittedView, pointPairs, screenPoint } from "../../draw/plane-view.js";
import { fill, h, s } from "../dom.js";
import { onKeys } from "../keys.js";

const PAD_WIDTH = 400;
const PAD_HEIGHT = 300;
// The arrow keys move the pen by this much, with Shift by five times as much.
const PEN_STEP = 5;

/** A pad of 400 × 300; calls `ondrawn(points, closed)` with a finished shape, y up, and `oncleared()` when there is none any more. */
export class DrawingPad {
  /** @type {Point[]} */ points = [];
  /** @type {Point} */ pen = [PAD_WIDTH / 2, PAD_HEIGHT / 2];
  closed = false;
  /** Whether the points were set by keys. */
  isByKeys = false;

  /**
   * @param {(points: Float64Array, closed: boolean) => void} ondrawn @param {() => void} oncleared
   * @param {App["announce"]} announce
   */
  constructor(ondrawn, oncleared, announce) {
    this.ondrawn = ondrawn;
    this.oncleared = oncleared;
    this.announce = announce;
    this.line = s("path.drawn");
    this.dots = s("g.dots");
    this.cross = s("path.pen", { d: "M-7 0h14M0-7v14" });
    this.element = s(
      "svg.pad",
      {
        viewBox: `0 0 ${PAD_WIDTH} ${PAD_HEIGHT}`,
        tabindex: "0",
        role: "application",
        "aria-label": "Drawing pad",
        "aria-describedby": "pad-help",
        onpointerdown: (event) => this.startStroke(event),
      },
      s("path.grid", { d: gridLines() }),
      this.line,
      this.dots,
      this.cross,
    );
    onKeys(this.element, "On the pad", [
      [
        "ArrowLeft ArrowRight ArrowUp ArrowDown",
        "move the pen; with Shift further",
        (event) => this.movePen(event),
      ],
      ["Enter Space", "add a point", () => this.addPoint()],
      ["Backspace", "remove the last point", () => this.removePoint()],
      ["c", "close the curve", () => this.finish(true)],
      ["Escape", "clear", () => this.clear()],
    ]);
    this.help = h("p.note", { id: "pad-help" }, "Draw in one stroke, or by keys, which ? lists.");
  }

  /** Shows a shape, fitted into the pad. */
  show(/** @type {Points} */ points, closed) {
    const size = { width: PAD_WIDTH, height: PAD_HEIGHT, margin: 20 };
    const view = fittedView(boxOfPoints(points), size);
    this.points = pointPairs(points).map((point) => screenPoint(view, point));
    this.closed = closed;
    this.isByKeys = false;
    this.render();
  }

  clear() {
    [this.points, this.closed] = [[], false];
    this.render();
    this.oncleared();
  }

  render() {
    const path = this.points.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
    this.line.setAttribute("d", this.closed ? `${path}Z` : path);
    fill(this.dots, this.isByKeys ? this.points.map(([cx, cy]) => s("circle", { cx, cy, r: 3 })) : null);
    this.cross.setAttribute("transform", `translate(${this.pen[0]} ${this.pen[1]})`);
  }

  /** @returns {Point} */
  placeOf({ clientX, clientY }) {
    const box = this.element.getBoundingClientRect();
    const scale = Math.min(box.width / PAD_WIDTH, box.height / PAD_HEIGHT);
    return [
      (clientX - box.left - (box.width - scale * PAD_WIDTH) / 2) / scale,
      (clientY - box.top - (box.height - scale * PAD_HEIGHT) / 2) / scale,
    ];
  }

  startStroke(event) {
    if (event.button) return;
    event.preventDefault();
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    this.points = [this.placeOf(event)];
    this.closed = this.isByKeys = false;
    this.render();
    this.element.onpointermove = (moved) => {
      const seen = moved.getCoalescedEvents?.() ?? [];
      for (const one of seen.length ? seen : [moved]) this.points.push(this.placeOf(one));
      this.render();
    };
    this.element.onlostpointercapture = () => {
      [this.element.onpointermove, this.element.onlostpointercapture] = [null, null];
      this.finish();
    };
  }

  flat() {
    return Float64Array.from(this.points.flatMap(([x, y]) => [x, PAD_HEIGHT - y]));
  }

  finish(/** @type {boolean | null} */ closed = null) {
    if (this.points.length < 2) return;
    const flat = this.flat();
    this.closed = closed ?? looksClosed(flat);
    this.render();
    this.ondrawn(flat.length > 600 ? simplified(flat, this.closed, 300) : flat, this.closed);
  }

  movePen(event) {
    const step = event.shiftKey ? 5 * PEN_STEP : PEN_STEP;
    const ways = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
    const move = ways[event.key];
    this.pen = [
      Math.min(Math.max(this.pen[0] + move[0], 0), PAD_WIDTH),
      Math.min(Math.max(this.pen[1] + move[1], 0), PAD_HEIGHT),
    ];
    this.announce(`${Math.round(this.pen[0])}, ${Math.round(PAD_HEIGHT - this.pen[1])}`);
    this.render();
  }

  addPoint() {
    if (!this.isByKeys) [this.points, this.closed, this.isByKeys] = [[], false, true];
    this.points.push([...this.pen]);
    this.announce(`Point ${this.points.length}`);
    this.render();
    if (this.points.length > 2) this.finish(false);
  }

  removePoint() {
    this.points.pop();
    this.closed = false;
    this.render();
    if (this.points.length > 2) this.finish(false);
    else this.oncleared();
  }
}

function gridLines() {
  let path = "";
  for (let x = 50; x < PAD_WIDTH; x += 50) path += `M${x} 0V${PAD_HEIGHT}`;
  for (let y = 50; y < PAD_HEIGHT; y += 50) path += `M0 ${y}H${PAD_WIDTH}`;
  return path;
}
