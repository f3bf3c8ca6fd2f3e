// How a joint moves, and the input torque against a load: numbers at the input, and a graph over the circuit.

import { KernelError } from "../../kernel/instance.js";
import { buttonOf, fill, h, selectOf, termList } from "../dom.js";
import { saveFile } from "../export/files.js";
import { formatDecimals, formatLength } from "../labels.js";
import { NumberField } from "../number-field.js";
import { MotionGraph } from "./motion-graph.js";
import { partOfInput } from "./timeline.js";

// The number of places of a graph, and while a slider is being moved.
const GRAPH_PLACES = 400;
const ROUGH_PLACES = 100;
// While the linkage moves, its numbers are read as often as this, in milliseconds.
const READ_MILLISECONDS = 150;

const radiansPerSecond = (/** @type {number} */ rpm) => (rpm * Math.PI) / 30;

const sizeAt = (/** @type {Points} */ of, /** @type {number} */ k) => Math.hypot(of[2 * k], of[2 * k + 1]);

/**
 * What a graph shows of a motion at a place, and by which power of the input's speed it is multiplied.
 * @type {Record<string, { label: string, power: number, of: (motion: JointMotion, k: number) => number }>}
 */
export const QUANTITIES = {
  speed: { label: "Speed", power: 1, of: ({ velocities }, k) => sizeAt(velocities, k) },
  acceleration: { label: "Acceleration", power: 2, of: ({ accelerations }, k) => sizeAt(accelerations, k) },
  x: { label: "Position x", power: 0, of: ({ positions }, k) => positions[2 * k] },
  y: { label: "Position y", power: 0, of: ({ positions }, k) => positions[2 * k + 1] },
  mu: { label: "Transmission angle", power: 0, of: ({ transmission_angles: of }, k) => of?.[k] ?? NaN },
  advantage: { label: "Mechanical advantage", power: 0, of: (of, k) => 1 / QUANTITIES.speed.of(of, k) },
  torque: { label: "Input torque", power: 0, of: ({ torques }, k) => torques?.[k] ?? NaN },
};

/** The view of a plate's motion: `show(study, isRough, portion)`, then `update(part, place)`. */
export class MotionView {
  /** @type {JointMotion | null} */ motion = null;
  /** @type {Study | null} */ study = null;
  read = 0;

  constructor(/** @type {Plate} */ plate) {
    this.plate = plate;
    const change = (/** @type {Partial<MotionState>} */ changes) => plate.changeMotion(changes);
    this.joints = h("select", {
      "aria-label": "Joint",
      onchange: ({ target }) => change({ joint: target.value }),
    });
    const labels = Object.entries(QUANTITIES).map(([name, { label }]) => [name, label]);
    const quantity = selectOf({ "aria-label": "Graph" }, labels, "speed");
    quantity.onchange = () => change({ graph: quantity.value });
    this.quantity = quantity;
    this.rpm = new NumberField(
      { "aria-label": "Speed of the input, rpm", size: 6, placeholder: "per radian" },
      { units: { rpm: 1 }, change: (rpm) => change({ rpm }), empty: () => change({ rpm: null }) },
    );
    const example = { type: "text", placeholder: "100 on C at -90 deg" };
    const load = h("input", { "aria-label": "Load", ...example });
    load.onchange = () => change({ load: load.value.trim() || null });
    this.load = load;
    this.graph = new MotionGraph((part) => plate.drive.seekAndPause(part));
    this.value = h("span");
    this.foot = h("p.note");
    this.numbers = h("div.motion-numbers");
    const label = (/** @type {string} */ words, /** @type {Element} */ field) =>
      h("label.field.row", words, field);
    this.speedField = label("Input at", h("span", this.rpm.element, " rpm"));
    const save = [buttonOf("CSV", () => this.#save("csv")), buttonOf("SVG", () => this.#save("svg"))];
    this.element = h(
      "section.gauge.motion-gauge",
      h("h3", "Motion ", this.value),
      h("div.toolbar", this.quantity, h("span", "of"), this.joints, h("span.end", save)),
      this.graph.element,
      this.foot,
      this.numbers,
      h("div.toolbar", this.speedField, label("Load", this.load)),
    );
  }

  get #state() {
    return this.plate.state.motion;
  }

  get #quantity() {
    return QUANTITIES[this.#state.graph];
  }

  /** By what a rate of a power is multiplied. */
  #factor(power = this.#quantity.power) {
    const { rpm } = this.#state;
    return rpm === null || this.study?.is_length ? 1 : radiansPerSecond(rpm) ** power;
  }

