// Draws the ground symbol of a fixed pivot: a line with hatching.

import { pixel } from "./path-data.js";

/** Path data of the ground symbol of a pivot at X, Y on the screen, `width` pixels wide. */
export function groundData(x, y, width = 22) {
  const STROKES = 4;
  const top = y + 0.5 * width;
  const [left, deep, step] = [x - width / 2, 0.24 * width, width / STROKES];
  let data = `M${pixel(left)} ${pixel(top)}h${pixel(width)}`;
  for (let k = 1; k <= STROKES; k++)
    data += `M${pixel(left + k * step)} ${pixel(top)}l${pixel(-deep)} ${pixel(deep)}`;
  // Two legs from the pivot's rim to the ground.
  const leg = (side) => `M${pixel(x + 3.2 * side)} ${pixel(y + 5)}L${pixel(x + 6.5 * side)} ${pixel(top)}`;
  return data + leg(-1) + leg(1);
}
