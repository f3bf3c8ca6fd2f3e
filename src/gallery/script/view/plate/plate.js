// A plate: the state of the linkage of a curve, and the response to input.

import { clampPart, partOfInput } from "./timeline.js";
import { DialView } from "./dial-view.js";
import { Drive } from "./drive.js";
import { MeasureTable } from "./facts.js";
import { enableDragging } from "./dragging.js";
import { PlateKeys } from "./keys.js";
import { plateLayout } from "./layout.js";
import { measuresOfStudy } from "./study-measures.js";
import { Overlays } from "./overlays.js";
import { changeableParameters } from "./parameters.js";
import { pathsOfStudy, visibleStraightPortion, straightSummary } from "./paths.js";
import { plateCurveName, isExtraCircuit, plateAddress, readPlateQuery } from "./plate-query.js";
import { PoseSolver } from "./pose-solver.js";
import { Sliders } from "./sliders.js";
import { SpeedView } from "./speed-view.js";
import { Stage } from "./stage.js";
import { pathOfStudy, circuitTitle, studyOf } from "./study.js";
import { summaryOfStudy } from "./summary.js";
import { Switches } from "./switches.js";
import { Transport } from "./transport.js";
import { PointVelocity, velocityArrow } from "./velocity.js";

// Chord errors of a path relative to its size: rough while a slider is being moved, fine when it has rested
// for REST_MILLISECONDS.
const ROUGH_PATH = 3e-4;
const FINE_PATH = 2e-5;
const REST_MILLISECONDS = 160;

/**
 * The plate of a curve of a family, with the query of its address. Put `element` into the document, then call
 * `shown()`.
 */
export class Plate {
  constructor(app, family, curve, query) {
    Object.assign(this, { app, family, curve, study: null, pose: null });
    this.trace = family.curves.trace[curve];
    this.#createControls();
    this.layout = plateLayout(this);
    this.element = this.layout.element;
    this.release = enableDragging(this.stage, this);
    Object.assign(this, readPlateQuery(family, this.trace, query));
    this.#restudy(false);
    if (!this.study) this.#showRecorded();
    this.#settle();
  }

