// Moves a linkage along its circuit: by time, slider, keys or dragging.

import { clampPart, partOfInput, placeAtPart, stepPlace, turningParts } from "./timeline.js";

// A shorter range, in degrees, takes as long as this one, so that it is not played too fast.
const SHORTEST_RANGE = 150;

/** A position on the timeline of the study of a plate, `part` and `place`. */
export class Drive {
  /** @type {Place} */ place = { pass: 0, input: 0, isBeyond: false };
  part = 0;
  heading = 1;
  /** @type {Timeline} */ timeline;
  isLength = false;
  /** While there is nothing to move. */ isHalted = true;
  /** The request of the next frame while it plays, otherwise 0. */ frame = 0;

  constructor(/** @type {Plate} */ plate) {
    this.plate = plate;
  }

  /** Sets the study; keeps the input, or the nearest one possible. @param {Study} _ */
  setStudy({ timeline, is_length: isLength }) {
    const isFirst = this.timeline === undefined;
    const sides = isFirst ? "" : String(this.pass.sides);
    this.timeline = timeline;
    this.isLength = isLength;
    this.isHalted = false;
    if (isFirst) {
      this.begin();
      return;
    }
    // On the branch that it was on, if there is one with the input.
    const { pass, input } = this.place;
    const has = (/** @type {Pass} */ { from, to }) => (input - from) * (input - to) <= 0;
    const same = timeline.passes.findIndex((one) => String(one.sides) === sides && has(one));
    const isSame = String(timeline.passes[pass]?.sides) === sides;
    this.#put({ pass: isSame || same < 0 ? pass : same, input });
    this.part = partOfInput(timeline, this.place.pass, this.place.input);
  }

  // Sets the place to an input of a pass, or to the nearest that there is.
  #put(/** @type {Place} */ { pass, input }) {
    const { passes } = this.timeline;
    this.place.pass = Math.min(pass, passes.length - 1);
    const { from, to } = passes[this.place.pass];
    this.place.input = Math.min(Math.max(input, Math.min(from, to)), Math.max(from, to));
  }

  /** Moves to the initial position of a plate, where links seldom overlap. */
  begin() {
    this.part = this.timeline.closed ? 0.13 : 0.3;
    placeAtPart(this.timeline, this.part, this.place);
  }

  /** The current pass. */
  get pass() {
    return this.timeline.passes[this.place.pass];
  }

  get isPlaying() {
    return this.frame !== 0;
  }

  /** Plays or pauses. */
  toggle(isPlaying = !this.isPlaying) {
    window.cancelAnimationFrame(this.frame);
    this.frame = 0;
    if (isPlaying && !this.isHalted) this.#playOn(performance.now());
    this.plate.transport.playing(this.isPlaying);
  }

  // A late frame, for example after a switch of tabs, counts as a twentieth of a second.
  #playOn(/** @type {number} */ before) {
    this.frame = window.requestAnimationFrame((now) => {
      this.#playOn(now);
      if (now > before) this.#advance(Math.min((now - before) / 1000, 0.05));
    });
  }

  /** Reports a change of `place`. */
  move() {
    this.part = partOfInput(this.timeline, this.place.pass, this.place.input);
    this.plate.draw();
  }

  /** Moves to a part of the timeline. */
  seek(/** @type {number} */ part) {
    this.part = part;
    placeAtPart(this.timeline, part, this.place);
    this.plate.draw();
  }

  /** Moves to an input of a pass, or to the nearest that there is. @param {Place} place */
  moveTo(place) {
    if (this.isHalted) return;
    this.#put(place);
    this.move();
  }

  /** Moves to an input, on this pass if it has it, or to the nearest that there is. */
  moveToInput(/** @type {number} */ input) {
    const beyond = (/** @type {Pass} */ { from, to }) =>
      Math.max(Math.min(from, to) - input, input - Math.max(from, to), 0);
    const all = this.timeline.passes.map(beyond);
    const own = all[this.place.pass];
    const least = Math.min(...all);
    this.moveTo({ pass: own === least ? this.place.pass : all.indexOf(least), input });
  }

  /** Pauses and moves to a part of the timeline. */
  seekAndPause(/** @type {number} */ part) {
    if (this.isHalted) return;
    this.toggle(false);
    this.seek(part);
    this.plate.moved();
  }

  /** Steps by degrees, or by 1/200 of a stroke, along the timeline, and over limits. */
  step(/** @type {number} */ direction, times = 1) {
    if (this.isHalted) return;
    this.toggle(false);
    const by = direction * times * (this.isLength ? this.timeline.whole / 200 : 1);
    stepPlace(this.timeline, this.place, by);
    this.move();
    this.plate.moved();
  }

  /** Moves to the next limit position, or, for a full rotation, to its start. */
  toLimit(/** @type {number} */ direction) {
    if (this.isHalted) return;
    this.toggle(false);
    const { closed } = this.timeline;
    const parts = turningParts(this.timeline);
    const stops = parts.length ? parts : [0];
    const all = closed ? [-1, 0, 1].flatMap((turn) => stops.map((part) => part + turn)) : stops;
    const ahead = all.filter((part) => direction * (part - this.part) > 1e-9);
    if (ahead.length === 0) return;
    const next = direction > 0 ? Math.min(...ahead) : Math.max(...ahead);
    this.seek(closed ? next - Math.floor(next) : next);
    this.plate.moved();
  }

  #advance(/** @type {number} */ seconds) {
    if (this.isHalted) return;
    const { closed, whole } = this.timeline;
    const rate = Number(this.plate.transport.rate.value);
    // A stroke takes as long as a rotation.
    const range = this.isLength ? 360 : Math.max(whole, SHORTEST_RANGE);
    let part = this.part + (this.heading * seconds * rate) / range;
    if (!closed && (part > 1 || part < 0)) {
      this.heading = part > 1 ? -1 : 1;
      part = part > 1 ? 2 - part : -part;
    }
    this.seek(clampPart(this.timeline, part));
  }
}
