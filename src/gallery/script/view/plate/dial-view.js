// The dial of the transmission angle.

import { h, s } from "../dom.js";
import { pixel } from "../../draw/path-data.js";
import { formatDecimals } from "../labels.js";

const DIAL_CENTRE = [100, 98];
const DIAL_RADIUS = 78;
// The transmission angle of a good linkage stays at least this far from 0 and 180.
const GOOD_TRANSMISSION_DEG = 40;

/** The dial: `show(study)` sets its range, `pose(mu)` its needle. Hidden if the linkage is not a four-bar. */
export class DialView {
  constructor() {
    this.range = s("path.dial-range");
    this.needle = s("path.dial-needle", { d: `M${DIAL_CENTRE[0]} ${DIAL_CENTRE[1]}h${DIAL_RADIUS - 6}` });
    this.now = h("span.dial-now");
    this.least = h("span");
    this.most = h("span");
    const ticks = Array.from({ length: 19 }, (_, k) =>
      dialStroke(DIAL_RADIUS - (k % 3 === 0 ? 7 : 4), DIAL_RADIUS, 10 * k),
    ).join("");
    const bounds = [GOOD_TRANSMISSION_DEG, 180 - GOOD_TRANSMISSION_DEG]
      .map((deg) => dialStroke(14, DIAL_RADIUS + 9, deg))
      .join("");
    const numbers = [0, 40, 90, 140, 180].map((deg) => {
      const [x, y] = dialPlace(DIAL_RADIUS + 14, deg);
      return s("text", { x, y: y + 4, class: deg % 90 ? "dial-word bound" : "dial-word" }, deg);
    });
    this.drawing = s(
      "svg.dial",
      { viewBox: "0 0 200 112", role: "img", "aria-label": "Dial of the transmission angle" },
      s("path.dial-rim", { d: dialArc(DIAL_RADIUS, 0, 180) + ticks }),
      this.range,
      s("path.dial-bounds", { d: bounds }),
      numbers,
      this.needle,
      s("circle.dial-hub", { cx: DIAL_CENTRE[0], cy: DIAL_CENTRE[1], r: 3 }),
    );
    const words = ["least ", this.least, ", greatest ", this.most];
    const note = h("p.note", words, " over the circuit; the hairlines are at 40° and 140°");
    const heading = h("h3", "Transmission angle ", this.now);
    this.element = h("section.gauge.dial-gauge", heading, this.drawing, note);
    this.shown = NaN;
  }

  show(/** @type {Study} */ study) {
    const angles = study.four_bar?.transmission_range ?? null;
    this.element.hidden = angles === null;
    if (angles === null) return;
    const [least, most] = angles;
    this.least.textContent = `${formatDecimals(least, 1)}°`;
    this.most.textContent = `${formatDecimals(most, 1)}°`;
    const field = dialField(DIAL_RADIUS - 16, DIAL_RADIUS, least, Math.max(most, least + 0.3));
    this.range.setAttribute("d", field);
    const range = `from ${this.least.textContent} to ${this.most.textContent} over the circuit`;
    this.drawing.setAttribute("aria-label", `Dial of the transmission angle: ${range}`);
  }

  /** The transmission angle of a pose, in degrees. */
  pose(/** @type {number} */ mu) {
    if (!Number.isFinite(mu) || mu === this.shown) return;
    this.shown = mu;
    this.needle.setAttribute("transform", `rotate(${-mu} ${DIAL_CENTRE[0]} ${DIAL_CENTRE[1]})`);
    this.now.textContent = `${formatDecimals(mu, 1)}°`;
    this.element.classList.toggle("poor", mu < GOOD_TRANSMISSION_DEG || mu > 180 - GOOD_TRANSMISSION_DEG);
  }
}

/** The position of an angle in degrees at a radius about the dial's centre, [X, Y], y down. @returns {Point} */
function dialPlace(/** @type {number} */ radius, /** @type {number} */ deg) {
  const angle = (deg * Math.PI) / 180;
  const [cx, cy] = DIAL_CENTRE;
  return [pixel(cx + radius * Math.cos(angle)), pixel(cy - radius * Math.sin(angle))];
}

/** Path data of the arc from one angle to a greater one. */
function dialArc(/** @type {number} */ radius, /** @type {number} */ from, /** @type {number} */ to) {
  const large = to - from > 180 ? 1 : 0;
  return `M${dialPlace(radius, from)}A${radius} ${radius} 0 ${large} 0 ${dialPlace(radius, to)}`;
}

/** Path data of a line along a radius. */
function dialStroke(/** @type {number} */ inner, /** @type {number} */ outer, /** @type {number} */ deg) {
  return `M${dialPlace(inner, deg)}L${dialPlace(outer, deg)}`;
}

/** Path data of the sector between two angles and two radii. @param {number} inner @param {number} outer @param {number} from @param {number} to */
function dialField(inner, outer, from, to) {
  const back = `A${inner} ${inner} 0 ${to - from > 180 ? 1 : 0} 1 ${dialPlace(inner, from)}`;
  return `${dialArc(outer, from, to)}L${dialPlace(inner, to)}${back}Z`;
}
