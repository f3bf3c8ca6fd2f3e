// The graph of the traced point's speed over the circuit.

import { pixel } from "../../draw/path-data.js";
import { h, s, setAttributes } from "../dom.js";
import { partOfInput, turningParts } from "./timeline.js";
import { clippedData } from "../../draw/clipping.js";
import { formatLength } from "../labels.js";

const SPEED_FRAME = { width: 300, height: 84 };

/**
 * The graph: `show(study, speeds, portion)`, then `update(part, speed)`; calls `choose(part)` when it is
 * pressed.
 */
export class SpeedView {
  constructor(choose) {
    this.line = s("path.speed-line");
    this.band = s("path.speed-band");
    this.limits = s("path.speed-limits");
    this.mark = s("path.speed-mark", { d: `M0 0v${SPEED_FRAME.height}` });
    this.dot = s("circle.speed-dot", { r: 3.5 });
    this.value = h("span");
    this.foot = h("p.note");
    const { width, height } = SPEED_FRAME;
    const axis = s("path.speed-axis", { d: `M0 ${height}h${width}` });
    this.drawing = s("svg.speed", { viewBox: `-4 -8 ${width + 8} ${height + 12}`, role: "img" }, [
      this.band,
      axis,
      this.limits,
      this.line,
      this.mark,
      this.dot,
    ]);
    const heading = h("h3", "Speed along the curve ", this.value);
    this.element = h("section.gauge.speed-gauge", heading, this.drawing, this.foot);
    const pressed = (event) => {
      if (event.type === "pointermove" && event.buttons !== 1) return;
      const box = this.drawing.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * (width + 8) - 4;
      choose(Math.min(Math.max(x, 0), width) / width);
    };
    this.drawing.addEventListener("pointerdown", pressed);
    this.drawing.addEventListener("pointermove", pressed);
    this.top = 1;
    this.unit = "";
  }

  /** `portion` is the range of parts of the straight portion, or null. @param {Study} _ @param {Speeds} _1 */
  show({ is_length: isLength, timeline }, { passes, inputs, speeds }, portion) {
    const parts = Array.from(inputs, (input, k) => partOfInput(timeline, passes[k], input));
    this.top = maxShownSpeed(speeds);
    this.unit = isLength ? "unit of input" : "radian of input";
    this.line.setAttribute("d", speedData(parts, speeds, this.top, SPEED_FRAME));
    const limits = turningParts(timeline).map(
      (part) => `M${pixel(part * SPEED_FRAME.width)} 0V${SPEED_FRAME.height}`,
    );
    this.limits.setAttribute("d", limits.join(""));
    this.band.setAttribute("d", portion ? bandData(portion) : "");
    const finite = speeds.filter(Number.isFinite);
    const [least, most] = [Math.min(...finite), Math.max(...finite)];
    const isCut = most > this.top * 1.05;
    const until = isCut ? "unbounded towards the limits" : `to ${formatLength(most)}`;
    this.foot.textContent = `from ${formatLength(least)} ${until}, in lengths per ${this.unit}`;
    const range = `from ${formatLength(least)} ${until} per ${this.unit}`;
    setAttributes(this.drawing, { "aria-label": `Speed of the traced point over the circuit: ${range}` });
  }

  update(part, speed) {
    const x = pixel(part * SPEED_FRAME.width);
    this.mark.setAttribute("transform", `translate(${x} 0)`);
    const isFinite = Number.isFinite(speed);
    const height = SPEED_FRAME.height * (1 - Math.min(speed / this.top, 1.06));
    setAttributes(this.dot, { cx: x, cy: isFinite ? pixel(height) : -5 });
    this.value.textContent = isFinite ? formatLength(speed) : "∞";
  }
}

function bandData([from, to]) {
  const x = (part) => pixel(part * SPEED_FRAME.width);
  const field = (a, b) => `M${x(a)} 0H${x(b)}V${SPEED_FRAME.height}H${x(a)}Z`;
  return to >= from ? field(from, to) : field(from, 1) + field(0, to);
}

/**
 * The greatest speed that a graph shows; speeds grow without bound towards limits, and are cut off there.
 */
export function maxShownSpeed(speeds) {
  const finite = speeds.filter(Number.isFinite).sort((a, b) => a - b);
  if (finite.length === 0) return 1;
  const most = finite[finite.length - 1];
  const usual = finite[Math.floor(0.8 * finite.length)];
  return most > 4 * usual && usual > 0 ? 2.5 * usual : most || 1;
}

/**
 * Path data of speeds over fractions of the circuit (0 to 1) in a frame { width, height }, with 0 at its
 * bottom and `top` at its top.
 */
export function speedData(parts, speeds, top, /** @type {Size} */ { width, height }) {
  const points = [];
  parts.forEach((part, k) => points.push(part * width, height * (1 - speeds[k] / top)));
  return clippedData(points, [0, -0.05 * height, width, height], 5);
}
