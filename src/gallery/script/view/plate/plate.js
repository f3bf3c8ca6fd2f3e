// A plate: the state of the linkage of a curve, and the response to input.

import { enableDragging } from "./dragging.js";
import { MeasureTable } from "./facts.js";
import { PlateFigure } from "./figure.js";
import { plateLayout, watchKeys } from "./layout.js";
import { changeableParameters } from "./parameters.js";
import { plateCurveName, isExtraCircuit, plateAddress, readPlateQuery } from "./plate-query.js";
import { Sliders } from "./sliders.js";
import { recordedValues, studyOf, summaryOfStudy } from "./study.js";
import { Switches } from "./switches.js";

// The time in milliseconds after which a slider has rested.
const REST_MILLISECONDS = 160;

/**
 * The plate of a curve of a family, with the query of its address. Put `element` into the document, then call
 * `shown()`.
 */
export class Plate extends PlateFigure {
  /** The circuits of what was asked for. @type {Candidates} */
  candidates;
  /** The index of a circuit among all. @type {number | null} */
  requestedCircuit;
  resting = 0;
  waiting = 0;

  /** @param {App} app @param {Kernel} kernel @param {Family} family @param {number} curve @param {Query} query */
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
    this.layout = plateLayout(this);
    this.element = this.layout.element;
    const releases = [enableDragging(this.stage, this), watchKeys(this)];
    this.release = () => releases.forEach((release) => release());
    this.#readQuery(query);
    this.#restudy(false);
    if (!this.study) this.#showRecorded();
    this.#settle();
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
    this.release();
    this.layout.leave();
    this.study?.kernel.close();
    window.clearTimeout(this.resting);
    window.cancelAnimationFrame(this.waiting);
  }

  /** Handles another query of the same curve's address. @param {Query} query */
  setQuery(query) {
    this.#readQuery(query);
    this.#restudy(false);
    this.#settle(false);
    return true;
  }

  #readQuery(/** @type {Query} */ query) {
    const { changes, requestedCircuit, on } = readPlateQuery(this.family, this.recorded.point, query);
    this.changes = changes;
    this.requestedCircuit = requestedCircuit;
    this.on = on;
  }

  /** The name of the curve, with its family and changes. */
  get name() {
    return plateCurveName(this);
  }

  // If the address cannot be assembled, the linkage of the atlas is shown behind the message.
  #showRecorded() {
    const { changes, requestedCircuit } = this;
    this.changes = new Map();
    this.requestedCircuit = null;
    this.#restudy(false);
    this.changes = changes;
    this.requestedCircuit = requestedCircuit;
    this.#restudy(false);
  }

  // Creates the study of the current changes; if it cannot be assembled, the previous one stays visible.
  #restudy(isRough) {
    const { family, kernel, changes, description, recorded } = this;
    const curve = kernel.curve(family, this.curve, changes);
    const study = studyOf(kernel, curve, this.requestedCircuit, isRough);
    if (study.values) this.current = { values: study.values, point: study.point ?? null };
    this.sliders.show(changeableParameters(family, description.names, recorded, this.current, changes));
    this.reason = study.reason;
    this.candidates = { ...study, is_length: family.is_length };
    this.stage.impossible(this.reason);
    this.element.classList.toggle("impossible", this.reason !== null);
    if (study.reason !== null) {
      this.drive.isHalted = true;
      this.transport.stop();
      return;
    }
    this.study?.kernel.close();
    this.study = study;
    this.guarded(() => this.show(study, isRough));
  }

  change(name, value) {
    this.changes.set(name, value);
    this.#changed();
  }

  clear(name) {
    this.changes.delete(name);
    this.#changed();
  }

  /** At the end of a change. */
  settle() {
    this.#settleSoon(0);
  }

  #changed() {
    this.#settleSoon(REST_MILLISECONDS);
    // At most one study per frame.
    this.waiting ||= window.requestAnimationFrame(() => {
      this.waiting = 0;
      this.#restudy(true);
    });
  }

  #settleSoon(after) {
    window.clearTimeout(this.resting);
    this.stage.element.setAttribute("aria-busy", "true");
    this.resting = window.setTimeout(() => {
      this.stage.element.removeAttribute("aria-busy");
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

  reset() {
    this.changes.clear();
    this.requestedCircuit = null;
    this.#restudy(false);
    this.stage.fit();
    this.#settle();
  }

  /** Shows or hides an overlay. */
  overlay(name, isOn) {
    if (isOn) this.on.add(name);
    else this.on.delete(name);
    const { study, on } = this;
    if (!study) return;
    const before = this.stage.box;
    if (name === "others") this.stage.show(study, this.pathsOf(study, false));
    this.overlays.show(study, on, false);
    if (before !== this.stage.box && !this.stage.isZoomed) this.stage.fit();
    this.switches.show(this.candidates, study, on, isExtraCircuit(this));
    this.draw();
    this.app.replace(plateAddress(this));
  }

  /** Chooses a circuit. */
  circuit(k) {
    this.requestedCircuit = k;
    this.#restudy(false);
    if (!this.reason) {
      this.drive.begin();
      if (!this.stage.isZoomed) this.stage.fit();
      this.draw();
    }
    this.#settle();
  }
}
