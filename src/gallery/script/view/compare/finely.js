// Curves laid over one another as the page's own solver has them, in place of the points of the data.

import { transformed } from "../../shape/similarity.js";
import { solvedOrNull } from "../hover-reading.js";

// The chord error of a curve in the picture, in its pixels.
const OVER_ERROR = 0.05;

/**
 * Draws the curves of a picture (overPicture) anew as they are solved, one after another, so that the page
 * stays awake: `curves` are [{ family, curve }] and `laid` what laidOver() has of each. Gives a function that
 * stops it.
 */
export function drawnFinely(picture, curves, laid) {
  let waiting = 0;
  const next = (k) => {
    const { family, curve } = curves[k];
    const { similarity } = laid[k];
    const enlarged = picture.scale * Math.hypot(similarity.re, similarity.im);
    const solved = solvedOrNull(family, curve, OVER_ERROR / enlarged);
    if (solved) picture.redraw(k, transformed(similarity, solved.path.points));
    if (k + 1 < curves.length) waiting = window.setTimeout(() => next(k + 1));
  };
  if (curves.length) waiting = window.setTimeout(() => next(0));
  return () => window.clearTimeout(waiting);
}
