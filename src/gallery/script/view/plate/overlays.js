// Overlays of a linkage: its cognates, the centrodes of the link that traces the curve, the inflection
// circle, the velocity of the point, names, the straight portion, and the curves of other points.

import { cognatePins, cognatesOf } from "../../kinematics/cognates.js";
import { fixedCentrode, movingCentrode, poleAt } from "../../kinematics/instantaneous-motion.js";
import { sampleCircuit, newSampler } from "../../kinematics/sampling.js";
import { clippedData } from "../../draw/clipping.js";
import { linkData } from "../../draw/link-shapes.js";
import { circleData, pixel, definedData } from "../../draw/path-data.js";
import { emptyBox, widenedBox } from "../../draw/plane-view.js";
import { s } from "../dom.js";

/** The overlays, { name, label, isOn (the default), there(study) }. */
export const OVERLAYS = [
  { name: "names", label: "Joint names", isOn: true, there: () => true },
  { name: "straight", label: "Straight portion", isOn: true, there: () => true },
  { name: "others", label: "Curves of other points", isOn: true, there: ({ others }) => others.length > 0 },
  { name: "velocity", label: "Velocity", isOn: false, there: () => true },
  { name: "cognates", label: "Cognates", isOn: false, there: (study) => cognatesOfStudy(study) !== null },
  { name: "centrodes", label: "Centrodes and instant centre", isOn: false, there: hasPole },
  { name: "inflection", label: "Inflection circle", isOn: false, there: hasPole },
];

/** The cognates of a study's curve (kinematics/cognates.js), or null; the first is the linkage itself. */
export function cognatesOfStudy(study) {
  return study.isCouplerPoint ? cognatesOf(study.linkage, study.joint) : null;
}

/** Whether the link with the traced joint rotates anywhere on the circuit. */
function hasPole({ linkage, circuit, joint }) {
  return [0.2, 0.45, 0.7].some((part) => {
    const i = Math.floor(part * circuit.count);
    return poleAt(linkage, circuit.passes[circuit.pass[i]], circuit.input[i], joint) !== null;
  });
}

/** The moving overlays, drawn on a stage. */
export class Overlays {
  constructor(stage) {
    this.stage = stage;
    const path = (name) => s("path", { class: name });
    this.cognates = [path("cognate first"), path("cognate second")];
    this.cognatePins = path("cognate pins");
    this.rolling = s("path", { class: "centrode moving", "vector-effect": "non-scaling-stroke" });
    this.pole = path("pole");
    this.circle = path("inflection");
    stage.moving.overlays.append(...this.cognates, this.cognatePins, this.rolling, this.circle, this.pole);
    this.on = new Set();
    this.study = null;
  }

  /** Shows the selected overlays for a study; `isRough` while lengths are changing. */
  show(study, on, isRough) {
    this.study = study;
    this.on = on;
    const { classList } = this.stage.element;
    for (const { name } of OVERLAYS) classList.toggle(`with-${name}`, on.has(name));
    this.pair = on.has("cognates") ? cognatesOfStudy(study) : null;
    this.stage.frame(this.pair ? boxWithCognates(study, this.pair) : study.box);
    if (!this.pair) [...this.cognates, this.cognatePins].forEach((element) => element.setAttribute("d", ""));
    this.#centrodes(isRough);
    if (!on.has("inflection")) this.circle.setAttribute("d", "");
  }

