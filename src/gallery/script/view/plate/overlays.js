// Overlays of a linkage: its cognates, the centrodes of the link that traces the curve, the inflection
// circle, the velocity of the point, names, the straight portion, and the curves of other points.

import { clippedData } from "../../draw/clipping.js";
import { linkData } from "../../draw/link-shapes.js";
import { circleData, pixel, definedData } from "../../draw/path-data.js";
import { screenPoint, widenedBox } from "../../draw/plane-view.js";
import { s, setAttributes } from "../dom.js";

/** The overlays; `isOn` is the default. @type {{ name: string, label: string, isOn: boolean, there(study: Study): boolean }[]} */
export const OVERLAYS = [
  { name: "names", label: "Joint names", isOn: true, there: () => true },
  { name: "straight", label: "Straight portion", isOn: true, there: () => true },
  { name: "others", label: "Curves of other points", isOn: true, there: ({ others }) => others.length > 0 },
  { name: "velocity", label: "Velocity", isOn: false, there: () => true },
  { name: "cognates", label: "Cognates", isOn: false, there: (study) => study.has_cognates },
  { name: "centrodes", label: "Centrodes and instant centre", isOn: false, there: (study) => study.has_pole },
  { name: "inflection", label: "Inflection circle", isOn: false, there: (study) => study.has_pole },
];

// The numbers of samples of centrodes.
const ROUGH_CENTRODES = 240;
const FINE_CENTRODES = 1440;

/** The cognates of a study's curve (KernelStudy.cognates), or null. @param {Study} study */
export function cognatesOfStudy(study) {
  return study.has_cognates ? study.kernel.cognates() : null;
}

/** The moving overlays, drawn on a stage. */
export class Overlays {
  /** @type {Study} */ study;
  /** @type {Set<string>} */ on = new Set();
  /** @type {Cognates | null} */ pair = null;
  /** The joints that give the frame of the moving centrode. @type {[number, number] | null} */ arm = null;

  constructor(/** @type {Stage} */ stage) {
    this.stage = stage;
    const path = (/** @type {string} */ name) => s("path", { class: name });
    this.cognates = [path("cognate first"), path("cognate second")];
    this.cognatePins = path("cognate pins");
    this.rolling = s("path.centrode.moving", { "vector-effect": "non-scaling-stroke" });
    this.pole = path("pole");
    this.circle = path("inflection");
    stage.moving.overlays.append(...this.cognates, this.cognatePins, this.rolling, this.circle, this.pole);
  }

  /** Shows the selected overlays for a study; `isRough` while lengths are changing. @param {Study} study */
  show(study, /** @type {Set<string>} */ on, /** @type {boolean} */ isRough) {
    this.study = study;
    this.on = on;
    const { classList } = this.stage.element;
    for (const { name } of OVERLAYS) classList.toggle(`with-${name}`, on.has(name));
    this.pair = on.has("cognates") ? cognatesOfStudy(study) : null;
    this.stage.box = this.pair ? widenedBox([...study.box], this.pair.reached) : study.box;
    if (!this.pair) [...this.cognates, this.cognatePins].forEach((element) => element.setAttribute("d", ""));
    this.#centrodes(isRough);
    if (!on.has("inflection")) this.circle.setAttribute("d", "");
  }

