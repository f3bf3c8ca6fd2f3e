// The parameters of a linkage, each with a slider and a number field.

import { buttonOf, fill, h, isShortcut } from "../dom.js";
import { stepsOfKey } from "../keys.js";
import { ANGLE_UNITS } from "../../data/number.js";
import { NumberField } from "../number-field.js";
import { roundedToGrain } from "./parameters.js";

/** @type {Record<string, string>} */
const PARAMETER_KINDS = {
  free: "free",
  fixed: "constant",
  derived: "derived from other parameters",
  unlinked: "unlinked",
};

/**
 * The controls of parameters (parameters.js), below `legend`, which explains their letters. `on` has change(name, value), clear(name),
 * settle() at the end of a drag, and reset(). `show(parameters)` updates the values; rows are reused while the names are the same.
 */
export class Sliders {
  constructor(/** @type {string | null} */ legend, /** @type {Plate} */ on) {
    this.on = on;
    /** @type {Map<string, SliderRow>} */ this.rows = new Map();
    /** @type {string | null} */ this.names = null;
    this.free = h("div.parameters");
    this.locked = h("div.parameters");
    this.more = h("details.locked-parameters", h("summary", "Constant and derived parameters"), this.locked);
    this.reset = buttonOf("Reset all", () => on.reset(), { class: "reset" });
    const words = [h("h3", "Parameters"), legend ? h("p.note", legend) : null];
    this.element = h("section.gauge.sliders", words, this.free, this.more, this.reset);
  }

  show(/** @type {Parameter[]} */ parameters) {
    const names = parameters.map(({ name }) => name).join(" ");
    if (names !== this.names) this.#build(parameters);
    this.names = names;
    for (const parameter of parameters) this.#refresh(parameter);
    this.reset.disabled = !parameters.some((parameter) => isChangedParameter(parameter));
  }

  /** The values by their names. @returns {Map<string, number>} */
  values() {
    return new Map(Array.from(this.rows, ([name, { parameter }]) => [name, parameter.value]));
  }

  /** Marks the values that handles leave as they are. @param {Set<string>} locked */
  showLocked(locked) {
    for (const [name, { name: button }] of this.rows)
      button.setAttribute("aria-pressed", String(locked.has(name)));
  }

  /** Updates a row and marks a value that is out of bounds. @param {Parameter} parameter */
  #refresh(parameter) {
    const row = this.rows.get(parameter.name);
    if (!row) return;
    const { value, recorded, kind, low, high, unit } = parameter;
    row.parameter = parameter;
    row.element.className = `parameter ${kind}${isChangedParameter(parameter) ? " changed" : ""}`;
    // A typed value may exceed the slider's range.
    row.range.min = String(Math.min(low, value));
    row.range.max = String(Math.max(high, value));
    if (Number(row.range.value) !== value) row.range.value = String(value);
    row.range.disabled = kind === "derived";
    const text = formatWithUnit(value, unit);
    row.range.setAttribute("aria-valuetext", text);
    // What is being typed stays; a derived value cannot be typed, and follows also where it has the focus.
    row.field.readOnly = kind === "derived";
    row.number.show(value, text);
    row.number.mark(outOfBounds(parameter));
    const isDependent = kind === "derived" || kind === "unlinked";
    const label = kind === "derived" ? "Unlink" : kind === "unlinked" ? "Relink" : "Reset";
    row.button.textContent = label;
    const to = isDependent ? "" : ` to ${formatWithUnit(recorded, unit)}`;
    row.button.setAttribute("aria-label", `${label}: ${parameter.name}${to}`);
    row.button.disabled = !isDependent && !isChangedParameter(parameter);
    row.button.classList.toggle("unneeded", row.button.disabled);
  }

  #build(/** @type {Parameter[]} */ parameters) {
    this.rows.clear();
    /** @type {Element[][]} */ const [free, locked] = [[], []];
    for (const parameter of parameters)
      (parameter.kind === "free" ? free : locked).push(this.#row(parameter).element);
    fill(this.free, free);
    fill(this.locked, locked);
    this.more.hidden = locked.length === 0;
    this.showLocked(this.on.state.locked);
    this.more.open = parameters.length <= 6 || free.length === 0;
  }

  #row(/** @type {Parameter} */ parameter) {
    const { name } = parameter;
    const { on } = this;
    const row = /** @type {SliderRow} */ ({ parameter });
    row.range = h("input", {
      type: "range",
      step: "any",
      "aria-label": `${name}, ${PARAMETER_KINDS[parameter.kind]}`,
      oninput: () => on.change(name, roundedToGrain(Number(row.range.value), row.parameter.grain)),
      onchange: () => on.settle(),
      onkeydown: (event) => stepSlider(event, row, on),
    });
    row.number = new NumberField(
      { "aria-label": `Value of ${name}` },
      {
        units: ANGLE_UNITS[parameter.unit ?? ""],
        change: (value) => on.change(name, value),
        settle: () => on.settle(),
        step: (by) => stepParameter(row.parameter, by, on),
      },
    );
    row.field = row.number.element;
    row.button = buttonOf("", () => toggleLink(row.parameter, on), { class: "quiet tie" });
    const locks = () => on.lock(name, row.name.getAttribute("aria-pressed") !== "true");
    const title = "Lock: handles leave it as it is";
    row.name = buttonOf(name, locks, { class: "quiet parameter-name", title, "aria-label": `Lock ${name}` });
    row.element = h("div.parameter", row.name, row.range, row.field, row.button);
    row.field.addEventListener("focus", () => on.handles.mark(name));
    row.field.addEventListener("blur", () => on.handles.mark(null));
    this.rows.set(name, row);
    return row;
  }
}

// Why a value is beyond its bounds, of which 0 is exclusive; null if it is not.
function outOfBounds(/** @type {Parameter} */ { name, value, unit, min, max }) {
  if (min !== null && (value < min || (min === 0 && value === 0)))
    return `${name} is ${min === 0 ? "more than 0" : `at least ${formatWithUnit(min, unit)}`}`;
  return max !== null && value > max ? `${name} is at most ${formatWithUnit(max, unit)}` : null;
}

/** Steps of the slider by keys: one grain, with Shift ten. @param {KeyboardEvent} event @param {SliderRow} row */
function stepSlider(event, row, /** @type {Plate} */ on) {
  const steps = stepsOfKey(event, 20);
  if (!steps || isShortcut(event)) return;
  event.preventDefault();
  stepParameter(row.parameter, steps * (event.shiftKey ? 10 : 1), on);
}

/** @param {number} by */
function stepParameter(/** @type {Parameter} */ { name, value, grain }, by, /** @type {Plate} */ on) {
  on.change(name, roundedToGrain(value + by * grain, grain));
}

function toggleLink(/** @type {Parameter} */ { name, kind, value }, /** @type {Plate} */ on) {
  if (kind === "derived") on.change(name, value);
  else on.clear(name);
  on.settle();
}

function isChangedParameter(/** @type {Parameter} */ { kind, value, recorded }) {
  return kind === "unlinked" || (kind !== "derived" && value !== recorded);
}

/** A value of a parameter, as it may be typed. @param {number} value @param {AngleUnit | null} unit */
function formatWithUnit(value, unit) {
  const text = formatInputNumber(value);
  return text && unit ? `${text}${unit === "deg" ? "°" : " rad"}` : text;
}

/** A number as it is typed: up to ten significant digits. */
export function formatInputNumber(/** @type {number} */ value) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(10))) : "";
}