  #centrodes(isRough) {
    const { study } = this;
    this.arm = null;
    this.rolling.setAttribute("d", "");
    this.pole.setAttribute("d", "");
    this.stage.still.centrode("");
    if (!this.on.has("centrodes")) return;
    const { linkage, joint, size } = study;
    const circuit = isRough
      ? study.circuit
      : sampleCircuit(linkage, newSampler({ samples: 1440, spacing: "smooth" }), study.circuit);
    const moving = movingCentrode(linkage, circuit, joint);
    if (!moving.frame) return;
    const [x0, y0, x1, y1] = study.box;
    // Centrodes can be unbounded: they are clipped some distance beyond the frame.
    const reach = 6 * size;
    const box = [x0 - reach, y0 - reach, x1 + reach, y1 + reach];
    this.stage.still.centrode(
      clippedData(ringOf(fixedCentrode(linkage, circuit, joint), circuit.closed), box),
    );
    this.rolling.setAttribute(
      "d",
      clippedData(ringOf(moving.points, circuit.closed), [-reach, -reach, reach, reach]),
    );
    this.arm = moving.frame;
  }

  /** Moves the overlays with the linkage: its pose, in the plane, at an input of a pass. */
  pose(pose, view, pass, input) {
    if (this.pair) this.#poseCognates(pose, view);
    if (this.arm) this.#rollCentrode(pose, view);
    if (!this.arm && !this.on.has("inflection")) return;
    const { linkage, joint } = this.study;
    const instant = poleAt(linkage, pass, input, joint);
    const { x, y, scale } = view;
    const place = ([px, py]) => [x + scale * px, y - scale * py];
    const isFar =
      !instant ||
      Math.hypot(...instant.pole) > 1e3 * this.study.size + Math.hypot(this.study.box[0], this.study.box[1]);
    if (this.arm) this.pole.setAttribute("d", isFar ? "" : crossData(...place(instant.pole)));
    if (this.on.has("inflection"))
      this.circle.setAttribute(
        "d",
        isFar ? "" : inflectionData(place(instant.pole), place(instant.inflection)),
      );
  }

  #poseCognates(pose, { x, y, scale }) {
    const { study, pair } = this;
    const point = [pose[2 * study.joint], pose[2 * study.joint + 1]];
    let pins = "";
    pair.cognates.slice(1).forEach((cognate, k) => {
      const [ax, ay, bx, by] = cognatePins(study.linkage, cognate, pose);
      const [o, c] = cognate.pivots;
      const at = [o, [ax, ay], [bx, by], c, point].flatMap(([px, py]) => [x + scale * px, y - scale * py]);
      this.cognates[k].setAttribute(
        "d",
        definedData(`${linkData([0, 1], at)}${linkData([1, 2, 4], at, true)}${linkData([2, 3], at)}`),
      );
      for (const joint of [1, 2]) pins += circleData(at[2 * joint], at[2 * joint + 1], 3.5, 6);
      for (const joint of [0, 3]) pins += circleData(at[2 * joint], at[2 * joint + 1], 5, 6);
    });
    this.cognatePins.setAttribute("d", definedData(pins));
  }

  // The moving centrode is drawn in the frame of its link and moved by a transform.
  #rollCentrode(pose, { x, y, scale }) {
    const [a, b] = this.arm;
    const [dx, dy] = [pose[2 * b] - pose[2 * a], pose[2 * b + 1] - pose[2 * a + 1]];
    const size = Math.hypot(dx, dy);
    if (!(size > 0)) return;
    const [ux, uy] = [(scale * dx) / size, (scale * dy) / size];
    const [ox, oy] = [x + scale * pose[2 * a], y - scale * pose[2 * a + 1]];
    this.rolling.setAttribute("transform", `matrix(${ux} ${-uy} ${-uy} ${-ux} ${pixel(ox)} ${pixel(oy)})`);
  }
}

function ringOf(points, closed) {
  return closed ? Float64Array.from([...points, points[0], points[1]]) : points;
}

function crossData(x, y) {
  const [px, py] = [pixel(x), pixel(y)];
  return `M${px - 6} ${py}h12M${px} ${py - 6}v12`;
}

function inflectionData([px, py], [qx, qy]) {
  const radius = Math.hypot(qx - px, qy - py) / 2;
  if (!(radius < 2e4)) return "";
  return circleData((px + qx) / 2, (py + qy) / 2, radius, 6);
}

function boxWithCognates({ linkage, circuit, box }, { thirdPivot, cognates }) {
  const wide = [...box];
  widenedBox(wide, [thirdPivot[0]], [thirdPivot[1]]);
  const pose = new Float64Array(2 * linkage.joints.length);
  const own = emptyBox();
  for (let i = 0; i < circuit.count; i += 8) {
    linkage.joints.forEach((_, joint) => pose.set([circuit.x[joint][i], circuit.y[joint][i]], 2 * joint));
    for (const cognate of cognates.slice(1)) {
      const [ax, ay, bx, by] = cognatePins(linkage, cognate, pose);
      widenedBox(own, [ax, bx], [ay, by]);
    }
  }
  if (!Number.isFinite(own[0])) return wide;
  return widenedBox(wide, [own[0], own[2]], [own[1], own[3]]);
}
