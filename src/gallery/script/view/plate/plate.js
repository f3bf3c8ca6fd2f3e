// A plate: the state of the linkage of a curve, and the response to input.

import { enableDragging } from "./dragging.js";
import { MeasureTable } from "./facts.js";
import { PlateFigure } from "./figure.js";
import { Handles } from "./handles.js";
import { plateLayout, watchKeys } from "./layout.js";
import { changeableParameters, isRecordedValue } from "./parameters.js";
import { recordedPath } from "./paths.js";
import { ignoreUnused, plateAddress, readPlateQuery, withMember } from "./plate-query.js";
import { isExtraCircuit, plateCurveName } from "./plate-query.js";
import { Sliders } from "./sliders.js";
import { recordedValues, Resting, studyOf, summaryOfStudy } from "./study.js";
import { Switches } from "./switches.js";
import { Store } from "../store.js";

// The time in milliseconds after which the input has rested.
const INPUT_MILLISECONDS = 400;

/** The plate of a curve of a family, with the query of its address. Put `element` into the document, then call `shown()`. */
export class Plate extends PlateFigure {
  /** The circuits of what was asked for. @type {Candidates} */ candidates;
  listening = new AbortController();
  /** The path data of the curve of the atlas, once it is needed. @type {string | null} */ ghost = null;

  /** @param {App} app @param {Kernel} kernel @param {Family} family @param {number} curve @param {AddressQuery} query */
  constructor(app, kernel, family, curve, query) {
    super(family, curve);
    this.app = app;
    this.kernel = kernel;
    this.description = kernel.family(family).description;
    this.recorded = recordedValues(kernel, family, curve);
    this.current = this.recorded;
    this.sliders = new Sliders(family.legend, this);
    this.switches = new Switches(this);
    this.measures = new MeasureTable(app, family, curve);
    this.query = query;
    this.store = new Store(app, this.#stateOf(query), (state) => plateAddress(this, state));
    this.store.watch((state, before) => this.#stateChanged(state, before));
    this.handles = new Handles(this);
    this.resting = new Resting(this.stage.element, (isRough) => {
      this.#restudy(isRough);
      if (!isRough) this.#settle();
    });
    this.stage.moving.onpose = (at) => this.handles.pose(at);
    this.layout = plateLayout(this);
    this.element = this.layout.element;
    enableDragging(this.stage, this, this.listening.signal);
    watchKeys(this, this.listening.signal);
    this.#restudy(false);
    if (!this.study) this.#showRecorded();
    this.#settle();
  }

  /**
   * Called when the element is in the document: measures the frame, and starts the motion unless reduced
   * motion is preferred, or the address says the input.
   */
  shown() {
    this.stage.observe();
    this.stage.fit();
    const isStill = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.state.at) this.drive.moveTo(this.state.at);
    ignoreUnused(this.query, this);
    if (!this.state.at && !isStill) this.drive.toggle(true);
  }

  leave() {
    this.drive.toggle(false);
    this.store.leave();
    this.stage.leave();
    this.listening.abort();
    this.layout.leave();
    this.study?.kernel.close();
    this.resting.end();
  }

  /** Handles another query of the same curve's address. @param {AddressQuery} query */
  setQuery(query) {
    const { requestedCircuit } = this.state;
    this.query = query;
    this.store.show(this.#stateOf(query));
    this.resting.now();
    const { at } = this.state;
    if (at) {
      this.drive.toggle(false);
      this.drive.moveTo(at);
    } else if (this.state.requestedCircuit !== requestedCircuit && !this.reason) this.beginCircuit();
    ignoreUnused(this.query, this);
    return true;
  }

  /** The state of an address, without values that are those of the atlas. @param {AddressQuery} query */
  #stateOf(query) {
    const state = readPlateQuery(this.family, this.recorded.point, query);
    return { ...state, changes: this.#changesWith([], state.changes) };
  }

  /** Some changes with others; the values of the atlas are none. @param {Iterable<[string, number]>} more */
  #changesWith(/** @type {Iterable<[string, number]>} */ before, more) {
    const changes = new Map(before);
    for (const [name, value] of more) {
      if (isRecordedValue(this.description.names, this.recorded, name, value)) changes.delete(name);
      else changes.set(name, value);
    }
    return changes;
  }

  /** Shows what a gesture has changed. @param {PlateState} state @param {PlateState | null} before */
  #stateChanged(state, before) {
    this.state = state;
    if (before === null) return;
    if (state.changes !== before.changes) this.resting.changed();
    else if (state.requestedCircuit !== before.requestedCircuit) this.#circuitChosen();
    else if (state.on !== before.on) {
      this.showOverlays(before.on);
      this.switches.show(this.candidates, this.study, this.on, isExtraCircuit(this));
    } else if (state.motion !== before.motion) this.showMotion();
    if (state.locked !== before.locked) this.sliders.showLocked(state.locked);
  }

