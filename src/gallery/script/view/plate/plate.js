// A plate: the state of a linkage that is being looked at, and what happens when a hand does something to it.

import { curveKey } from "../../data/family.js";
import { address } from "../../data/address.js";
import { linkageWithOnePoint } from "../../kinematics/linkage.js";
import { ratesAt } from "../../kinematics/poses.js";
import { heldPart, partOfInput, placeAtPart, turningParts } from "./course.js";
import { DialView } from "./dial-view.js";
import { MeasureTable } from "./facts.js";
import { gripStage } from "./grips.js";
import { plateLayout } from "./layout.js";
import { OVERLAYS, Overlays } from "./overlays.js";
import { changeableParameters, changesOfQuery } from "./parameters.js";
import { pathsOfStudy, straightStretch, straightWords } from "./paths.js";
import { PlateKeys } from "./keys.js";
import { Player } from "./player.js";
import { Poser } from "./poser.js";
import { Sliders } from "./sliders.js";
import { SpeedView } from "./speed-view.js";
import { Stage } from "./stage.js";
import { measuresOfStudy } from "./measures-now.js";
import { pathOfStudy, routeTitle, studyOf } from "./study.js";
import { summaryOfStudy } from "./summary.js";
import { Switches } from "./switches.js";
import { Transport } from "./transport.js";

// A study is rough, by parts of the size, while a slider is being moved, and fine once it rests for so many milliseconds.
const ROUGH_PATH = 3e-4;
const FINE_PATH = 2e-5;
const REST_MILLISECONDS = 160;

/** The plate of a curve of a family, with what a query of its address says; `element` is shown, then `shown()` called. */
export class Plate {
  constructor(app, family, curve, query) {
    Object.assign(this, { app, family, curve });
    this.trace = family.curves.trace[curve];
    this.place = { pass: 0, input: 0, isBeyond: false };
    this.part = 0;
    this.heading = 1;
    this.study = null;
    this.player = new Player((seconds) => this.#advance(seconds));
    const drive = {
      toggle: () => this.toggle(),
      seek: (part) => this.#seekByHand(part),
      step: (direction, times) => this.step(direction, times),
      limit: (direction) => this.toLimit(direction),
      fit: () => this.stage.fit(),
      zoom: (factor) => this.stage.zoom(factor),
    };
    this.stage = new Stage();
    this.stage.onview = () => this.#draw();
    this.overlays = new Overlays(this.stage);
    this.transport = new Transport(drive);
    this.dial = new DialView();
    this.speed = new SpeedView((part) => this.#seekByHand(part));
    this.sliders = new Sliders({
      change: (name, value) => this.#change(() => this.changes.set(name, value)),
      clear: (name) => this.#change(() => this.changes.delete(name)),
      settle: () => this.#settleSoon(0),
      reset: () => this.#reset(),
    });
    this.switches = new Switches({ overlay: (name, isOn) => this.#switch(name, isOn), circuit: (k) => this.#chooseCircuit(k) });
    this.measures = new MeasureTable(app, family, curve, "piston" in (family.template.joints.find((joint) => joint.piston) ?? {}));
    this.layout = plateLayout(this);
    this.element = this.layout.element;
    this.release = gripStage(this.stage, this);
    this.keys = new PlateKeys(this, drive);
    this.#read(query);
    this.#restudy(FINE_PATH);
    if (!this.study) this.#showRecorded();
    this.#settle();
  }

  /** To be called when the element is in the page: measures the frame, and begins to play where motion is welcome. */
  shown() {
    this.stage.observe();
    this.stage.fit();
    const isStill = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (!isStill && !this.reason) this.toggle(true);
  }

  leave() {
    this.player.pause();
    this.stage.leave();
    this.keys.leave();
    this.release();
    this.layout.leave();
    window.clearTimeout(this.resting);
    window.cancelAnimationFrame(this.waiting);
  }

  /** Takes another query of the same curve's address. */
  takeQuery(query) {
    this.#read(query);
    this.#restudy(FINE_PATH);
    this.#settle(false);
    return true;
  }

  /** The name of the curve beyond its family, with what is changed of it. */
  get name() {
    const words = [...this.changes].map(([name, value]) => `${encodeURIComponent(name)}=${value}`);
    return `${this.family.id}:${curveKey(this.family, this.curve)}${words.length ? `?${words.join("&")}` : ""}`;
  }

  #read(query) {
    this.changes = changesOfQuery(this.family, this.trace, query);
    const circuit = Number(query.get("circuit"));
    this.asked = Number.isInteger(circuit) && circuit > 0 ? circuit - 1 : null;
    const shown = query.get("show");
    const names = OVERLAYS.filter(({ name, isOn }) => (shown === undefined ? isOn : shown.split(",").includes(name)));
    this.on = new Set(names.map(({ name }) => name));
  }

  // Behind what cannot be assembled from the first, the linkage of the atlas is to be seen.
  #showRecorded() {
    const { changes, asked } = this;
    this.changes = new Map();
    this.asked = null;
    this.#restudy(FINE_PATH);
    Object.assign(this, { changes, asked });
    this.#restudy(FINE_PATH);
  }

  #address() {
    const query = new Map(this.changes);
    const isAsked = this.asked !== null && this.asked !== this.study?.home;
    if (isAsked) query.set("circuit", this.asked + 1);
    const isUsual = OVERLAYS.every(({ name, isOn }) => this.on.has(name) === isOn);
    if (!isUsual) query.set("show", [...this.on].join(",") || "nothing");
    return address([this.family.id, "curve", curveKey(this.family, this.curve)], query);
  }

  // Makes the study of what is changed now; one that cannot be assembled leaves the last that could in view.
  #restudy(fineness) {
    const isRough = fineness > FINE_PATH;
    const study = studyOf(this.family, this.curve, this.changes, this.asked, isRough);
    this.sliders.show(changeableParameters(this.family, this.family.curves.cell[this.curve], this.trace, this.changes));
    this.reason = study.reason ?? null;
    this.stage.impossible(this.reason);
    this.element.classList.toggle("impossible", this.reason !== null);
    this.candidates = study.routes ? study : null;
    if (this.reason) {
      this.transport.stop();
      return;
    }
    const isFirst = this.study === null;
    this.study = study;
    this.poser = new Poser(study.linkage);
    this.alone = linkageWithOnePoint(study.linkage, study.joint);
    this.path = pathOfStudy(study, fineness);
    this.stretch = this.#stretch(isRough);
    this.stage.show(study, this.#paths(isRough));
    this.overlays.show(study, this.on, isRough);
    this.transport.show(study, routeTitle(study.linkage, study.routes[study.shown]));
    this.transport.tellStraight(this.#straightWords(isRough));
    this.dial.show(study);
    this.speed.show(study, this.path, this.stretch && [this.#partOf(this.stretch.from), this.#partOf(this.stretch.to)]);
    if (isFirst) this.#begin();
    else this.#keepPlace();
    this.stage.keepInFrame();
    this.#draw();
  }

  #paths(isRough) {
    return pathsOfStudy(this.family, this.study, this.path, this.stretch, { on: this.on, isRough });
  }

  #straightWords(isRough) {
    if (this.isRecorded) return straightWords(this.study, this.family, this.curve, null);
    return isRough ? null : straightWords(this.study, this.family, this.curve, this.measured);
  }

  #partOf({ pass, input }) {
    return heldPart(this.study.course, partOfInput(this.study.course, pass, input));
  }

  // The straight portion: the atlas's own of what it has, that of the page's measures of what is changed.
  #stretch(isRough) {
    if (this.isRecorded) return straightStretch(this.study, this.family, this.curve, null);
    if (isRough) return null;
    this.measured = measuresOfStudy(this.family, this.study);
    return straightStretch(this.study, this.family, this.curve, this.measured);
  }

