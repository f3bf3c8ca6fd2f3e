// The moving parts of a plate: links, pins, sliders and the traced point, in screen pixels.

import { arrowData, blockData, cylinderData, linkData, slotData, slotEnds } from "../../draw/link-shapes.js";
import { pixel, definedData } from "../../draw/path-data.js";
import { s, setAttributes } from "../dom.js";
import { JointNames } from "./joint-names.js";

const PIN_RADIUS = 4.5;

/** The upper layer of a stage. */
export class MovingLayer {
  /** @type {Study} */ study;
  likeness = "";
  /** The handles of joints and of the crank. @type {{ element: Element, joint: number }[]} */ grips = [];
  /** @type {{ element: Element, joints: number[] }[]} */ crankGrips = [];
  parts = /** @type {MovingPart[]} */ ([]);
  circles = /** @type {{ element: Element, joint: number }[]} */ ([]);
  /** @type {Float64Array | null} */ poseNow = null;
  /** @type {Placement} */ view = { scale: 1, x: 0, y: 0 };
  /** The velocity of the traced point in pixels. @type {number[] | null} */ arrow = null;
  /** Called with the places of the joints on the screen. */ onpose = (/** @type {Float64Array} */ _) => {};

  constructor() {
    this.links = s("g");
    this.overlays = s("g");
    this.pins = s("g");
    this.names = new JointNames();
    this.others = s("path.other-points");
    this.velocity = s("path.velocity");
    this.tracer = s("circle.tracer", { r: PIN_RADIUS });
    this.handles = s("g.handles");
    const below = [this.links, this.overlays, this.others, this.pins];
    const above = [this.velocity, this.tracer, this.names.element, this.handles];
    this.element = s("svg.sheet.moving", { "aria-hidden": "true" }, below, above);
    this.at = new Float64Array(0);
    this.ends = new Float64Array(4);
  }

  /** Creates the elements of a study's linkage; reuses them for a linkage of the same structure. */
  show(/** @type {Study} */ study) {
    this.study = study;
    const { mechanism, joints, joint } = study;
    const { bars, plates, fixed, pins, slots } = mechanism;
    const likeness = JSON.stringify([bars, plates, fixed, pins, slots.map(({ foot }) => foot), joint]);
    if (this.at.length !== 2 * joints.length) this.at = new Float64Array(2 * joints.length);
    if (likeness === this.likeness) {
      // The ends of slots depend on the study.
      this.parts.forEach((part) => {
        if (part.slot !== undefined) part.shape = slots[part.slot];
      });
      return;
    }
    this.likeness = likeness;
    this.parts = partsOfMechanism(mechanism);
    this.links.replaceChildren(...this.parts.map(({ element }) => element));
    this.circles = circlesOfMechanism(study);
    this.pins.replaceChildren(...this.circles.map(({ element }) => element));
    this.handles.replaceChildren(...handlesOfStudy(study, this));
    this.names.show(study);
  }

  /** Sets the view of the plane and redraws the pose. @param {Placement} view */
  place(view) {
    this.view = view;
    if (this.poseNow) this.pose(this.poseNow, view);
  }

  pose(/** @type {Float64Array} */ pose, /** @type {Placement} */ view) {
    this.poseNow = pose;
    this.view = view;
    const { at } = this;
    const { scale, x, y } = view;
    for (let k = 0; k < at.length; k += 2) {
      at[k] = x + scale * pose[k];
      at[k + 1] = y - scale * pose[k + 1];
    }
    for (const part of this.parts)
      part.element.setAttribute("d", definedData(part.data(at, scale, this.ends, part)));
    for (const { element, joint } of this.circles) putCircle(element, at, joint);
    for (const { element, joint } of this.grips) putCircle(element, at, joint);
    for (const { element, joints } of this.crankGrips)
      element.setAttribute("d", definedData(linkData(joints, at, false)));
    putCircle(this.tracer, at, this.study.joint);
    this.#otherPoints();
    this.names.pose(at);
    this.onpose(at);
    this.#arrow();
  }

  /** Sets the velocity of the traced point in pixels, [dx, dy], or null. */
  speed(/** @type {number[] | null} */ arrow) {
    this.arrow = arrow;
    this.#arrow();
  }

