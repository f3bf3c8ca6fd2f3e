// Redraws compared curves from the page's solver, in place of the stored points.

import { transformed } from "../../shape/similarity.js";
import { solveCurveOrNull } from "../curve-reading.js";

// The chord error of a curve, in picture pixels.
const REFINED_ERROR = 0.05;

/**
 * Redraws the curves of a picture (overlaidPicture) one after another as they are solved, without blocking
 * the page. `curves` are [{ family, curve }], `aligned` the results of alignCurve(). Returns a function that
 * stops it.
 */
export function refinePicture(picture, curves, aligned) {
  let waiting = 0;
  const next = (k) => {
    const { family, curve } = curves[k];
    const { similarity } = aligned[k];
    const enlarged = picture.scale * Math.hypot(similarity.re, similarity.im);
    const solved = solveCurveOrNull(family, curve, REFINED_ERROR / enlarged);
    if (solved) picture.redraw(k, transformed(similarity, solved.path.points));
    if (k + 1 < curves.length) waiting = window.setTimeout(() => next(k + 1));
  };
  if (curves.length) waiting = window.setTimeout(() => next(0));
  return () => window.clearTimeout(waiting);
}
