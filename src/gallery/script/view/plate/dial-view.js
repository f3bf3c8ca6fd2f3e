// The dial of the transmission angle.

import { dialArc, dialField, dialStroke } from "../../draw/dial.js";
import { h, s } from "../dom.js";
import { transmissionAt } from "../../kinematics/four-bar.js";
import { formatDecimals } from "./study.js";

const DIAL_CENTRE = [100, 98];
const DIAL_RADIUS = 78;
// The transmission angle of a good linkage stays at least this far from 0 and 180.
const GOOD_TRANSMISSION_DEG = 40;

/**
 * The dial: `show(study)` sets its range, `pose(pose)` its needle. Hidden if the linkage is not a four-bar.
 */
export class DialView {
  constructor() {
    this.range = s("path", { class: "dial-range" });
    this.needle = s("path", {
      class: "dial-needle",
      d: `M${DIAL_CENTRE[0]} ${DIAL_CENTRE[1]}h${DIAL_RADIUS - 6}`,
    });
    this.now = h("span", { class: "dial-now" });
    this.least = h("span", {});
    this.most = h("span", {});
    const ticks = Array.from({ length: 19 }, (_, k) =>
      dialStroke(DIAL_CENTRE, DIAL_RADIUS - (k % 3 === 0 ? 7 : 4), DIAL_RADIUS, 10 * k),
    ).join("");
    const bounds = [GOOD_TRANSMISSION_DEG, 180 - GOOD_TRANSMISSION_DEG]
      .map((deg) => dialStroke(DIAL_CENTRE, 14, DIAL_RADIUS + 9, deg))
      .join("");
    const words = [
      [0, 190, 98],
      [90, 100, 12],
      [180, 10, 98],
      [40, 170, 38],
      [140, 30, 38],
    ].map(([deg, x, y]) =>
      s("text", { x, y: y + 4, class: deg % 90 ? "dial-word bound" : "dial-word" }, deg),
    );
    this.drawing = s(
      "svg",
      { class: "dial", viewBox: "0 0 200 112", role: "img", "aria-label": "Dial of the transmission angle" },
      s("path", { class: "dial-rim", d: dialArc(DIAL_CENTRE, DIAL_RADIUS, 0, 180) + ticks }),
      this.range,
      s("path", { class: "dial-bounds", d: bounds }),
      words,
      this.needle,
      s("circle", { class: "dial-hub", cx: DIAL_CENTRE[0], cy: DIAL_CENTRE[1], r: 3 }),
    );
    this.element = h(
      "section",
      { class: "gauge dial-gauge" },
      h("h3", {}, "Transmission angle ", this.now),
      this.drawing,
      h(
        "p",
        { class: "note" },
        "least ",
        this.least,
        ", greatest ",
        this.most,
        " over the circuit; the hairlines are at 40° and 140°",
      ),
    );
    this.study = null;
    this.shown = NaN;
  }

  show(study) {
    this.study = study.fourBar ? study : null;
    this.element.hidden = !this.study;
    if (!this.study) return;
    const [least, most] = dialRange(study);
    this.least.textContent = `${formatDecimals(least, 1)}°`;
    this.most.textContent = `${formatDecimals(most, 1)}°`;
    this.range.setAttribute(
      "d",
      dialField(DIAL_CENTRE, DIAL_RADIUS - 16, DIAL_RADIUS, least, Math.max(most, least + 0.3)),
    );
    this.drawing.setAttribute(
      "aria-label",
      `Dial of the transmission angle: from ${this.least.textContent} to ${this.most.textContent} ` +
        "over the circuit",
    );
  }

  pose(pose) {
    if (!this.study) return;
    const { mu } = transmissionAt(this.study.linkage, this.study.fourBar, pose);
    if (!Number.isFinite(mu) || mu === this.shown) return;
    this.shown = mu;
    this.needle.setAttribute("transform", `rotate(${-mu} ${DIAL_CENTRE[0]} ${DIAL_CENTRE[1]})`);
    this.now.textContent = `${formatDecimals(mu, 1)}°`;
    this.element.classList.toggle("poor", mu < GOOD_TRANSMISSION_DEG || mu > 180 - GOOD_TRANSMISSION_DEG);
  }
}

// The least and greatest angle over the samples of a circuit, which include its limits.
function dialRange({ linkage, fourBar, circuit }) {
  const pose = new Float64Array(2 * linkage.joints.length);
  let [least, most] = [180, 0];
  for (let i = 0; i < circuit.count; i++) {
    for (const joint of Object.values(fourBar.joints))
      pose.set([circuit.x[joint][i], circuit.y[joint][i]], 2 * joint);
    const { mu } = transmissionAt(linkage, fourBar, pose);
    if (!Number.isFinite(mu)) continue;
    least = Math.min(least, mu);
    most = Math.max(most, mu);
  }
  return [least, most];
}
