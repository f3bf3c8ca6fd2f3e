// Draws the parts of a linkage as path data on the screen. `at` has the positions of all joints in pixels, [X0, Y0, X1, Y1, …].

import { pixel } from "./path-data.js";

const SLIDER_BLOCK = { long: 11, wide: 7 };

/** Path data through joints, closed for a plate. @param {number[]} joints @param {Points} at @param {boolean} [isPlate] */
export function linkData(joints, at, isPlate = false) {
  let data = "";
  for (let k = 0; k < joints.length; k++) {
    const id = joints[k];
    data += `${k === 0 ? "M" : "L"}${pixel(at[2 * id])} ${pixel(at[2 * id + 1])}`;
  }
  return isPlate ? `${data}Z` : data;
}

/** Path data of a sliding block centred at a point, along a direction. @param {number} x @param {number} y @param {number} dx @param {number} dy */
export function blockData(x, y, dx, dy) {
  const [ux, uy] = unitVector(dx, dy);
  const [lx, ly] = [SLIDER_BLOCK.long * ux, SLIDER_BLOCK.long * uy];
  return boxData(x - lx, y - ly, x + lx, y + ly, SLIDER_BLOCK.wide);
}

/** A direction as a vector of length 1, to the right if it has none. @returns {Point} */
function unitVector(/** @type {number} */ dx, /** @type {number} */ dy) {
  const size = Math.hypot(dx, dy);
  return size > 0 ? [dx / size, dy / size] : [1, 0];
}

/**
 * Path data of the cylinder of an actuator, on the half nearer to its first end; its rod goes from end to end.
 * @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1
 */
export function cylinderData(x0, y0, x1, y1) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  return boxData(x0 + 0.1 * dx, y0 + 0.1 * dy, x0 + 0.6 * dx, y0 + 0.6 * dy, 5.5);
}

/**
 * Path data of a slot from end to end, as wide as a block, with round ends beyond the ends of a block.
 * @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1
 */
export function slotData(x0, y0, x1, y1) {
  const [ux, uy] = unitVector(x1 - x0, y1 - y0);
  const over = SLIDER_BLOCK.long - SLIDER_BLOCK.wide + 1;
  const [r, nx, ny] = [SLIDER_BLOCK.wide, -uy * SLIDER_BLOCK.wide, ux * SLIDER_BLOCK.wide];
  const [ax, ay, bx, by] = [x0 - over * ux, y0 - over * uy, x1 + over * ux, y1 + over * uy];
  return (
    `M${pixel(ax + nx)} ${pixel(ay + ny)}A${r} ${r} 0 0 1 ${pixel(ax - nx)} ${pixel(ay - ny)}` +
    `L${pixel(bx - nx)} ${pixel(by - ny)}A${r} ${r} 0 0 1 ${pixel(bx + nx)} ${pixel(by + ny)}Z`
  );
}

/**
 * Writes the ends of the slot of a part on the screen, [X0, Y0, X1, Y1], to `out`, and returns the slot; `scale` is in pixels per unit.
 * @param {Points} at @param {number} scale @param {Float64Array} out
 */
export function slotEnds(/** @type {{ shape?: Slot }} */ { shape }, at, scale, out) {
  if (!shape) throw new Error("there is no slot");
  const { foot, near, far } = shape;
  const [from, to] = shape.base;
  const [ux, uy] = unitVector(at[2 * to] - at[2 * from], at[2 * to + 1] - at[2 * from + 1]);
  // On the screen y is down, which exchanges left and right of a direction.
  [near, far].forEach(([along, left], k) => {
    out[2 * k] = at[2 * foot] + scale * (along * ux + left * uy);
    out[2 * k + 1] = at[2 * foot + 1] + scale * (along * uy - left * ux);
  });
  return shape;
}

/** Path data of an arrow from a point along dx, dy. @param {number} x @param {number} y @param {number} dx @param {number} dy */
export function arrowData(x, y, dx, dy) {
  const size = Math.hypot(dx, dy);
  if (!(size > 1)) return "";
  const [ux, uy] = [dx / size, dy / size];
  const [tx, ty, head] = [x + dx, y + dy, Math.min(8, size)];
  const barb = (/** @type {number} */ side) =>
    `${pixel(tx - head * ux + side * 0.36 * head * uy)} ${pixel(ty - head * uy - side * 0.36 * head * ux)}`;
  const tip = `${pixel(tx)} ${pixel(ty)}`;
  return `M${pixel(x)} ${pixel(y)}L${tip}M${barb(1)}L${tip}L${barb(-1)}`;
}

/** @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 @param {number} half */
function boxData(x0, y0, x1, y1, half) {
  const [ux, uy] = unitVector(x1 - x0, y1 - y0);
  const [nx, ny] = [-half * uy, half * ux];
  /** @param {number} x @param {number} y @param {number} side */
  const corner = (x, y, side) => `${pixel(x + side * nx)} ${pixel(y + side * ny)}`;
  return `M${corner(x0, y0, 1)}L${corner(x1, y1, 1)}L${corner(x1, y1, -1)}L${corner(x0, y0, -1)}Z`;
}

/** Path data of the ground symbol of a pivot at X, Y on the screen, `width` pixels wide. */
export function groundData(/** @type {number} */ x, /** @type {number} */ y, width = 22) {
  const STROKES = 4;
  const top = y + 0.5 * width;
  const [left, deep, step] = [x - width / 2, 0.24 * width, width / STROKES];
  let data = `M${pixel(left)} ${pixel(top)}h${pixel(width)}`;
  for (let k = 1; k <= STROKES; k++)
    data += `M${pixel(left + k * step)} ${pixel(top)}l${pixel(-deep)} ${pixel(deep)}`;
  /** Two legs from the pivot's rim to the ground. @param {number} side */
  const leg = (side) => `M${pixel(x + 3.2 * side)} ${pixel(y + 5)}L${pixel(x + 6.5 * side)} ${pixel(top)}`;
  return data + leg(-1) + leg(1);
}
