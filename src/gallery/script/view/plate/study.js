// The study of a linkage: the assembled linkage, all its circuits, and the one shown; studied roughly while it is changed.

import { KernelFailure, POSE_HEADER } from "../../kernel/instance.js";
import { timelineOf } from "./timeline.js";
import { measureValue } from "../../data/family.js";
import { formatLength, formatDecimals } from "../labels.js";

// The time in milliseconds after which a slider has rested.
const REST_MILLISECONDS = 160;

/**
 * The study of a curve with changes, as a plate shows it, on the circuit `requested` if it exists. A rough study without a requested
 * circuit has no other circuits.
 * @param {Kernel} kernel @param {KernelCurve} curve @param {number | null} requested @returns {Study | MissingCurve}
 */
export function studyOf(kernel, curve, requested = null, isRough = false) {
  try {
    return studyInKernel(kernel.study(curve, { shown: requested, isRough }));
  } catch (error) {
    if (!(error instanceof KernelFailure)) throw error;
    return { reason: error.message, circuits: [] };
  }
}

/** @returns {Study | MissingCurve} */
function studyInKernel(/** @type {KernelStudy} */ study) {
  const { answer } = study;
  if (answer.study === undefined) return { ...answer, reason: plainReason(answer.reason) };
  const box = boxWithOthers(answer.box, answer.others_box);
  return {
    ...answer,
    kernel: study,
    timeline: timelineOf(answer.circuits[answer.shown]),
    box,
    size: Math.hypot(box[2] - box[0], box[3] - box[1]),
  };
}

// The kernel says which cell of which family it is, which the plate's title says too.
function plainReason(/** @type {string} */ reason) {
  return reason.replace(/^[^\s:]+:(\d+:)? /gm, "").replaceAll("\n", "; ");
}

// The frame includes the curves of other points unless the linkage would become small in it.
function boxWithOthers(/** @type {Box} */ box, /** @type {Box} */ wide) {
  const extent = (/** @type {Box} */ [x0, y0, x1, y1]) => Math.max(x1 - x0, y1 - y0);
  return extent(wide) <= 1.6 * extent(box) ? wide : box;
}

/** The values of a family's names and the traced point of a curve, { values, point }, without changes. @param {number} curve */
export function recordedValues(/** @type {Kernel} */ kernel, /** @type {Family} */ family, curve) {
  const study = kernel.study(kernel.curve(family, curve), { isRough: true });
  const { values = {}, point = null } = study.answer;
  study.close();
  return { values, point };
}

/** The pose of a study, in the same arrays for all frames. */
export class Pose {
  constructor() {
    this.header = new Float64Array(POSE_HEADER);
    /** The positions of the joints in the plane, [x0, y0, x1, y1, …]. */ this.joints = new Float64Array();
    this.velocity = this.header.subarray(1, 3);
    this.instant = {
      pole: this.header.subarray(3, 5),
      inflection: this.header.subarray(5, 7),
      pins: this.header.subarray(7, 15),
    };
  }

  /** Moves to an input of a pass of a study. @param {Study} study */
  move(study, /** @type {number} */ pass, /** @type {number} */ input) {
    const numbers = study.kernel.pose(pass, input);
    const count = numbers.length - POSE_HEADER;
    if (this.joints.length !== count) this.joints = new Float64Array(count);
    this.header.set(numbers.subarray(0, POSE_HEADER));
    this.joints.set(numbers.subarray(POSE_HEADER));
  }

  /** The transmission angle, in degrees. */
  get transmission() {
    return this.header[0];
  }
}

/**
 * The arrow of a velocity, per radian of input or unit of length, in pixels, y down: it goes as far as the point would in `by`, a radian
 * or a part of the stroke, but at most through three tenths of the frame. Null if infinite.
 * @param {Float64Array} _ @param {{ by: number, scale: number, size: Size }} _1
 */
export function velocityArrow([vx, vy], { by, scale, size }) {
  const speed = Math.hypot(vx, vy);
  if (!Number.isFinite(speed)) return null;
  const long =
    Math.sign(by) * Math.min(scale * Math.abs(by), (0.3 * Math.min(size.width, size.height)) / speed);
  return [long * vx, -long * vy];
}

