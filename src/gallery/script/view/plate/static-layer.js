// The static parts of a plate: the dashed curve, other curves, guides, wheels, the straight portion, the
// fixed centrode, the ground, and a scale bar.

import { circleData, pixel, polylineData } from "../../draw/path-data.js";
import { pointPairs, roundBelow, screenPoint } from "../../draw/plane-view.js";
import { s, setAttributes } from "../dom.js";
import { groundData } from "../../draw/link-shapes.js";

/** The lower layer of a stage. */
export class StaticLayer {
  constructor() {
    /** @param {string} name */
    const path = (name) => s("path", { class: name, "vector-effect": "non-scaling-stroke" });
    // In the plane: one transform positions everything, and line widths are constant.
    const below = ["frame-line", "wheels", "guides", "crank-range", "ghost", "others"];
    const names = [...below, "centrode fixed", "band", "lead", "dashes"];
    this.plane = Object.fromEntries(names.map((name) => [name.split(" ")[0], path(name)]));
    this.group = s("g", Object.values(this.plane));
    this.ground = s("path.ground");
    this.limitMarks = s("path.limit-marks");
    this.bar = s("path.scale-bar");
    this.barLabel = s("text.scale-label");
    const parts = [this.ground, this.group, this.limitMarks, this.bar, this.barLabel];
    this.element = s("svg.sheet.still", { "aria-hidden": "true" }, parts);
    /** @type {Point[]} */ this.pivots = [];
    /** @type {number[][]} */ this.limits = [];
  }

  show(/** @type {Study} */ { mechanism, crank }, /** @type {CurveData} */ { dashes, lead, others, band }) {
    const { fixed_at: fixed, frame_at: frame, guides, wheels } = mechanism;
    this.pivots = pointPairs(fixed);
    this.draw("frame-line", polylineData(frame, { closed: frame.length > 4 }));
    this.draw("wheels", wheels.map(([x, y, radius]) => circleData(x, y, radius)).join(""));
    this.draw("guides", guides.map((ends) => polylineData(ends)).join(""));
    const pivot = crank && this.pivots[mechanism.fixed.indexOf(crank.pivot)];
    this.limits = pivot ? pointPairs(crank.limits).map((limit) => [...limit, ...pivot]) : [];
    this.draw("crank-range", pivot ? polylineData(crank.arc) : "");
    this.draw("others", others);
    this.draw("band", band);
    this.draw("lead", lead);
    this.draw("dashes", dashes);
  }

  place(/** @type {Placement} */ view, /** @type {Size} */ { width, height }) {
    const { scale, x, y } = view;
    this.group.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${x} ${y})`);
    const ground = this.pivots.map((pivot) => groundData(...screenPoint(view, pivot)));
    this.ground.setAttribute("d", ground.join(""));
    this.limitMarks.setAttribute("d", this.limits.map((limit) => limitData(limit, view)).join(""));
    const length = roundBelow(Math.min(0.22 * width, 160) / scale);
    const [left, foot] = [14, height - 14];
    this.bar.setAttribute("d", `M${left} ${foot - 3}v6M${left} ${foot}h${pixel(scale * length)}m0 -3v6`);
    setAttributes(this.barLabel, { x: pixel(left + scale * length + 6), y: foot + 4 });
    const decimals = Math.max(0, -Math.floor(Math.log10(length) + 1e-9));
    this.barLabel.textContent = decimals > 6 ? String(length) : length.toFixed(decimals);
  }

  /** Sets a part, such as the curve behind a changed one, "ghost", as path data in the plane. */
  draw(/** @type {string} */ name, /** @type {string} */ data) {
    this.plane[name].setAttribute("d", data);
  }
}

// A mark across the arc of the crank pin, at a limit [x, y, pivot x, pivot y], of constant length at any zoom.
function limitData(/** @type {number[]} */ [px, py, ox, oy], /** @type {Placement} */ view) {
  const [dx, dy] = [px - ox, oy - py];
  const by = 9 / Math.hypot(dx, dy);
  const [X, Y] = screenPoint(view, [px, py]);
  return `M${pixel(X - by * dx)} ${pixel(Y - by * dy)}L${pixel(X + by * dx)} ${pixel(Y + by * dy)}`;
}
