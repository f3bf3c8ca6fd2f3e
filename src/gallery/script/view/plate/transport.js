// The playback controls: play and pause, speed, the slider over the circuit, steps, and limits.

import { ANGLE_UNITS } from "../../data/number.js";
import { buttonOf, h, isShortcut, selectOf } from "../dom.js";
import { stepsOfKey } from "../keys.js";
import { formatDecimals } from "../labels.js";
import { NumberField } from "../number-field.js";

/** Playback rates, in degrees of input per second, and their labels. */
const PLAY_RATES = { 15: "¼", 30: "½", 60: "1", 120: "2", 240: "4" };

/**
 * The controls below the stage of a plate, for its drive and the stage's view. `show(study, title)`, `update(part, input)`
 * and `playing(isPlaying)` update them.
 */
export class Transport {
  constructor(/** @type {Plate} */ plate) {
    const { drive, stage, family } = plate;
    this.play = buttonOf("", () => plate.play(), { class: "play", "aria-keyshortcuts": "Space" });
    this.scrub = h("input.scrub", {
      type: "range",
      min: "0",
      max: "1",
      step: "any",
      value: "0",
      "aria-label": "Position on the circuit",
      oninput: ({ target }) => drive.seekAndPause(Number(target.value)),
      onkeydown: (event) => stepByKey(event, drive),
    });
    const type = (/** @type {number} */ input) => {
      drive.toggle(false);
      drive.moveToInput(input);
    };
    const units = family.is_length ? {} : ANGLE_UNITS.deg;
    this.input = new NumberField(
      { class: "input-now", "aria-label": "Input" },
      { units, change: type, settle: () => plate.moved(), step: (by) => drive.step(1, by) },
    );
    this.ends = h("p.note.ends");
    this.straight = h("p.note.straight-note");
    const rates = Object.entries(PLAY_RATES).map(([rate, label]) => [rate, `${label} ×`]);
    this.rate = selectOf({ class: "rate", "aria-label": "Playback speed" }, rates, "60");
    /** @param {string} label @param {string} title @param {() => void} onclick @param {string} keys */
    const button = (label, title, onclick, keys) =>
      buttonOf(label, onclick, { class: "step", title, "aria-label": title, "aria-keyshortcuts": keys });
    this.toLimits = [
      button("⇤", "Previous limit or start", () => drive.toLimit(-1), "Home"),
      button("⇥", "Next limit or end", () => drive.toLimit(1), "End"),
    ];
    const zooms = [
      button("−", "Zoom out", () => stage.zoom(1 / 1.3), "-"),
      button("+", "Zoom in", () => stage.zoom(1.3), "+"),
      button("Fit", "Fit to frame", () => stage.fit(), "0"),
    ];
    const notes = h("div.motion-notes", this.ends, this.straight);
    this.element = h(
      "div.transport",
      { role: "group", "aria-label": "Motion" },
      h("div.drive", this.play, this.toLimits[0], this.scrub, this.toLimits[1], this.input.element),
      h("div.toolbar", notes, h("span.end.zooms", this.rate, zooms)),
    );
    this.announced = 0;
    this.playing(false);
  }

  show(/** @type {Study} */ { is_length: isLength, timeline, shortfall }, /** @type {string} */ title) {
    this.isLength = isLength;
    this.timeline = timeline;
    this.ends.textContent = shortfall ? `Input: ${title}; ${shortfall}` : `Input: ${title}`;
    this.enable(true);
  }

  /** Shows the description of the straight portion; null while it is unknown. */
  showStraight(/** @type {string | null} */ words) {
    this.straight.classList.toggle("stale", words === null);
    if (words !== null) this.straight.textContent = words;
  }

  /** Enables or disables the controls. */
  enable(/** @type {boolean} */ isThere) {
    for (const control of [this.play, this.scrub, ...this.toLimits]) control.disabled = !isThere;
  }

  playing(/** @type {boolean} */ isPlaying) {
    this.isPlaying = isPlaying;
    this.play.textContent = isPlaying ? "Pause" : "Play";
    this.play.setAttribute("aria-pressed", String(isPlaying));
    if (!isPlaying) this.announced = 0;
  }

  update(/** @type {number} */ part, /** @type {number} */ input) {
    const text = this.isLength ? formatDecimals(input, 4) : `${formatDecimals(input, 1)}°`;
    this.input.show(input, text);
    if (document.activeElement !== this.scrub || this.isPlaying || Number(this.scrub.value) !== part)
      this.scrub.value = String(part);
    // Limits announcements to screen readers to two per second.
    const time = performance.now();
    if (this.isPlaying && time - this.announced < 500) return;
    this.announced = time;
    this.scrub.setAttribute("aria-valuetext", `input ${text}`);
  }
}

/** Arrow keys step by a degree, or a fraction of a stroke, with Shift by ten; Home and End move to limits. */
export function stepByKey(/** @type {KeyboardEvent} */ event, /** @type {Drive} */ drive) {
  const steps = stepsOfKey(event, 10);
  const limit = { Home: -1, End: 1 }[event.key];
  if (isShortcut(event) || !(steps || limit)) return false;
  if (steps) drive.step(Math.sign(steps), Math.abs(steps) * (event.shiftKey ? 10 : 1));
  else if (limit) drive.toLimit(limit);
  event.preventDefault();
  return true;
}
