// Hands on the stage: a joint is dragged along its path, the crank about its pivot, the picture moved and
// zoomed.

import { singlePointLinkage } from "../../kinematics/linkage.js";
import { planePoint } from "../../draw/plane-view.js";
import { followedInput, nearestPart, placeAtPart } from "./course.js";
import { Poser } from "./poser.js";

// How far beyond a limit a hand on the crank goes before it comes back on the other branch, in degrees.
const LIMIT_SLACK = 3;

/**
 * Takes pointers on a stage. `plate` has study, pose, reason (why there is nothing to be dragged, or null)
 * and drive. Returns a function that takes the listeners off.
 */
export function gripStage(stage, plate) {
  const { picture } = stage;
  const hands = new Map();
  let drag = null;
  let holding = null;
  const pointOf = (event) => {
    const box = picture.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const down = (event) => {
    if (event.button !== 0 || !plate.study || plate.reason) return;
    const at = pointOf(event);
    hands.set(event.pointerId, at);
    const joint = event.target.closest?.("[data-joint]")?.dataset.joint;
    if (joint !== undefined && hands.size === 1) {
      plate.drive.hold();
      holding = event.pointerId;
      drag = begunDrag(plate, stage, Number(joint), planePoint(stage.view, at));
      stage.element.classList.add("dragging");
    }
    if (joint !== undefined || event.pointerType === "mouse") {
      picture.setPointerCapture(event.pointerId);
      event.preventDefault();
    }
  };
  const moved = (event) => {
    const before = hands.get(event.pointerId);
    if (!before) return;
    const at = pointOf(event);
    if (drag) {
      // A second finger beside the one that drags does nothing.
      if (event.pointerId === holding) drag(planePoint(stage.view, at));
    } else if (hands.size === 2) pinch(stage, hands, event.pointerId, at);
    else if (event.pointerType === "mouse") stage.pan(at[0] - before[0], at[1] - before[1]);
    hands.set(event.pointerId, at);
  };
  const up = (event) => {
    if (!hands.delete(event.pointerId)) return;
    if (hands.size > 0) return;
    drag = null;
    stage.element.classList.remove("dragging");
    plate.drive.place.isBeyond = false;
  };
  let scrolled = -Infinity;
  const scroll = () => {
    scrolled = performance.now();
  };
  const wheel = (event) => {
    // A page that is being scrolled goes on over the picture.
    if (!event.ctrlKey && performance.now() - scrolled < 400) return;
    event.preventDefault();
    stage.zoom(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), pointOf(event));
  };
  const listeners = [
    ["pointerdown", down],
    ["pointermove", moved],
    ["pointerup", up],
    ["pointercancel", up],
    ["wheel", wheel],
  ];
  for (const [name, listener] of listeners) picture.addEventListener(name, listener, { passive: false });
  window.addEventListener("scroll", scroll, { passive: true });
  return () => window.removeEventListener("scroll", scroll);
}

function pinch(stage, hands, id, at) {
  const [other] = [...hands].find(([key]) => key !== id)?.slice(1) ?? [];
  if (!other) return;
  const before = hands.get(id);
  const apart = ([x, y]) => Math.hypot(x - other[0], y - other[1]);
  if (apart(before) > 0)
    stage.zoom(apart(at) / apart(before), [(at[0] + other[0]) / 2, (at[1] + other[1]) / 2]);
  stage.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
}

// A function to be called with the places, in the plane, where the hand is.
function begunDrag(plate, stage, joint, hand) {
  const { step } = plate.study.linkage.joints[joint];
  const isCrank = step.kind === "crank" && !plate.study.linkage.seenFrom;
  return isCrank ? draggedCrank(plate, step.pivot, joint, hand) : draggedJoint(plate, joint, hand);
}

// The crank follows the direction of the hand about its pivot, turn after turn, and over limits.
function draggedCrank(plate, pivot, pin, hand) {
  const { study, pose, drive } = plate;
  const { place } = drive;
  const sense = study.linkage.placement.mirror ? -1 : 1;
  const directionOf = ([x, y]) => (Math.atan2(y - pose[2 * pivot + 1], x - pose[2 * pivot]) * 180) / Math.PI;
  const turned = (from, to) => sense * (((((to - from + 180) % 360) + 360) % 360) - 180);
  let direction = directionOf(hand);
  let wanted = place.input + turned(directionOf([pose[2 * pin], pose[2 * pin + 1]]), direction);
  const follow = () => {
    wanted = followedInput(plate.study.course, place, wanted, LIMIT_SLACK);
    drive.move();
  };
  follow();
  return (at) => {
    const now = directionOf(at);
    wanted += turned(direction, now);
    direction = now;
    follow();
  };
}

// Any other joint goes along its path to where it is nearest the hand.
function draggedJoint(plate, joint, hand) {
  const alone = singlePointLinkage(plate.study.linkage, joint);
  const poser = new Poser(alone.linkage);
  const { pose } = plate;
  const [offX, offY] = [pose[2 * joint] - hand[0], pose[2 * joint + 1] - hand[1]];
  const spot = {};
  return ([x, y]) => {
    const { course } = plate.study;
    const distance = (part) => {
      placeAtPart(course, part, spot);
      const at = poser.take(course.passes[spot.pass], spot.input);
      const far = Math.hypot(at[2 * alone.joint] - x - offX, at[2 * alone.joint + 1] - y - offY);
      return Number.isFinite(far) ? far : Infinity;
    };
    plate.drive.seek(nearestPart(course, plate.drive.part, distance));
  };
}
