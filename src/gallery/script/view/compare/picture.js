// Curves over one another, told apart by ink, dashes and letters.

import { s } from "../dom.js";
import { framing, pathThrough } from "../shape/overlay.js";

const OVER_WIDE = 720;
const OVER_LOW = 240;
const OVER_HIGH = 540;

/** The letter of the k-th curve, from 0. */
export function letterOf(k) {
  return String.fromCharCode(65 + k);
}

/** The class of the k-th curve's line: an ink and a dash of its own. */
export function strokeOf(k) {
  return `compared ink-${(k % 5) + 1} dash-${k % 6}`;
}

/** A picture of outlines, [{ points, closed }], over one another, each with its letter. */
export function overPicture(outlines, label) {
  const all = outlines.map(({ points }) => points);
  const high = heightFor(all);
  const view = framing(all, OVER_WIDE, high);
  const mark = ({ points }, k) => {
    // Letters stand at different places of curves that lie over one another.
    const at = 2 * Math.floor(((k + 0.5) / outlines.length) * (points.length / 2));
    return s(
      "text",
      {
        class: `letter ink-${(k % 5) + 1}`,
        x: (view.x + view.scale * points[at]).toFixed(1),
        y: (view.y - view.scale * points[at + 1] - 5).toFixed(1),
      },
      letterOf(k),
    );
  };
  return s(
    "svg",
    { class: "thumbnail over", viewBox: `0 0 ${OVER_WIDE} ${high}`, role: "img", "aria-label": label },
    outlines.map(({ points, closed }, k) =>
      s("path", { class: strokeOf(k), d: pathThrough(points, closed, view) }),
    ),
    outlines.map(mark),
  );
}

/** As high as the outlines need at full width, within bounds. */
function heightFor(outlines) {
  const side = (part) => {
    const values = outlines.flatMap((points) => Array.from(points).filter((_, k) => k % 2 === part));
    return (
      values.reduce((most, value) => Math.max(most, value), -Infinity) -
      values.reduce((least, value) => Math.min(least, value), Infinity)
    );
  };
  const wanted = (OVER_WIDE * side(1)) / (side(0) || 1) + 40;
  return Math.round(Math.min(Math.max(wanted, OVER_LOW), OVER_HIGH));
}

/** A short line as the k-th curve's is. */
export function strokeSample(k) {
  return s(
    "svg",
    { class: "thumbnail sample", width: 44, height: 12, "aria-hidden": "true" },
    s("path", { class: strokeOf(k), d: "M2 6H42" }),
  );
}
