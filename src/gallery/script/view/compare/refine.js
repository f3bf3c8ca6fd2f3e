// Curves laid over one another as the page's own solver has them, in place of the points of the data.

import { placed } from "../../shape/similarity.js";
import { solveCurveOrNull } from "../curve-reading.js";

// The chord error of a curve in the picture, in its pixels.
const REFINED_ERROR = 0.05;

/**
 * Draws the curves of a picture (overlaidPicture) anew as they are solved, one after another, so that the page
 * stays awake: `curves` are [{ family, curve }] and `laid` what alignCurve() has of each. Gives a function that
 * stops it.
 */
export function refinePicture(picture, curves, aligned) {
  let waiting = 0;
  const next = (k) => {
    const { family, curve } = curves[k];
    const { similarity } = aligned[k];
    const enlarged = picture.scale * Math.hypot(similarity.re, similarity.im);
    const solved = solveCurveOrNull(family, curve, REFINED_ERROR / enlarged);
    if (solved) picture.redraw(k, placed(similarity, solved.path.points));
    if (k + 1 < curves.length) waiting = window.setTimeout(() => next(k + 1));
  };
  if (curves.length) waiting = window.setTimeout(() => next(0));
  return () => window.clearTimeout(waiting);
}
