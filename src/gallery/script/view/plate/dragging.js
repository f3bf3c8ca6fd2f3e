// Pointer input on the stage: drags a joint along its path, the crank about its pivot, and pans and zooms the picture.

import { planePoint } from "../../draw/plane-view.js";
import { pinch } from "../zoom.js";
import { followInput, nearestPart, placeAtPart } from "./timeline.js";

// How far the pointer drags the crank beyond a limit before it returns on the other branch, in degrees.
const LIMIT_SLACK = 3;

/**
 * Handles pointers on a stage. `plate` has study, pose, reason (why nothing can be dragged, or null) and
 * drive. The signal ends it.
 * @param {Stage} stage @param {Plate} plate @param {AbortSignal} signal
 */
export function enableDragging(stage, plate, signal) {
  const { element: frame, picture } = stage;
  /** @type {Map<number, Point>} */ const pointers = new Map();
  /** @type {{ move(at: Point, isFree?: boolean): unknown, end(): void } | null} */ let drag = null;
  let dragPointer = -1;
  const otherOf = (/** @type {number} */ id) => [...pointers].find(([key]) => key !== id)?.[1] ?? [0, 0];
  /** @returns {Point} */
  const pointOf = (/** @type {MouseEvent} */ event) => {
    const box = picture.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const down = (/** @type {PointerEvent} */ event) => {
    if (event.button !== 0 || !plate.study || plate.reason) return;
    const { target } = event;
    if (!(target instanceof Element) || target.closest("input")) return;
    const at = pointOf(event);
    pointers.set(event.pointerId, at);
    const joint = target.closest("[data-joint]")?.getAttribute("data-joint");
    const handle = target.closest("[data-handle]")?.getAttribute("data-handle");
    const held = handle ?? joint;
    if (typeof held === "string" && pointers.size === 1) {
      plate.drive.toggle(false);
      dragPointer = event.pointerId;
      drag = startDrag(plate, { handle, joint }, planePoint(stage.view, at));
      stage.element.classList.add("dragging");
    }
    if (typeof held === "string" || event.pointerType === "mouse") {
      frame.setPointerCapture(event.pointerId);
      event.preventDefault();
    }
  };
  const moved = (/** @type {PointerEvent} */ event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const at = pointOf(event);
    if (drag) {
      // Only the pointer that started the drag moves the joint.
      if (event.pointerId === dragPointer) drag.move(planePoint(stage.view, at), event.altKey);
    } else if (pointers.size === 2) pinch(stage, otherOf(event.pointerId), before, at);
    else if (event.pointerType === "mouse") stage.pan(at[0] - before[0], at[1] - before[1]);
    pointers.set(event.pointerId, at);
  };
  const up = (/** @type {PointerEvent} */ event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (pointers.size > 0) return;
    stage.element.classList.remove("dragging");
    plate.drive.place.isBeyond = false;
    drag?.end();
    drag = null;
  };
  let scrolled = -Infinity;
  const scroll = () => {
    scrolled = performance.now();
  };
  const wheel = (/** @type {WheelEvent} */ event) => {
    // A page that is scrolling continues to scroll over the picture.
    if (!event.ctrlKey && performance.now() - scrolled < 400) return;
    event.preventDefault();
    stage.zoom(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), pointOf(event));
  };
  Object.assign(frame, { onpointerdown: down, onpointermove: moved, onpointerup: up, onpointercancel: up });
  frame.addEventListener("wheel", wheel, { passive: false });
  window.addEventListener("scroll", scroll, { passive: true, signal });
}

/**
 * Starts a drag of a handle or of a joint, whose `move` takes the pointer's positions in the plane.
 * @param {Plate} plate @param {Record<"handle" | "joint", string | null | undefined>} _ @param {Point} pointer
 */
function startDrag(plate, { handle, joint }, pointer) {
  if (typeof handle === "string") return plate.handles.drag(Number(handle), pointer);
  const number = Number(joint);
  const crank = plate.study?.crank;
  const isCrank = crank && crank.pin === number && crank.can_turn;
  const move = isCrank ? dragCrank(plate, crank.pivot, number, pointer) : dragJoint(plate, number, pointer);
  return { move, end: () => plate.moved() };
}

// The crank follows the direction of the pointer about its pivot, over several turns and over limits.
/** @param {number} pivot @param {number} pin @param {Point} pointer */
function dragCrank(/** @type {Plate} */ plate, pivot, pin, pointer) {
  const { drive } = plate;
  const pose = plate.pose.joints;
  const { place } = drive;
  const sense = plate.study?.is_mirrored ? -1 : 1;
  const directionOf = (/** @type {Point} */ [x, y]) =>
    (Math.atan2(y - pose[2 * pivot + 1], x - pose[2 * pivot]) * 180) / Math.PI;
  /** @param {number} from @param {number} to */
  const turned = (from, to) => sense * (((((to - from + 180) % 360) + 360) % 360) - 180);
  let direction = directionOf(pointer);
  let wanted = place.input + turned(directionOf([pose[2 * pin], pose[2 * pin + 1]]), direction);
  const follow = () => {
    wanted = followInput(drive.timeline, place, wanted, LIMIT_SLACK);
    drive.move();
  };
  follow();
  return (/** @type {Point} */ at) => {
    const now = directionOf(at);
    wanted += turned(direction, now);
    direction = now;
    follow();
  };
}

// Any other joint moves along its path to the point nearest to the pointer.
function dragJoint(/** @type {Plate} */ plate, /** @type {number} */ joint, /** @type {Point} */ pointer) {
  const pose = plate.pose.joints;
  const [offX, offY] = [pose[2 * joint] - pointer[0], pose[2 * joint + 1] - pointer[1]];
  /** @type {Place} */ const spot = { pass: 0, input: 0 };
  return (/** @type {Point} */ [x, y]) => {
    if (!plate.study) return;
    const { timeline, kernel } = plate.study;
    const distance = (/** @type {number} */ part) => {
      placeAtPart(timeline, part, spot);
      const [atX, atY] = kernel.jointPosition(joint, spot.pass, spot.input);
      const far = Math.hypot(atX - x - offX, atY - y - offY);
      return Number.isFinite(far) ? far : Infinity;
    };
    plate.drive.seek(nearestPart(timeline, plate.drive.part, distance));
  };
}