  #createControls() {
    const { app, family, curve } = this;
    this.drive = new Drive({
      moved: () => this.#draw(),
      playing: (isPlaying) => this.transport.playing(isPlaying),
      rate: () => this.transport.speed,
    });
    this.stage = new Stage();
    this.stage.onview = () => this.#draw();
    this.overlays = new Overlays(this.stage);
    this.transport = new Transport(this.drive, this.stage);
    this.dial = new DialView();
    this.speed = new SpeedView((part) => this.drive.seekAndPause(part));
    this.sliders = new Sliders(family.legend, {
      change: (name, value) => this.#change(() => this.changes.set(name, value)),
      clear: (name) => this.#change(() => this.changes.delete(name)),
      settle: () => this.#settleSoon(0),
      reset: () => this.#reset(),
    });
    this.switches = new Switches({
      overlay: (name, isOn) => this.#switch(name, isOn),
      circuit: (k) => this.#chooseCircuit(k),
    });
    const isLength = family.template.joints.some((joint) => joint.piston);
    this.measures = new MeasureTable(app, family, curve, isLength);
    this.keys = new PlateKeys(this);
  }

  /**
   * Called when the element is in the document: measures the frame, and starts the motion unless reduced
   * motion is preferred.
   */
  shown() {
    this.stage.observe();
    this.stage.fit();
    const isStill = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (!isStill) this.drive.toggle(true);
  }

  leave() {
    this.drive.toggle(false);
    this.stage.leave();
    this.keys.leave();
    this.release();
    this.layout.leave();
    window.clearTimeout(this.resting);
    window.cancelAnimationFrame(this.waiting);
  }

  /** Handles another query of the same curve's address. */
  setQuery(query) {
    Object.assign(this, readPlateQuery(this.family, this.trace, query));
    this.#restudy(false);
    this.#settle(false);
    return true;
  }

  /** The name of the curve, with its family and changes. */
  get name() {
    return plateCurveName(this);
  }

  /** Whether the atlas contains what is shown. */
  get isRecorded() {
    return this.changes.size === 0 && this.study !== null && this.study.shown === this.study.home;
  }

  // If the address cannot be assembled, the linkage of the atlas is shown behind the message.
  #showRecorded() {
    const { changes, requestedCircuit } = this;
    Object.assign(this, { changes: new Map(), requestedCircuit: null });
    this.#restudy(false);
    Object.assign(this, { changes, requestedCircuit });
    this.#restudy(false);
  }

  // Creates the study of the current changes; if it cannot be assembled, the previous one stays visible.
  #restudy(isRough) {
    const { family, curve, changes } = this;
    const study = studyOf(family, curve, changes, this.requestedCircuit, isRough);
    this.sliders.show(changeableParameters(family, family.curves.cell[curve], this.trace, changes));
    this.reason = study.reason ?? null;
    this.candidates = study.routes ? study : null;
    this.stage.impossible(this.reason);
    this.element.classList.toggle("impossible", this.reason !== null);
    if (this.reason) {
      this.drive.isHalted = true;
      this.transport.stop();
      return;
    }
    this.study = study;
    this.poser = new PoseSolver(study.linkage);
    this.velocity = new PointVelocity(study);
    this.path = pathOfStudy(study, isRough ? ROUGH_PATH : FINE_PATH);
    this.drive.setStudy(study);
    this.#show(isRough);
  }

  #show(isRough) {
    const { study, path, drive } = this;
    this.#markStraight(isRough);
    this.stage.show(study, this.#paths(isRough));
    this.overlays.show(study, this.on, isRough);
    this.transport.show(study, circuitTitle(study.linkage, study.routes[study.shown]));
    this.dial.show(study);
    const partOf = ({ pass, input }) => clampPart(drive.timeline, partOfInput(drive.timeline, pass, input));
    this.speed.show(study, path, this.portion && [partOf(this.portion.from), partOf(this.portion.to)]);
    this.stage.keepInFrame();
    this.#draw();
  }

  // The straight portion from the measures of the atlas, or from computed ones if something is changed.
  #markStraight(isRough) {
    const { study, family, curve } = this;
    this.measured = this.isRecorded || isRough ? null : measuresOfStudy(family, study);
    const isKnown = this.isRecorded || !isRough;
    this.portion = isKnown ? visibleStraightPortion(study, family, curve, this.measured) : null;
    this.transport.showStraight(isKnown ? straightSummary(study, family, curve, this.measured) : null);
  }

  #paths(isRough) {
    return pathsOfStudy(this.family, this.study, this.path, this.portion, { on: this.on, isRough });
  }

  #change(make) {
    make();
    this.#settleSoon(REST_MILLISECONDS);
    // At most one study per frame.
    this.waiting ||= window.requestAnimationFrame(() => {
      this.waiting = 0;
      this.#restudy(true);
    });
  }

  #settleSoon(after) {
    window.clearTimeout(this.resting);
    this.resting = window.setTimeout(() => {
      window.cancelAnimationFrame(this.waiting);
      this.waiting = 0;
      this.#restudy(false);
      this.#settle();
    }, after);
  }

  // Updates the measures, the address and the texts after a change.
  #settle(isAddressed = true) {
    const { family, curve, study } = this;
    this.measures.show(this.reason ? null : this.measured);
    this.switches.show(this.candidates, study, this.on, isExtraCircuit(this));
    this.layout.refresh();
    if (this.reason) this.app.announce(`Cannot be assembled: ${this.reason}`);
    this.stage.summary.textContent = study ? summaryOfStudy(family, curve, study, this.isRecorded) : "";
    if (isAddressed && this.element.isConnected) this.app.replace(plateAddress(this));
  }

  #reset() {
    this.changes.clear();
    this.requestedCircuit = null;
    this.#restudy(false);
    this.stage.fit();
    this.#settle();
  }

  #switch(name, isOn) {
    if (isOn) this.on.add(name);
    else this.on.delete(name);
    const before = this.stage.box;
    if (name === "others") this.stage.show(this.study, this.#paths(false));
    this.overlays.show(this.study, this.on, false);
    if (before !== this.stage.box && !this.stage.isZoomed) this.stage.fit();
    this.switches.show(this.candidates, this.study, this.on, isExtraCircuit(this));
    this.#draw();
    this.app.replace(plateAddress(this));
  }

  #chooseCircuit(k) {
    this.requestedCircuit = k;
    this.#restudy(false);
    if (!this.reason) {
      this.drive.begin();
      if (!this.stage.isZoomed) this.stage.fit();
      this.#draw();
    }
    this.#settle();
  }

  #draw() {
    const { study, poser, stage, drive } = this;
    if (!study) return;
    const {
      pass,
      part,
      place: { input },
    } = drive;
    this.pose = poser.solve(pass, input);
    stage.pose(this.pose);
    this.overlays.pose(this.pose, stage.view, pass, input);
    this.dial.pose(this.pose);
    this.transport.update(part, input);
    const velocity = this.velocity.at(pass, input);
    this.speed.update(part, Math.hypot(...velocity));
    const frame = { top: this.speed.top, size: stage.size, heading: Math.sign(pass.to - pass.from) };
    stage.moving.speed(this.on.has("velocity") ? velocityArrow(velocity, frame) : null);
  }
}
