// Draws the dial of the transmission angle: a half circle from 0 on the right to 180 on the left.

import { pixel } from "./path-data.js";

/** The position of an angle in degrees at a radius about the dial's centre, [X, Y], y down. */
function dialPlace([cx, cy], radius, deg) {
  const angle = (deg * Math.PI) / 180;
  return [cx + radius * Math.cos(angle), cy - radius * Math.sin(angle)];
}

/** Path data of the arc from one angle to a greater one. */
export function dialArc(centre, radius, from, to) {
  const [x0, y0] = dialPlace(centre, radius, from).map(pixel);
  const [x1, y1] = dialPlace(centre, radius, to).map(pixel);
  return `M${x0} ${y0}A${radius} ${radius} 0 ${to - from > 180 ? 1 : 0} 0 ${x1} ${y1}`;
}

/** Path data of a line along a radius. */
export function dialStroke(centre, inner, outer, deg) {
  const [x0, y0] = dialPlace(centre, inner, deg).map(pixel);
  const [x1, y1] = dialPlace(centre, outer, deg).map(pixel);
  return `M${x0} ${y0}L${x1} ${y1}`;
}

/** Path data of the sector between two angles and two radii. */
export function dialField(centre, inner, outer, from, to) {
  const [x1, y1] = dialPlace(centre, inner, to).map(pixel);
  const [x0, y0] = dialPlace(centre, inner, from).map(pixel);
  const large = to - from > 180 ? 1 : 0;
  return `${dialArc(centre, outer, from, to)}L${x1} ${y1}A${inner} ${inner} 0 ${large} 1 ${x0} ${y0}Z`;
}