  /** Shows a study; `portion` is the range of parts of the straight portion, or null. */
  show(/** @type {Study} */ study, /** @type {boolean} */ isRough, /** @type {number[] | null} */ portion) {
    this.study = study;
    const names = [...new Set(study.joints)];
    const { joint, graph, rpm, load } = this.#state;
    const shown = joint !== null && names.includes(joint) ? joint : study.joints[study.joint];
    const options = names.map((name) => h("option", { value: name, selected: name === shown }, name));
    fill(this.joints, options);
    this.joints.value = shown;
    this.joint = shown === study.joints[study.joint] ? study.joint : study.joints.indexOf(shown);
    this.quantity.value = graph;
    this.rpm.show(rpm ?? undefined);
    this.speedField.hidden = study.is_length;
    if (document.activeElement !== this.load) this.load.value = load ?? "";
    const motion = this.#ask({ count: isRough ? ROUGH_PLACES : GRAPH_PLACES, place: null });
    this.motion = motion;
    const { timeline } = study;
    const parts = Array.from(motion.inputs, (input, k) => partOfInput(timeline, motion.passes[k], input));
    const values = parts.map((_, k) => this.#factor() * this.#quantity.of(motion, k));
    this.graph.show(timeline, parts, values, portion);
    this.foot.textContent = this.#words(values, motion);
    this.graph.drawing.setAttribute(
      "aria-label",
      `${this.#quantity.label} over the circuit: ${this.foot.textContent}`,
    );
    this.read = 0;
  }

  /** Shows the numbers at a place. */
  update(/** @type {number} */ part, /** @type {Place} */ place) {
    // The stage may draw another study before it is shown here, and the place is one of that.
    if (!this.study || this.study !== this.plate.study) return;
    const now = performance.now();
    if (this.plate.drive.isPlaying && now - this.read < READ_MILLISECONDS) return;
    this.read = now;
    const at = this.#ask({ count: 0, place: { pass: place.pass, input: place.input } });
    const value = this.#factor() * this.#quantity.of(at, 0);
    this.value.textContent = Number.isFinite(value) ? formatLength(value) : "∞";
    this.graph.update(part, value);
    fill(this.numbers, termList("dl.facts", this.#terms(at)));
  }

  /** The numbers at a place, by their names. @returns {[string, string][]} */
  #terms(/** @type {JointMotion} */ { positions, velocities, accelerations, links, torques }) {
    const pair = (/** @type {Float64Array} */ [x, y], power = 0) => {
      const by = this.#factor(power);
      const size = power ? `, ${formatLength(by * Math.hypot(x, y))} in all` : "";
      return `${formatLength(by * x)}, ${formatLength(by * y)}${size}`;
    };
    const turning = links.map((link) => {
      const rate = formatDecimals(this.#factor(1) * link.velocities[0], 4);
      return `${link.joints.join("")} ${rate}`;
    });
    /** @type {[string, string][]} */ const terms = [
      ["Position", pair(positions)],
      ["Velocity", pair(velocities, 1)],
      ["Acceleration", pair(accelerations, 2)],
      ["Links turn at", turning.join(", ")],
    ];
    if (torques) terms.push(["Input torque", formatLength(torques[0])]);
    return terms;
  }

  /** A sentence on a graph: its range, and the greatest torque. */
  #words(/** @type {number[]} */ values, /** @type {JointMotion} */ { torque }) {
    const finite = values.filter(Number.isFinite);
    const { power } = this.#quantity;
    if (finite.length === 0)
      return this.#state.graph === "torque" ? "Give a load" : "It is not defined for this linkage";
    const [least, most] = [Math.min(...finite), Math.max(...finite)].map((value) => formatLength(value));
    const unit = this.study?.is_length
      ? "unit of input"
      : this.#state.rpm === null
        ? "radian of input"
        : "second";
    const rate = power ? `, in lengths per ${unit}${power === 2 ? " squared" : ""}` : "";
    const peak = torque && this.#state.graph === "torque" ? this.#peakWords(torque) : "";
    return `from ${least} to ${most}${rate}${peak}`;
  }

  #peakWords(/** @type {NonNullable<JointMotion["torque"]>} */ { peak, peak_input: at }) {
    if (typeof peak !== "number" || typeof at !== "number") return "; unbounded at a limit";
    return `; the greatest is ${formatLength(peak)}, at ${formatDecimals(at, 2)}${this.study?.is_length ? "" : "°"}`;
  }

  /** @param {{ count: number, place: Place | null }} of @returns {JointMotion} */
  #ask(of) {
    const { load } = this.#state;
    const study = /** @type {Study} */ (this.study).kernel;
    const joint = /** @type {number} */ (this.joint);
    try {
      const motion = study.motion({ joint, load, ...of });
      this.#mark("");
      return motion;
    } catch (error) {
      if (!(error instanceof KernelError) || load === null) throw error;
      this.#mark(error.message);
      return study.motion({ joint, load: null, ...of });
    }
  }

  #mark(/** @type {string} */ reason) {
    this.load.setAttribute("aria-invalid", String(reason !== ""));
    this.load.title = reason;
  }

  #save(/** @type {"csv" | "svg"} */ format) {
    const { motion, plate } = this;
    if (!motion) return;
    const joint = this.joints.value;
    const names = Object.keys(QUANTITIES);
    const rows = Array.from(motion.inputs, (input, k) =>
      [input, ...names.map((name) => QUANTITIES[name].of(motion, k) * this.#factor(QUANTITIES[name].power))]
        .map((value) => (Number.isFinite(value) ? value : ""))
        .join(","),
    );
    const csv = `${[["input", ...names].join(","), ...rows].join("\n")}\n`;
    const text =
      format === "csv" ? csv : this.graph.svg(`${this.#quantity.label} of ${joint}, ${plate.family.title}`);
    const name = `${plate.family.id}-${joint}-${this.#state.graph}.${format}`;
    const type = format === "csv" ? "text/csv" : "image/svg+xml";
    saveFile({ name, type, bytes: text });
  }
}