  #centrodes(/** @type {boolean} */ isRough) {
    const { study } = this;
    this.arm = null;
    this.rolling.setAttribute("d", "");
    this.pole.setAttribute("d", "");
    this.stage.still.draw("centrode", "");
    if (!this.on.has("centrodes")) return;
    const centrodes = study.kernel.centrodes(isRough ? ROUGH_CENTRODES : FINE_CENTRODES);
    if (!centrodes) return;
    const [x0, y0, x1, y1] = study.box;
    // Centrodes can be unbounded: they are clipped some distance beyond the frame.
    const reach = 6 * study.size;
    const box = [x0 - reach, y0 - reach, x1 + reach, y1 + reach];
    const { closed } = study.circuits[study.shown];
    this.stage.still.draw("centrode", clippedData(ringOf(centrodes.fixed, closed), box));
    const around = [-reach, -reach, reach, reach];
    setAttributes(this.rolling, { d: clippedData(ringOf(centrodes.moving, closed), around) });
    this.arm = centrodes.frame;
  }

  /** Moves the overlays with the linkage. @param {Float64Array} pose @param {Placement} view @param {Pose["instant"]} _ */
  pose(pose, view, { pole, inflection, pins }) {
    if (this.pair) this.#poseCognates(this.pair, pose, view, pins);
    if (this.arm) this.#rollCentrode(this.arm, pose, view);
    if (!this.arm && !this.on.has("inflection")) return;
    const { box, size } = this.study;
    const place = (/** @type {Float64Array} */ [px, py]) => screenPoint(view, [px, py]);
    // A link that translates has no pole.
    const isFar = !(Math.hypot(...pole) <= 1e3 * size + Math.hypot(box[0], box[1]));
    if (this.arm) this.pole.setAttribute("d", isFar ? "" : crossData(place(pole)));
    if (this.on.has("inflection"))
      this.circle.setAttribute("d", isFar ? "" : inflectionData(place(pole), place(inflection)));
  }

  /** @param {Points} pose @param {Float64Array} pins */
  #poseCognates(/** @type {Cognates} */ pair, pose, /** @type {Placement} */ { x, y, scale }, pins) {
    const { study } = this;
    const point = [pose[2 * study.joint], pose[2 * study.joint + 1]];
    let circles = "";
    pair.pivots.forEach(([ox, oy, cx, cy], k) => {
      const [ax, ay, bx, by] = pins.slice(4 * k, 4 * k + 4);
      const places = [ox, oy, ax, ay, bx, by, cx, cy, ...point];
      const at = places.map((place, i) => (i % 2 ? y - scale * place : x + scale * place));
      const data = `${linkData([0, 1], at)}${linkData([1, 2, 4], at, true)}${linkData([2, 3], at)}`;
      this.cognates[k].setAttribute("d", definedData(data));
      for (const joint of [1, 2]) circles += circleData(at[2 * joint], at[2 * joint + 1], 3.5, 6);
      for (const joint of [0, 3]) circles += circleData(at[2 * joint], at[2 * joint + 1], 5, 6);
    });
    this.cognatePins.setAttribute("d", definedData(circles));
  }

  /** The moving centrode is drawn in the frame of its link and moved by a transform. @param {Points} pose */
  #rollCentrode(/** @type {[number, number]} */ [a, b], pose, /** @type {Placement} */ view) {
    const [dx, dy] = [pose[2 * b] - pose[2 * a], pose[2 * b + 1] - pose[2 * a + 1]];
    const size = Math.hypot(dx, dy);
    if (!(size > 0)) return;
    const [ux, uy] = [(view.scale * dx) / size, (view.scale * dy) / size];
    const [ox, oy] = screenPoint(view, [pose[2 * a], pose[2 * a + 1]]);
    this.rolling.setAttribute("transform", `matrix(${ux} ${-uy} ${-uy} ${-ux} ${pixel(ox)} ${pixel(oy)})`);
  }
}

function ringOf(/** @type {Float64Array} */ points, /** @type {boolean} */ closed) {
  return closed ? Float64Array.from([...points, points[0], points[1]]) : points;
}

function crossData(/** @type {Point} */ [x, y]) {
  const [px, py] = [pixel(x), pixel(y)];
  return `M${px - 6} ${py}h12M${px} ${py - 6}v12`;
}

function inflectionData(/** @type {Point} */ [px, py], /** @type {Point} */ [qx, qy]) {
  const radius = Math.hypot(qx - px, qy - py) / 2;
  if (!(radius < 2e4)) return "";
  return circleData((px + qx) / 2, (py + qy) / 2, radius, 6);
}
