// The square handles of a plate, which change dimensions: one beside each joint that they move.

import { pixel } from "../../draw/path-data.js";
import { roundBelow } from "../../draw/plane-view.js";
import { fill, h, s } from "../dom.js";
import { handleKey, onKeys } from "../keys.js";
import { NumberField } from "../number-field.js";
import { formatInputNumber } from "./sliders.js";
import { roundedToGrain } from "./parameters.js";

// How far a handle is from its joint, and its half side, in pixels: beside the grip, which moves the mechanism.
const HANDLE_OFFSET = 17;
const HANDLE_HALF = 5;
// The half side of what takes the pointer.
const HANDLE_REACH = 12;
// From this distance, in pixels, between the joint and where it was to go, the handle says so.
const UNREACHED = 6;

/** The handles of the joints of a plate's study. */
export class Handles {
  likeness = "";
  /** @type {Handle[]} */ all = [];
  /** The handle that is dragged. @type {Handle | null} */ held = null;
  /** The handle whose values are shown, or were last. @type {Handle | null} */ shown = null;

  constructor(/** @type {Plate} */ plate) {
    this.plate = plate;
    const label = "Handles: arrow keys move a joint, Page Up and Page Down choose another";
    this.group = s("g", { role: "group", "aria-label": label });
    this.element = s("svg.sheet.squares", this.group);
    onKeys(this.element, "On a handle", [
      [
        "ArrowLeft ArrowRight ArrowUp ArrowDown",
        "move the joint; with Shift ten times as far, with Alt finely",
      ],
      ["PageUp PageDown", "another handle"],
    ]);
    /** The values of the handle that has the focus, or was dragged last, to be typed. */
    this.numbers = h("div.handle-numbers", { hidden: true, onfocusout: (event) => this.#left(event) });
    /** @type {Map<string, NumberField>} */ this.fields = new Map();
    plate.stage.picture.after(this.element);
    plate.stage.element.addEventListener("pointerover", ({ target }) => this.#pointed(target));
    this.element.after(this.numbers);
    plate.stage.element.addEventListener("pointerdown", ({ target }) => {
      if (target instanceof Node && !this.numbers.contains(target)) this.numbers.hidden = true;
    });
  }

  /** Makes the handles of a study; those of a linkage of the same structure stay. */
  show(/** @type {Study} */ study) {
    if (this.held) return;
    const joints = study.kernel.handles();
    const likeness = JSON.stringify(joints);
    if (likeness === this.likeness) return;
    this.likeness = likeness;
    this.all = joints.map((joint) => this.#handle(joint, study));
    this.group.replaceChildren(...this.all.map(({ element }) => element));
    this.all[0]?.element.setAttribute("tabindex", "0");
  }

  /** Moves the handles beside their joints, at `at` on the screen, [X0, Y0, …]. */
  pose(/** @type {Float64Array} */ at) {
    for (const { joint, element } of this.all) {
      const [x, y] = [at[2 * joint], at[2 * joint + 1]];
      if (Number.isFinite(x + y)) element.setAttribute("transform", `translate(${pixel(x)} ${pixel(y)})`);
    }
    this.#placeNumbers(at);
  }

  /** Marks the handles that move with a parameter, whose field has the focus; null for none. */
  mark(/** @type {string | null} */ name) {
    for (const { element, names } of this.all)
      element.classList.toggle("marked", name !== null && names.includes(name));
  }

  // The handle of the joint that the pointer rests on is shown.
  #pointed(/** @type {EventTarget | null} */ target) {
    const on = target instanceof Element ? target.closest("[data-joint], [data-handle]") : null;
    const joint = on?.getAttribute("data-joint") ?? on?.getAttribute("data-handle");
    for (const one of this.all) one.element.classList.toggle("near", String(one.joint) === joint);
  }

  /**
   * Begins to drag the handle of a joint; `move` takes the pointer's places in the plane, and whether values are not
   * to be round. All are found from the linkage as it is now, so that what is dragged back is as it was.
   * @param {number} joint @param {Point} pointer
   */
  drag(joint, pointer) {
    const { plate } = this;
    const handle = this.all.find((one) => one.joint === joint);
    const from = plate.study && {
      study: plate.studyAgain(plate.study.shown),
      place: { ...plate.drive.place },
    };
    const { joints } = plate.pose;
    const off = [joints[2 * joint] - pointer[0], joints[2 * joint + 1] - pointer[1]];
    this.held = handle ?? null;
    if (handle) this.#showNumbers(handle);
    handle?.element.classList.add("held");
    plate.stage.isHeld = true;
    const move = (/** @type {Point} */ [x, y], isFree = false) =>
      handle && from && this.#move(handle, from, [x + off[0], y + off[1]], isFree);
    const end = () => {
      from?.study.close();
      plate.stage.isHeld = false;
      this.release();
      plate.settle();
    };
    return { move, end };
  }

  /** After a drag, or a step by keys. */
  release() {
    this.held?.element.classList.remove("held", "unreached");
    this.held = null;
  }

  /**
   * Moves a joint to a place: a request of the kernel, whose answer is a change of parameters.
   * @param {Handle} handle @param {{ study: KernelStudy, place: Place }} from @param {Point} to
   */
  #move(handle, { study, place }, to, /** @type {boolean} */ isFree) {
    const { plate } = this;
    const unlocked = handle.names.filter((name) => !plate.state.locked.has(name));
    const found = study.drag({ joint: handle.joint, to, ...place, unlocked });
    const { scale } = plate.stage.view;
    handle.element.classList.toggle("unreached", !found.is_held || scale * found.distance > UNREACHED);
    if (!found.is_held) return;
    // A pixel is about a step of a value, unless it is to be free.
    const grain = roundBelow(1 / scale);
    /** @returns {[string, number]} */
    const rounded = (/** @type {[string, number]} */ [name, value]) => [
      name,
      isFree ? value : roundedToGrain(value, grain),
    ];
    const changes = new Map(found.changes.map(rounded));
    plate.changeAll(changes);
  }

  /** @param {HandleAnswer} answer @param {Study} study @returns {Handle} */
  #handle({ joint, names, nearest }, { joints, mechanism }) {
    const [o, a, r] = [HANDLE_OFFSET, HANDLE_HALF, HANDLE_REACH];
    const label = `Move ${joints[joint]}: changes ${nearest.join(", ")}`;
    const attributes = { tabindex: "-1", role: "button", "aria-label": label, "data-handle": joint };
    const element = s("g.square", attributes, [
      // A fixed pivot has no grip.
      mechanism.fixed.includes(joint) ? s("circle.square-reach", { r: o }) : [],
      s("path.square-reach", { d: `M${o - r} ${o - r}h${2 * r}v${2 * r}h${-2 * r}Z` }),
      s("path.square-line", { d: `M3 3L${o - a} ${o - a}` }),
      s("path.square-mark", { d: `M${o - a} ${o - a}h${2 * a}v${2 * a}h${-2 * a}Z` }),
    ]);
    const handle = { joint, names, nearest, element };
    element.addEventListener("keydown", (event) => {
      const all = this.all.map((one) => one.element);
      handleKey(event, all, all.indexOf(element), (by) => this.#step(handle, by, event.altKey));
    });
    element.addEventListener("keyup", () => this.plate.settle());
    element.addEventListener("focus", () => this.#showNumbers(handle));
    element.addEventListener("blur", (event) => this.#left(event));
    return handle;
  }

  /** Moves a joint by pixels on the screen. @param {Handle} handle @param {Point} by */
  #step(handle, [right, up], /** @type {boolean} */ isFree) {
    const { study, drive, pose, stage } = this.plate;
    drive.toggle(false);
    const [x, y] = pose.joints.subarray(2 * handle.joint);
    /** @type {Point} */ const to = [x + right / stage.view.scale, y + up / stage.view.scale];
    if (study) this.#move(handle, { study: study.kernel, place: drive.place }, to, isFree);
  }

  /** Shows the values by which a handle moves its joint. @param {Handle} handle */
  #showNumbers(handle) {
    const { plate, numbers, fields } = this;
    this.shown = handle;
    fields.clear();
    for (const name of handle.nearest) {
      const on = {
        change: (/** @type {number} */ value) => plate.change(name, value),
        settle: () => plate.settle(),
      };
      fields.set(name, new NumberField({ "aria-label": `${name} at the handle`, size: 8 }, on));
    }
    const labels = Array.from(fields, ([name, { element }]) => h("label", h("span", name), element));
    fill(numbers, labels);
    numbers.hidden = false;
    this.showValues(plate.sliders.values());
    this.pose(plate.stage.moving.at);
  }

  /** Shows the values of names next to the handle. @param {Map<string, number>} values */
  showValues(values) {
    for (const [name, field] of this.fields) {
      const value = values.get(name);
      if (value !== undefined) field.show(value, formatInputNumber(value));
    }
  }

  // The values stay while they are being typed.
  #left(/** @type {FocusEvent} */ { relatedTarget }) {
    const to = relatedTarget instanceof Node ? relatedTarget : null;
    if (!to || (!this.numbers.contains(to) && !this.group.contains(to))) this.numbers.hidden = true;
  }

  #placeNumbers(/** @type {Float64Array} */ at) {
    if (this.numbers.hidden || !this.shown) return;
    const { joint } = this.shown;
    // Beside the handle, and inside of the frame.
    const right = this.plate.stage.size.width - this.numbers.offsetWidth - 4;
    const [x, y] = [Math.min(at[2 * joint] + 30, right), at[2 * joint + 1] + 24];
    this.numbers.style.translate = `${pixel(x)}px ${pixel(y)}px`;
  }
}