/** The title of a circuit: "a full turn, branch 1", "−75.5° to 75.5°, branch 1 and −1". */
export function circuitTitle(/** @type {boolean} */ isLength, /** @type {Circuit} */ { passes, closed }) {
  /** @param {number} at */
  const formatInput = (at) => (isLength ? lengthLabel(at) : `${formatDecimals(at, 1)}°`);
  const ends = passes.flatMap(({ from, to }) => [from, to]);
  const [low, high] = [Math.min(...ends), Math.max(...ends)];
  const branches = [...new Set(passes.map(({ sides }) => branchLabel(sides)))].filter(Boolean);
  const turns =
    passes.every((pass) => Math.sign(pass.to - pass.from) === Math.sign(passes[0].to - passes[0].from)) &&
    closed;
  const travel = turns ? turnsLabel(high - low) : `${formatInput(low)} to ${formatInput(high)}`;
  return branches.length ? `${travel}, branch ${branches.slice(0, 2).join(" and ")}` : travel;
}

function lengthLabel(/** @type {number} */ length) {
  return formatDecimals(Number(length.toPrecision(4)), 4).replace(/\.?0+$/, "");
}

function turnsLabel(/** @type {number} */ degrees) {
  const turns = Math.round(degrees / 360);
  return turns === 1 ? "a full turn" : `${turns} turns`;
}

// The sides of all two-valued joints: 1 left, −1 right.
function branchLabel(/** @type {number[]} */ sides) {
  return sides.map((side) => (side > 0 ? "1" : "−1")).join("/");
}

/** A few sentences that describe the drawing. @param {Family} family @param {Study} study @param {number} curve @param {boolean} isRecorded */
export function summaryOfStudy(family, curve, study, isRecorded) {
  const { circuits, shown, mechanism, joint, joints, four_bar: fourBar } = study;
  const words = [];
  const moving = mechanism.bars.length + mechanism.plates.length;
  const kind = fourBar ? `A four-bar, ${fourBar.class}` : `A linkage of ${moving} moving links`;
  words.push(`${kind}, ${mechanism.fixed.length} fixed pivots, tracing point ${joints[joint]}.`);
  words.push(`Its circuit: ${circuitTitle(study.is_length, circuits[shown])}.`);
  const box = study.curve_box;
  words.push(`The curve is ${formatLength(box[2] - box[0])} wide and ${formatLength(box[3] - box[1])} high.`);
  const of = (/** @type {string} */ name) => Number(isRecorded ? measureValue(family, curve, name) : NaN);
  // A family may be measured only in part.
  const [length, deviation] = [of("straight_length"), of("straight_deviation")];
  if (length > 0 && Number.isFinite(deviation))
    words.push(`Its straightest portion is ${formatLength(length)} long, within ${formatLength(deviation)}.`);
  const [least, most] = [of("mu_min_deg"), of("mu_max_deg")].map((angle) => formatDecimals(angle, 1));
  if (Number.isFinite(of("mu_min_deg")) && Number.isFinite(of("mu_max_deg")))
    words.push(`Transmission angle from ${least} to ${most} degrees.`);
  if (!isRecorded) words.push("Its parameters or its circuit are changed.");
  return words.join(" ");
}

/** Calls `study(isRough)` for changes, and marks an element as busy until they have rested. */
export class Resting {
  resting = 0;
  waiting = 0;

  /** @param {HTMLElement} element @param {(isRough: boolean) => void} study */
  constructor(element, study) {
    this.element = element;
    this.study = study;
  }

  /** After a change, of which more may follow. */
  changed() {
    this.soon(REST_MILLISECONDS);
    // At most one study per frame.
    this.waiting ||= window.requestAnimationFrame(() => {
      this.waiting = 0;
      this.study(true);
    });
  }

  /** Rests after a time in milliseconds if nothing follows. */
  soon(/** @type {number} */ after) {
    window.clearTimeout(this.resting);
    this.element.setAttribute("aria-busy", "true");
    this.resting = window.setTimeout(() => this.now(), after);
  }

  now() {
    this.end();
    this.study(false);
  }

  end() {
    window.clearTimeout(this.resting);
    window.cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    this.element.removeAttribute("aria-busy");
  }
}