  /** Whether what is shown is what the atlas has. */
  get isRecorded() {
    return this.changes.size === 0 && this.study !== null && this.study.shown === this.study.home;
  }

  // Where a plate opens: some way along, where links seldom lie on one another.
  #begin() {
    this.seek(this.study.course.closed ? 0.13 : 0.3);
  }

  // After a change: the same input, or as near it as there is.
  #keepPlace() {
    const { passes } = this.study.course;
    this.place.pass = Math.min(this.place.pass, passes.length - 1);
    const { from, to } = passes[this.place.pass];
    this.place.input = Math.min(Math.max(this.place.input, Math.min(from, to)), Math.max(from, to));
    this.part = partOfInput(this.study.course, this.place.pass, this.place.input);
  }

  #change(make) {
    make();
    if (this.waiting) return;
    // However fast a slider reports, one study to a frame is all that can be seen.
    this.waiting = window.requestAnimationFrame(() => {
      this.waiting = 0;
      this.#restudy(ROUGH_PATH);
    });
    this.#settleSoon(REST_MILLISECONDS);
  }

  #settleSoon(after) {
    window.clearTimeout(this.resting);
    this.resting = window.setTimeout(() => {
      if (this.waiting) {
        window.cancelAnimationFrame(this.waiting);
        this.waiting = 0;
      }
      this.#restudy(FINE_PATH);
      this.#settle();
    }, after);
  }

  // What follows a change when hands rest: measures, the address, words.
  #settle(isAddressed = true) {
    const isChanged = !this.isRecorded && !this.reason;
    this.measures.show(isChanged ? (this.measured ?? null) : null);
    this.switches.show(this.candidates, this.study, this.on);
    this.layout.refresh();
    if (this.reason) this.app.say?.(`It cannot be assembled: ${this.reason}`);
    this.stage.summary.textContent = this.study ? summaryOfStudy(this.family, this.curve, this.study, this.isRecorded) : "";
    if (isAddressed && this.element.isConnected) this.app.replace(this.#address());
  }

  #reset() {
    this.changes.clear();
    this.asked = null;
    this.#restudy(FINE_PATH);
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
    this.switches.show(this.candidates, this.study, this.on);
    this.#draw();
    this.app.replace(this.#address());
  }

  #chooseCircuit(k) {
    this.asked = k;
    this.#restudy(FINE_PATH);
    if (!this.reason) {
      this.#begin();
      if (!this.stage.isZoomed) this.stage.fit();
    }
    this.#settle();
  }

  /** Plays or pauses. */
  toggle(isPlaying = !this.player.isPlaying) {
    if (isPlaying && !this.reason) this.player.play();
    else this.player.pause();
    this.transport.playing(this.player.isPlaying);
    if (this.study) this.transport.now(this.part, this.place.input);
  }

  /** A hand has taken hold of the linkage. */
  hold() {
    this.toggle(false);
  }

  /** The place has been moved. */
  move() {
    this.part = partOfInput(this.study.course, this.place.pass, this.place.input);
    this.#draw();
  }

  /** Goes to a part of the course. */
  seek(part) {
    this.part = part;
    placeAtPart(this.study.course, part, this.place);
    this.#draw();
  }

  #seekByHand(part) {
    if (this.reason) return;
    this.hold();
    this.seek(part);
  }

  /** So many degrees on along the course, or hundredths of a stroke; over limits. */
  step(direction, times = 1) {
    if (this.reason) return;
    this.hold();
    const { course, linkage } = this.study;
    const by = (direction * times * (linkage.input.isLength ? course.whole / 200 : 1));
    const { from, to } = course.passes[this.place.pass];
    const next = this.place.input + Math.sign(to - from) * by;
    const isInside = (next - from) * (next - to) <= 0;
    if (isInside) {
      this.place.input = next;
      this.move();
      return;
    }
    // Beyond a limit: what is left of the step on the next pass.
    const over = this.part + by / course.whole;
    this.seek(heldPart(course, over));
  }

  /** To the next place where the input turns round, or, of a full turn, to its beginning. */
  toLimit(direction) {
    if (this.reason) return;
    this.hold();
    const parts = turningParts(this.study.course);
    const stops = parts.length ? parts : [0];
    const all = this.study.course.closed ? [...stops.map((p) => p - 1), ...stops, ...stops.map((p) => p + 1)] : stops;
    const ahead = all.filter((part) => direction * (part - this.part) > 1e-9);
    const next = ahead.length ? (direction > 0 ? Math.min(...ahead) : Math.max(...ahead)) : null;
    if (next !== null) this.seek(this.study.course.closed ? next - Math.floor(next) : next);
  }

  #advance(seconds) {
    if (this.reason) return;
    const { course, linkage } = this.study;
    const rate = this.transport.speed;
    const byInput = linkage.input.isLength ? rate / 360 : rate / course.whole;
    // A small range is not rattled through.
    let part = this.part + this.heading * seconds * Math.min(byInput, rate / 150);
    if (!course.closed && (part > 1 || part < 0)) {
      this.heading = part > 1 ? -1 : 1;
      part = part > 1 ? 2 - part : -part;
    }
    this.seek(heldPart(course, part));
  }

  #draw() {
    const { study, poser, place, stage } = this;
    if (!study || !poser) return;
    const pass = study.course.passes[place.pass];
    this.pose = poser.take(pass, place.input);
    stage.pose(this.pose);
    this.overlays.pose(this.pose, stage.view, pass, place.input);
    this.dial.pose(this.pose);
    this.transport.now(this.part, place.input);
    this.#drawSpeed(pass);
  }

  #drawSpeed(pass) {
    const { joint, linkage } = this.alone;
    const { velocity } = ratesAt(linkage, pass, this.place.input);
    const [vx, vy] = [velocity[2 * joint], velocity[2 * joint + 1]];
    const speed = Math.hypot(vx, vy);
    this.speed.now(this.part, speed);
    if (!this.on.has("velocity") || !Number.isFinite(speed)) {
      this.stage.moving.speed(null);
      return;
    }
    // The longest arrow that is shown is a sixth of the frame; on the way back the input falls.
    const longest = Math.min(this.stage.size.width, this.stage.size.height) / 5;
    const by = (Math.sign(pass.to - pass.from) * longest) / this.speed.top;
    const held = Math.min(1, (1.5 * this.speed.top) / speed);
    this.stage.moving.speed([by * held * vx, -by * held * vy]);
  }
}
