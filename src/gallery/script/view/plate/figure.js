// The figure of a plate: what is drawn of a study, and how it moves.

import { KernelFailure } from "../../kernel/instance.js";
import { DialView } from "./dial-view.js";
import { Drive } from "./drive.js";
import { Overlays } from "./overlays.js";
import { pathsOfStudy, straightSummary, visibleStraightPortion } from "./paths.js";
import { MotionView } from "./motion-view.js";
import { Stage } from "./stage.js";
import { Pose, circuitTitle, velocityArrow } from "./study.js";
import { clampPart, partOfInput } from "./timeline.js";
import { Transport } from "./transport.js";

// Chord errors of a path relative to its size: rough while a slider is being moved, fine when it has rested.
const ROUGH_PATH = 3e-4;
const FINE_PATH = 2e-5;
// The arrow of the velocity is of a radian of the input, or of this part of a stroke.
const STROKE_PART = 1 / (2 * Math.PI);

/** What is shown of the motion, unless the address says otherwise. @type {MotionState} */
export const STILL = { joint: null, graph: "speed", rpm: null, load: null };

/** The drawing of the linkage of a curve, with its playback controls and its readings. */
export class PlateFigure {
  /** What is drawn; the last that exists. @type {Study | null} */ study = null;
  /** Why what was asked for cannot be drawn. @type {string | null} */ reason = null;
  /** What its address says. @type {PlateState} */ state;
  /** The measures, if they are not those of the atlas. @type {Measured | null} */ measured = null;
  /** @type {StraightPortion | null} */ portion = null;
  /** @type {CurvePath} */ path;
  pose = new Pose();
  stage = new Stage();

  constructor(/** @type {Family} */ family, /** @type {number} */ curve) {
    this.family = family;
    this.curve = curve;
    // What is not of the figure is of the plate, of which every figure is.
    const plate = /** @type {Plate} */ (/** @type {unknown} */ (this));
    this.drive = new Drive(plate);
    this.transport = new Transport(plate);
    this.overlays = new Overlays(this.stage);
    this.dial = new DialView();
    this.motion = new MotionView(plate);
    this.stage.onview = () => this.draw();
  }

  /** Changed values by their names. */
  get changes() {
    return this.state.changes;
  }

  /** The names of the overlays that are on. */
  get on() {
    return this.state.on;
  }

  /** Whether the atlas contains what is shown. */
  get isRecorded() {
    return this.changes.size === 0 && this.study !== null && this.study.shown === this.study.home;
  }

  /** Draws another study. */
  show(/** @type {Study} */ study, /** @type {boolean} */ isRough) {
    const { drive } = this;
    this.path = study.kernel.path((isRough ? ROUGH_PATH : FINE_PATH) * study.size);
    drive.setStudy(study);
    this.#markStraight(study, isRough);
    this.stage.show(study, this.pathsOf(study, isRough));
    this.overlays.show(study, this.on, isRough);
    this.transport.show(study, circuitTitle(study.is_length, study.circuits[study.shown]));
    this.dial.show(study);
    this.showMotion(isRough);
    this.stage.keepInFrame();
    this.draw();
  }

  /** Shows the motion of the joint that is chosen, with the straight portion of the curve. */
  showMotion(isRough = false) {
    const { study, portion } = this;
    if (!study) return;
    const { timeline } = study;
    const partOf = (/** @type {Place} */ at) => clampPart(timeline, partOfInput(timeline, at.pass, at.input));
    this.motion.show(study, isRough, portion && [partOf(portion.from), partOf(portion.to)]);
    this.motion.update(this.drive.part, this.drive.place);
  }

  // The measures of the atlas, or computed ones if something is changed.
  #markStraight(/** @type {Study} */ study, /** @type {boolean} */ isRough) {
    const { family, curve, isRecorded } = this;
    const found = isRough ? null : study.kernel.measures();
    this.measured = isRecorded ? null : (found?.values ?? null);
    this.portion = found && visibleStraightPortion(study, found);
    const isKnown = isRecorded || found;
    this.transport.showStraight(isKnown ? straightSummary(study, family, curve, this.measured) : null);
  }

  pathsOf(/** @type {Study} */ study, /** @type {boolean} */ isRough) {
    return pathsOfStudy(study, this.path, this.portion, { on: this.on, isRough });
  }

  /** Draws the linkage at the place of the drive. */
  draw() {
    const { study, drive, pose, stage } = this;
    if (!study) return;
    const { pass, part, place } = drive;
    if (!this.guarded(() => pose.move(study, place.pass, place.input))) return;
    stage.pose(pose.joints);
    this.overlays.pose(pose.joints, stage.view, pose.instant);
    this.dial.pose(pose.transmission);
    this.transport.update(part, place.input);
    this.motion.update(part, place);
    const by = Math.sign(pass.to - pass.from) * (study.is_length ? STROKE_PART * study.timeline.whole : 1);
    const frame = { by, scale: stage.view.scale, size: stage.size };
    stage.moving.speed(this.on.has("velocity") ? velocityArrow(pose.velocity, frame) : null);
  }

  /** Shows the overlays that are on, and not those that were only `before`. */
  showOverlays(/** @type {Set<string>} */ before) {
    const { study, stage, on } = this;
    if (!study) return;
    const { box } = stage;
    if (on.has("others") !== before.has("others")) stage.show(study, this.pathsOf(study, false));
    this.overlays.show(study, on, false);
    if (box !== stage.box && !stage.isZoomed) stage.fit();
    this.draw();
  }

  /** Begins on another circuit. */
  beginCircuit() {
    this.drive.begin();
    if (!this.stage.isZoomed) this.stage.fit();
    this.draw();
  }

  // Runs `work`; whether it succeeded. If the kernel fails, the linkage stands still until something is changed.
  guarded(/** @type {() => void} */ work) {
    try {
      work();
      return true;
    } catch (error) {
      if (!(error instanceof KernelFailure)) throw error;
      this.reason = error.message;
      this.stage.impossible(this.reason, "Stopped");
      this.drive.toggle(false);
      this.drive.isHalted = true;
      this.transport.enable(false);
      return false;
    }
  }
}
