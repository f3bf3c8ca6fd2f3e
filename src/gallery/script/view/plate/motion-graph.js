// The graph of a quantity over a circuit.

import { clippedData } from "../../draw/clipping.js";
import { pixel } from "../../draw/path-data.js";
import { h, s, setAttributes } from "../dom.js";
import { turningParts } from "./timeline.js";

const GRAPH_FRAME = { width: 300, height: 84 };

/** The graph: `show(…)`, then `update(part, value)`; calls `choose(part)` where it is pressed. */
export class MotionGraph {
  constructor(/** @type {(part: number) => void} */ choose) {
    const { width, height } = GRAPH_FRAME;
    this.band = s("path.graph-band");
    this.axis = s("path.graph-axis");
    this.limits = s("path.graph-limits");
    this.line = s("path.graph-line");
    this.mark = s("path.graph-mark", { d: `M0 0v${height}` });
    this.dot = s("circle.graph-dot", { r: 3.5 });
    const parts = [this.band, this.axis, this.limits, this.line, this.mark, this.dot];
    this.drawing = s("svg.graph", { viewBox: `-4 -8 ${width + 8} ${height + 16}`, role: "img" }, parts);
    this.element = h("div", this.drawing);
    /** @type {[number, number]} */ this.range = [0, 1];
    const pressed = (/** @type {PointerEvent} */ event) => {
      if (event.type === "pointermove" && event.buttons !== 1) return;
      const box = this.drawing.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * (width + 8) - 4;
      choose(Math.min(Math.max(x, 0), width) / width);
    };
    this.drawing.addEventListener("pointerdown", pressed);
    this.drawing.addEventListener("pointermove", pressed);
  }

  /**
   * Shows values at parts of a timeline, and the portion between two parts, if there is one.
   * @param {Timeline} timeline @param {number[]} parts @param {number[]} values @param {number[] | null} portion
   */
  show(timeline, parts, values, portion) {
    const { width, height } = GRAPH_FRAME;
    this.range = shownRange(values);
    const points = parts.flatMap((part, k) => [part * width, this.#y(values[k])]);
    this.line.setAttribute("d", clippedData(points, [0, -0.05 * height, width, 1.05 * height], 5));
    const limits = turningParts(timeline).map((part) => `M${pixel(part * width)} 0V${height}`);
    this.limits.setAttribute("d", limits.join(""));
    this.axis.setAttribute("d", `M0 ${pixel(this.#y(0))}h${width}`);
    this.band.setAttribute("d", portion ? bandData(portion) : "");
  }

  update(/** @type {number} */ part, /** @type {number} */ value) {
    const { width, height } = GRAPH_FRAME;
    const x = pixel(part * width);
    this.mark.setAttribute("transform", `translate(${x} 0)`);
    const y = Number.isFinite(value) ? Math.min(Math.max(this.#y(value), -5), height + 5) : -5;
    setAttributes(this.dot, { cx: x, cy: pixel(y) });
  }

  /** The graph as a drawing of its own, with a title. */
  svg(/** @type {string} */ title) {
    const { width, height } = GRAPH_FRAME;
    const [low, high] = this.range.map((value) => String(Number(value.toPrecision(6))));
    const path = (/** @type {Element} */ of, /** @type {string} */ style) =>
      `<path d="${of.getAttribute("d")}" ${style}/>`;
    const text = (/** @type {string} */ words, /** @type {string} */ at) =>
      `<text ${at} font-size="7">${words}</text>`;
    return [
      `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-45 -20 ${width + 60} ${height + 32}" fill="none">`,
      path(this.axis, 'stroke="#888" stroke-width="0.5"'),
      path(this.limits, 'stroke="#888" stroke-width="0.5" stroke-dasharray="3 3"'),
      path(this.line, 'stroke="#7d2115"'),
      '<g fill="#191816" font-family="sans-serif">',
      text(title.replaceAll("&", "&amp;").replaceAll("<", "&lt;"), 'x="0" y="-9"'),
      text(high, 'x="-4" y="5" text-anchor="end"'),
      text(low, `x="-4" y="${height}" text-anchor="end"`),
      "</g></svg>\n",
    ].join("\n");
  }

  #y(/** @type {number} */ value) {
    const [low, high] = this.range;
    return GRAPH_FRAME.height * (1 - (value - low) / (high - low));
  }
}

/** The range of a graph with 0 in it: values that grow without bound towards limits are cut off. */
function shownRange(/** @type {number[]} */ values) {
  const finite = values.filter(Number.isFinite);
  const bound = (/** @type {number} */ sign) => {
    const sorted = finite.map((value) => Math.max(sign * value, 0)).sort((a, b) => a - b);
    const most = sorted[sorted.length - 1] ?? 0;
    const usual = sorted[Math.floor(0.8 * sorted.length)] ?? 0;
    return most > 4 * usual && usual > 0 ? 2.5 * usual : most;
  };
  const [low, high] = [-bound(-1) || 0, bound(1)];
  return /** @type {[number, number]} */ (high > low ? [low, high] : [0, 1]);
}

function bandData(/** @type {number[]} */ [from, to]) {
  const { width, height } = GRAPH_FRAME;
  const x = (/** @type {number} */ part) => pixel(part * width);
  const field = (/** @type {number} */ a, /** @type {number} */ b) => `M${x(a)} 0H${x(b)}V${height}H${x(a)}Z`;
  return to >= from ? field(from, to) : field(from, 1) + field(0, to);
}
