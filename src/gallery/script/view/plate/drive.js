// Moves a linkage along its circuit: by time, slider, keys or dragging.

import { clampPart, partOfInput, placeAtPart, turningParts } from "./timeline.js";
import { Player } from "./player.js";

// A shorter range, in degrees, takes as long as this one, so that it is not played too fast.
const SHORTEST_RANGE = 150;

/**
 * A position on the timeline of a study: `part`, and `place` { pass, input }. `on` has moved(),
 * playing(isPlaying), and rate(), in degrees of input per second. `isHalted` while there is nothing to move.
 */
export class Drive {
  constructor(on) {
    this.on = on;
    this.place = { pass: 0, input: 0, isBeyond: false };
    this.part = 0;
    this.heading = 1;
    this.timeline = null;
    this.isHalted = true;
    this.player = new Player((seconds) => this.#advance(seconds));
  }

  /** Sets the study; keeps the input, or the nearest one possible. */
  setStudy({ timeline, linkage }) {
    const isFirst = this.timeline === null;
    this.timeline = timeline;
    this.isLength = linkage.input.isLength;
    this.isHalted = false;
    if (isFirst) {
      this.begin();
      return;
    }
    const { passes } = timeline;
    this.place.pass = Math.min(this.place.pass, passes.length - 1);
    const { from, to } = passes[this.place.pass];
    this.place.input = Math.min(Math.max(this.place.input, Math.min(from, to)), Math.max(from, to));
    this.part = partOfInput(timeline, this.place.pass, this.place.input);
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

  /** Plays or pauses. */
  toggle(isPlaying = !this.player.isPlaying) {
    if (isPlaying && !this.isHalted) this.player.play();
    else this.player.pause();
    this.on.playing(this.player.isPlaying);
  }

  /** Pauses for input by the user. */
  pause() {
    this.toggle(false);
  }

  /** Reports a change of `place`. */
  move() {
    this.part = partOfInput(this.timeline, this.place.pass, this.place.input);
    this.on.moved();
  }

  /** Moves to a part of the timeline. */
  seek(part) {
    this.part = part;
    placeAtPart(this.timeline, part, this.place);
    this.on.moved();
  }

  /** Pauses and moves to a part of the timeline. */
  seekAndPause(part) {
    if (this.isHalted) return;
    this.pause();
    this.seek(part);
  }

  /** Steps by degrees, or by 1/200 of a stroke, along the timeline, and over limits. */
  step(direction, times = 1) {
    if (this.isHalted) return;
    this.pause();
    const by = direction * times * (this.isLength ? this.timeline.whole / 200 : 1);
    const { from, to } = this.pass;
    const next = this.place.input + Math.sign(to - from) * by;
    const isInside = (next - from) * (next - to) <= 0;
    if (isInside) {
      this.place.input = next;
      this.move();
      return;
    }
    // A step over a limit continues beyond it.
    this.seek(clampPart(this.timeline, this.part + by / this.timeline.whole));
  }

  /** Moves to the next limit position, or, for a full rotation, to its start. */
  toLimit(direction) {
    if (this.isHalted) return;
    this.pause();
    const { closed } = this.timeline;
    const parts = turningParts(this.timeline);
    const stops = parts.length ? parts : [0];
    const all = closed ? [-1, 0, 1].flatMap((turn) => stops.map((part) => part + turn)) : stops;
    const ahead = all.filter((part) => direction * (part - this.part) > 1e-9);
    if (ahead.length === 0) return;
    const next = direction > 0 ? Math.min(...ahead) : Math.max(...ahead);
    this.seek(closed ? next - Math.floor(next) : next);
  }

  #advance(seconds) {
    if (this.isHalted) return;
    const { closed, whole } = this.timeline;
    const rate = this.on.rate();
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
