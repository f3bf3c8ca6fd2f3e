// The static parts of a plate: the dashed curve, other curves, guides, wheels, the straight portion, the
// fixed centrode, the ground, and a scale bar.

import { groundData } from "../../draw/ground.js";
import { circleData, pixel, polylineData } from "../../draw/path-data.js";
import { roundBelow } from "../../draw/plane-view.js";
import { s } from "../dom.js";
import { turningParts } from "./timeline.js";

/** The lower layer of a stage. */
export class StaticLayer {
  constructor() {
    const path = (name) => s("path", { class: name, "vector-effect": "non-scaling-stroke" });
    // In the plane: one transform positions everything, and line widths are constant.
    this.plane = {};
    for (const name of [
      "frame-line",
      "wheels",
      "guides",
      "crank-range",
      "others",
      "centrode fixed",
      "band",
      "lead",
      "dashes",
    ]) {
      this.plane[name.split(" ")[0]] = path(name);
    }
    this.group = s("g", {}, Object.values(this.plane));
    this.ground = s("path", { class: "ground" });
    this.limitMarks = s("path", { class: "limit-marks" });
    this.bar = s("path", { class: "scale-bar" });
    this.barLabel = s("text", { class: "scale-label" });
    this.element = s(
      "svg",
      { class: "sheet still", "aria-hidden": "true" },
      this.ground,
      this.group,
      this.limitMarks,
      this.bar,
      this.barLabel,
    );
    this.pivots = [];
    this.limits = [];
  }

  show({ linkage, circuit, timeline, mechanism }, { dashes, lead, others, band }) {
    const { fixed, frame, guides, wheels } = mechanism;
    const at = (joint) => [circuit.x[joint][0], circuit.y[joint][0]];
    this.pivots = fixed.map(at);
    this.#data(
      "frame-line",
      frame.length > 1 ? polylineData(frame.flatMap(at), { closed: frame.length > 2 }) : "",
    );
    this.#data("wheels", wheels.map(({ joint, radius }) => circleData(...at(joint), radius)).join(""));
    this.#data("guides", guides.map(([x0, y0, x1, y1]) => polylineData([x0, y0, x1, y1])).join(""));
    const { arc, limits } = crankRange(linkage, circuit, timeline, fixed);
    this.limits = limits;
    this.#data("crank-range", arc);
    this.#data("others", others);
    this.#data("band", band);
    this.#data("lead", lead);
    this.#data("dashes", dashes);
  }

  /** Sets the band of the straight portion, as path data in the plane, or "". */
  band(data) {
    this.#data("band", data);
  }

  /** Sets the fixed centrode, as path data in the plane. */
  centrode(data) {
    this.#data("centrode", data);
  }

  place(view, { width, height }) {
    const { scale, x, y } = view;
    this.group.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${x} ${y})`);
    this.ground.setAttribute(
      "d",
      this.pivots.map(([px, py]) => groundData(x + scale * px, y - scale * py)).join(""),
    );
    this.limitMarks.setAttribute("d", this.limits.map((limit) => limitData(limit, view)).join(""));
    const length = roundBelow(Math.min(0.22 * width, 160) / scale);
    const [left, foot] = [14, height - 14];
    this.bar.setAttribute("d", `M${left} ${foot - 3}v6M${left} ${foot}h${pixel(scale * length)}m0 -3v6`);
    this.barLabel.setAttribute("x", pixel(left + scale * length + 6));
    this.barLabel.setAttribute("y", foot + 4);
    const decimals = Math.max(0, -Math.floor(Math.log10(length) + 1e-9));
    this.barLabel.textContent = decimals > 6 ? String(length) : length.toFixed(decimals);
  }

  #data(name, data) {
    this.plane[name].setAttribute("d", data);
  }
}

// The arc of the crank pin as path data, and its positions at the limits of the input, each with the pivot,
// [x, y, ox, oy]; for a crank on a fixed pivot that has limits.
function crankRange({ joints }, { x, y, count, input }, timeline, fixed) {
  const pin = joints.findIndex(({ step }) => step.kind === "crank" && fixed.includes(step.pivot));
  if (pin < 0 || turningParts(timeline).length === 0) return { arc: "", limits: [] };
  const { pivot } = joints[pin].step;
  let [least, most] = [0, 0];
  for (let i = 0; i < count; i++) {
    if (input[i] < input[least]) least = i;
    if (input[i] > input[most]) most = i;
  }
  // From one limit to the other, on one pass.
  const arc = [];
  for (let i = Math.min(least, most); i <= Math.max(least, most); i++) arc.push(x[pin][i], y[pin][i]);
  return {
    arc: polylineData(arc),
    limits: [least, most].map((i) => [x[pin][i], y[pin][i], x[pivot][0], y[pivot][0]]),
  };
}

// A mark across the arc of the crank pin, of constant length at any zoom.
function limitData([px, py, ox, oy], { scale, x, y }) {
  const [dx, dy] = [px - ox, oy - py];
  const by = 9 / Math.hypot(dx, dy);
  const [X, Y] = [x + scale * px, y - scale * py];
  return `M${pixel(X - by * dx)} ${pixel(Y - by * dy)}L${pixel(X + by * dx)} ${pixel(Y + by * dy)}`;
}