  /** The name of the curve, with its family and changes. */
  get name() {
    return plateCurveName(this);
  }

  // If the address cannot be assembled, the linkage of the atlas is shown behind the message.
  #showRecorded() {
    const { state } = this;
    this.state = { ...state, changes: new Map(), requestedCircuit: null };
    this.#restudy(false);
    this.state = state;
    this.#restudy(false);
  }

  // Creates the study of the current changes; if it cannot be assembled, the previous one stays visible.
  #restudy(/** @type {boolean} */ isRough) {
    const { family, kernel, changes, description, recorded } = this;
    const curve = kernel.curve(family, this.curve, changes);
    const study = studyOf(kernel, curve, this.state.requestedCircuit, isRough);
    if (study.values) this.current = { values: study.values, point: study.point ?? null };
    this.sliders.show(changeableParameters(family, description.names, recorded, this.current, changes));
    this.handles?.showValues(this.sliders.values());
    this.reason = study.reason;
    this.candidates = { ...study, is_length: family.is_length };
    this.stage.impossible(this.reason);
    this.element.classList.toggle("impossible", this.reason !== null);
    if (study.reason !== null) {
      this.drive.isHalted = true;
      this.transport.enable(false);
      return;
    }
    this.study?.kernel.close();
    this.study = study;
    this.guarded(() => {
      this.show(study, isRough);
      if (!isRough) this.handles.show(study);
    });
    if (this.changes.size) this.ghost ??= recordedPath(kernel, family, this.curve);
    this.stage.still.draw("ghost", this.changes.size ? (this.ghost ?? "") : "");
  }

  /** The study of a circuit as it is now, once more; close it. */
  studyAgain(/** @type {number} */ shown) {
    const { family, kernel, curve, changes } = this;
    return kernel.study(kernel.curve(family, curve, changes), { shown });
  }

  /** Changes a value; that of the atlas is no change. */
  change(/** @type {string} */ name, /** @type {number} */ value) {
    this.changeAll([[name, value]]);
  }

  /** @param {Iterable<[string, number]>} values */
  changeAll(values) {
    this.store.preview({ changes: this.#changesWith(this.changes, values) });
  }

  /** Locks a value, which handles leave as it is then, or unlocks it. */
  lock(/** @type {string} */ name, /** @type {boolean} */ isLocked) {
    this.store.change({ locked: withMember(this.state.locked, name, isLocked) });
  }

  clear(/** @type {string} */ name) {
    const changes = new Map(this.changes);
    changes.delete(name);
    this.store.preview({ changes });
  }

  reset() {
    this.store.preview({ changes: new Map(), requestedCircuit: null });
    this.resting.now();
    this.stage.fit();
  }

  /** At the end of a change. */
  settle() {
    this.resting.soon(0);
  }

  // Updates the measures, the texts, and the address after a change.
  #settle() {
    const { family, curve, study } = this;
    this.measures.show(this.reason ? null : this.measured);
    this.switches.show(this.candidates, this.study, this.on, isExtraCircuit(this));
    this.layout.refresh();
    if (this.reason) this.app.announce(`Cannot be assembled: ${this.reason}`);
    this.stage.summary.textContent = study ? summaryOfStudy(family, curve, study, this.isRecorded) : "";
    // A handle that rests while it is held has not ended its gesture.
    if (!this.stage.isHeld) this.store.commit();
  }

  /** Plays or pauses the motion; the address has the input of a linkage that stands still. */
  play() {
    this.drive.toggle();
    this.store.note({ at: this.drive.isPlaying ? null : { ...this.drive.place } });
  }

  /** After a gesture that has moved the linkage: its address has the input. */
  moved() {
    this.store.preview({ at: { ...this.drive.place } });
    this.store.commitSoon(INPUT_MILLISECONDS);
  }

  /** Shows or hides an overlay. */
  overlay(/** @type {string} */ name, /** @type {boolean} */ isOn) {
    this.store.change({ on: withMember(this.on, name, isOn) });
  }

  changeMotion(/** @type {Partial<MotionState>} */ changes) {
    this.store.change({ motion: { ...this.state.motion, ...changes } });
  }

  /** Chooses a circuit. */
  circuit(/** @type {number} */ k) {
    this.store.preview({ requestedCircuit: k });
  }

  #circuitChosen() {
    this.resting.now();
    if (!this.reason) this.beginCircuit();
  }
}