  #arrow() {
    const { at, arrow, velocity, study } = this;
    const k = 2 * study.joint;
    const isFinite = arrow && Number.isFinite(arrow[0] + arrow[1]);
    setAttributes(velocity, { d: isFinite ? arrowData(at[k], at[k + 1], arrow[0], arrow[1]) : "" });
  }

  #otherPoints() {
    const { others } = this.study;
    let data = "";
    for (const { joint } of others) {
      const [x, y] = [this.at[2 * joint], this.at[2 * joint + 1]];
      if (Number.isFinite(x + y)) data += `M${pixel(x)} ${pixel(y)}h0`;
    }
    this.others.setAttribute("d", data);
  }
}

/** @param {Float64Array} at @param {number} joint */
function putCircle(/** @type {Element} */ element, at, joint) {
  const [x, y] = [at[2 * joint], at[2 * joint + 1]];
  if (!Number.isFinite(x + y)) return;
  setAttributes(element, { cx: pixel(x), cy: pixel(y) });
}

/** Paths, each with its data as a function of the joint positions. @returns {MovingPart[]} */
function partsOfMechanism(/** @type {Mechanism} */ { bars, plates, blocks, slots, actuators }) {
  const part = (/** @type {string} */ name, /** @type {PartData} */ data) => ({
    element: s("path", { class: name }),
    data,
  });
  const link = (/** @type {number[]} */ joints, isPlate = false) =>
    part(isPlate ? "link plate" : "link", (at) => linkData(joints, at, isPlate));
  const cylinder = (/** @type {[number, number]} */ [p, q]) =>
    part("hollow", (at) => cylinderData(at[2 * p], at[2 * p + 1], at[2 * q], at[2 * q + 1]));
  const stem = () =>
    part("link", (at, scale, ends, own) => {
      const { foot } = slotEnds(own, at, scale, ends);
      return linkData([0, 1, 2], [at[2 * foot], at[2 * foot + 1], ...ends]);
    });
  const hole = () =>
    part("hollow", (at, scale, ends, own) => {
      slotEnds(own, at, scale, ends);
      return slotData(ends[0], ends[1], ends[2], ends[3]);
    });
  // A block in a slot is aligned with the slot, a block on a guide with the guide.
  const block = (/** @type {Mechanism["blocks"][number]} */ { at: joint, line: [p, q] }) =>
    part("hollow", (at) =>
      blockData(at[2 * joint], at[2 * joint + 1], at[2 * q] - at[2 * p], at[2 * q + 1] - at[2 * p + 1]),
    );
  return [
    ...plates.map((joints) => link(joints, true)),
    ...bars.map((joints) => link(joints)),
    ...slots.map((shape, slot) => ({ ...stem(), shape, slot })),
    ...slots.map((shape, slot) => ({ ...hole(), shape, slot })),
    ...actuators.flatMap((ends) => [link(ends), cylinder(ends)]),
    ...blocks.map(block),
  ];
}

// Double circles for fixed pivots, single ones for pins.
function circlesOfMechanism(/** @type {Study} */ { mechanism, joint: traced }) {
  /** @param {string} name @param {number} r @param {number} joint */
  const circle = (name, r, joint) => ({ element: s("circle", { class: name, r }), joint });
  const pins = mechanism.pins.filter((joint) => joint !== traced);
  return [
    ...mechanism.fixed.flatMap((joint) => [
      circle("pivot", 1.5 * PIN_RADIUS, joint),
      circle("pivot inner", 0.7 * PIN_RADIUS, joint),
    ]),
    ...pins.map((joint) => circle("pin", PIN_RADIUS, joint)),
  ];
}

// The drag handles: the crank along its length, and every moving joint.
/** @param {Study} _ @param {MovingLayer} sheet */
function handlesOfStudy({ crank, mechanism, joint: traced }, sheet) {
  const joints = [...new Set([...mechanism.pins, traced, ...mechanism.slots.map(({ through }) => through)])];
  const cranks = crank && mechanism.fixed.includes(crank.pivot) ? [[crank.pivot, crank.pin]] : [];
  sheet.crankGrips = cranks.map((pair) => ({
    element: s("path.grip.crank-grip", { "data-joint": pair[1] }),
    joints: pair,
  }));
  const grip = (/** @type {number} */ joint) => s("circle.grip", { r: 15, "data-joint": joint });
  sheet.grips = joints.map((joint) => ({ element: grip(joint), joint }));
  return [...sheet.crankGrips, ...sheet.grips].map(({ element }) => element);
}
