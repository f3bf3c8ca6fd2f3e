// The axes of the target.

import { planePoint, roundBelow, screenPoint } from "../../draw/plane-view.js";
import { s } from "../dom.js";
import { formatNumber } from "../labels.js";

/** The lines of the axes, at round numbers, with these. @param {Placement} view @param {Size} frame */
export function axisLines(view, { width, height }) {
  const step = roundBelow(110 / view.scale);
  const [x0, y0] = planePoint(view, [0, height]);
  const [x1, y1] = planePoint(view, [width, 0]);
  /** @param {number} from @param {number} to @param {(value: number) => Element[]} draw */
  const lines = (from, to, draw) =>
    Array.from({ length: Math.floor(to / step) - Math.ceil(from / step) + 1 }, (_, k) =>
      draw((Math.ceil(from / step) + k) * step),
    );
  /** @param {number} x @param {number} y @param {number} value */
  const text = (x, y, value) => s("text", { x, y }, formatNumber(value));
  const across = lines(x0, x1, (value) => {
    const [x] = screenPoint(view, [value, 0]);
    return [s("path.grid", { d: `M${x} 0V${height}` }), text(x + 3, height - 4, value)];
  });
  const up = lines(y0, y1, (value) => {
    const [, y] = screenPoint(view, [0, value]);
    return [s("path.grid", { d: `M0 ${y}H${width}` }), text(3, y - 3, value)];
  });
  return [across, up];
}
