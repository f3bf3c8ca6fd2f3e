// The graph of the traced point's speed over the circuit.

import { pixel } from "../../draw/path-data.js";
import { maxShownSpeed, speedData, speedsOfPath } from "../../draw/speed-graph.js";
import { h, s } from "../dom.js";
import { partOfInput, turningParts } from "./timeline.js";
import { formatDecimals } from "./study.js";

const SPEED_FRAME = { width: 300, height: 84 };

/**
 * The graph: `show(study, path, portion)`, then `update(part, speed)`; calls `choose(part)` when it is
 * pressed.
 */
export class SpeedView {
  constructor(choose) {
    this.line = s("path", { class: "speed-line" });
    this.band = s("path", { class: "speed-band" });
    this.limits = s("path", { class: "speed-limits" });
    this.mark = s("path", { class: "speed-mark", d: `M0 0v${SPEED_FRAME.height}` });
    this.dot = s("circle", { class: "speed-dot", r: 3.5 });
    this.value = h("span", {});
    this.foot = h("p", { class: "note" });
    this.drawing = s(
      "svg",
      {
        class: "speed",
        viewBox: `-4 -8 ${SPEED_FRAME.width + 8} ${SPEED_FRAME.height + 12}`,
        role: "img",
        "aria-label": "Speed of the traced point over the circuit",
      },
      this.band,
      s("path", { class: "speed-axis", d: `M0 ${SPEED_FRAME.height}h${SPEED_FRAME.width}` }),
      this.limits,
      this.line,
      this.mark,
      this.dot,
    );
    this.element = h(
      "section",
      { class: "gauge speed-gauge" },
      h("h3", {}, "Speed along the curve ", this.value),
      this.drawing,
      this.foot,
    );
    const pressed = (event) => {
      if (event.type === "pointermove" && event.buttons !== 1) return;
      const box = this.drawing.getBoundingClientRect();
      choose(
        Math.min(
          Math.max(((event.clientX - box.left) / box.width) * (SPEED_FRAME.width + 8) - 4, 0),
          SPEED_FRAME.width,
        ) / SPEED_FRAME.width,
      );
    };
    this.drawing.addEventListener("pointerdown", pressed);
    this.drawing.addEventListener("pointermove", pressed);
    this.top = 1;
    this.unit = "";
  }

  /** `portion` is the range of parts [from, to] of the straight portion, or null. */
  show({ linkage, timeline }, path, portion) {
    const { isLength } = linkage.input;
    const { inputs, speeds } = speedsOfPath(path, isLength ? 1 : 180 / Math.PI);
    const parts = [];
    let k = 0;
    inputs.forEach((at, i) => {
      while (k < path.starts.length - 1 && i >= path.starts[k + 1]) k += 1;
      parts.push(partOfInput(timeline, k, at));
    });
    this.top = maxShownSpeed(speeds);
    this.unit = isLength ? "unit of input" : "radian of input";
    this.line.setAttribute("d", speedData(parts, speeds, this.top, SPEED_FRAME));
    this.limits.setAttribute(
      "d",
      turningParts(timeline)
        .map((part) => `M${pixel(part * SPEED_FRAME.width)} 0V${SPEED_FRAME.height}`)
        .join(""),
    );
    this.band.setAttribute("d", portion ? bandData(portion) : "");
    const finite = speeds.filter(Number.isFinite);
    const [least, most] = [Math.min(...finite), Math.max(...finite)];
    const isCut = most > this.top * 1.05;
    const until = isCut ? "unbounded towards the limits" : `to ${formatLength(most)}`;
    this.foot.textContent = `from ${formatLength(least)} ${until}, in lengths per ${this.unit}`;
    this.drawing.setAttribute(
      "aria-label",
      `Speed of the traced point over the circuit: from ${formatLength(least)} ${until} per ${this.unit}`,
    );
  }

  update(part, speed) {
    const x = pixel(part * SPEED_FRAME.width);
    this.mark.setAttribute("transform", `translate(${x} 0)`);
    const isFinite = Number.isFinite(speed);
    this.dot.setAttribute("cx", x);
    this.dot.setAttribute(
      "cy",
      isFinite ? pixel(SPEED_FRAME.height * (1 - Math.min(speed / this.top, 1.06))) : -5,
    );
    this.value.textContent = isFinite ? formatLength(speed) : "∞";
  }
}

function bandData([from, to]) {
  const x = (part) => pixel(part * SPEED_FRAME.width);
  const field = (a, b) => `M${x(a)} 0H${x(b)}V${SPEED_FRAME.height}H${x(a)}Z`;
  return to >= from ? field(from, to) : field(from, 1) + field(0, to);
}

/** A length or speed in four significant digits, with a true minus sign. */
export function formatLength(value) {
  if (!Number.isFinite(value)) return "∞";
  if (value === 0) return "0";
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent < -5 || exponent > 6) return value.toExponential(3).replaceAll("-", "−");
  return formatDecimals(value, Math.max(0, 3 - exponent));
}
