// Computes limits in closed form, of an extent that is a sinusoid of the input (McCarthy 2.53, Natesan
// 4.3-4.9).

import { degreesOf } from "./angles.js";
import { lengthTolerance } from "./linkage.js";
import { endWithFlatDyad, endFromFlatDyad, shiftedEnd } from "./span.js";

/**
 * The length of a base with one end on an arm and the other fixed, `toFixed` from the arm's pivot, both [x,
 * y]; `bounds` are the least and the greatest it may be.
 */
export function extentFromBaseLength(onArm, toFixed, [low, high]) {
  const fixed = vectorLength(toFixed);
  const arm = vectorLength(onArm);
  const [nearest, furthest] = [Math.abs(fixed - arm), fixed + arm];
  const product = 2 * fixed * arm;
  const isFinite = Number.isFinite(high);
  const tolerance = lengthTolerance(furthest + (isFinite ? high : low));
  return {
    towards: directionQuotient(toFixed, onArm),
    extent: [nearest, furthest],
    margins: [nearest - low, high - furthest],
    // Differences of squares are factored: the factors are exact, and the product is accurate when small.
    versines: [low, isFinite ? high : furthest].map((bound) => [
      ((bound - nearest) * (bound + nearest)) / product,
      ((furthest - bound) * (furthest + bound)) / product,
    ]),
    overlaps: [high - nearest, furthest - low],
    tolerance,
    mayVanish: nearest <= tolerance,
  };
}

/** `offset` less the projection of an arm on a fixed direction, both [x, y]. */
export function extentFromProjection(onArm, normal, offset, [low, high]) {
  const arm = vectorLength(onArm);
  const [least, greatest] = [offset - arm, offset + arm];
  return {
    towards: directionQuotient(normal, onArm),
    extent: [least, greatest],
    margins: [least - low, high - greatest],
    versines: [low, high].map((bound) => [(bound - least) / arm, (greatest - bound) / arm]),
    overlaps: [high - least, greatest - low],
    tolerance: lengthTolerance(Math.abs(offset) + arm + high),
    mayVanish: false,
  };
}

/**
 * The spans of the whole turn on which a dyad closes. What is compared at 0 and at 180 degrees is a sum of
 * lengths with a sum of lengths; equal within their rounding, they make a change point.
 */
export function closedFormSpans(swing, dyad, nextId) {
  if (swing.overlaps.some((overlap) => overlap <= swing.tolerance)) return [];
  const [fold, stretch] = swing.margins.map((margin) => boundState(margin, swing.tolerance));
  // The smaller of 1 - cos and 1 + cos is the exact one, and both make the sine.
  const direction = ([minus, plus]) => [
    minus < plus ? 1 - minus : plus - 1,
    Math.sqrt(Math.max(minus * plus, 0)),
  ];
  const [inner, outer] = swing.versines.map(direction);
  const limit = ([cos, sin]) => endFromFlatDyad(inputOfExtent(swing, cos, sin), "limit", dyad, nextId());
  const change = (cos) => {
    const end = endFromFlatDyad(inputOfExtent(swing, cos, 0), "change", dyad, nextId());
    return cos > 0 ? endWithFlatDyad(end, dyad, swing.mayVanish) : end;
  };
  // Both ends are within half a turn of `towards`; the upper one follows the lower.
  const arc = (lower, upper) => ({ lower, upper: upper.at > lower.at ? upper : shiftedEnd(upper, 360) });
  const mirrored = ([cos, sin]) => [cos, -sin];
  const lowest = fold === "shut" ? limit(inner) : null;
  switch (`${fold} ${stretch}`) {
    case "open open":
      return [{ lower: null, upper: null }];
    case "touched open": {
      const near = change(1);
      return [arc(near, near)];
    }
    case "open touched": {
      const far = change(-1);
      return [arc(far, far)];
    }
    case "touched touched": {
      const [near, far] = [change(1), change(-1)];
      return [arc(near, far), arc(far, near)];
    }
    case "shut open":
      return [arc(lowest, limit(mirrored(inner)))];
    case "open shut":
      return [arc(limit(mirrored(outer)), limit(outer))];
    case "touched shut": {
      const near = change(1);
      return [arc(limit(mirrored(outer)), near), arc(near, limit(outer))];
    }
    case "shut touched": {
      const far = change(-1);
      return [arc(lowest, far), arc(far, limit(mirrored(inner)))];
    }
    default:
      return [arc(limit(mirrored(outer)), limit(mirrored(inner))), arc(lowest, limit(outer))];
  }
}

// The input whose angle from `towards` has this cosine and sine.
function inputOfExtent({ towards: [tx, ty] }, cos, sin) {
  // Both angles are exact where the arm starts on the frame line.
  const at = degreesOf(Math.atan2(ty, tx)) + degreesOf(Math.atan2(sin, cos));
  return { at, cos: tx * cos - ty * sin, sin: ty * cos + tx * sin };
}

// Whether a dyad can pass the shortest or the longest its base can be: where it is touched it lies flat, and
// can.
function boundState(margin, tolerance) {
  if (Math.abs(margin) <= tolerance) return "touched";
  return margin > 0 ? "open" : "shut";
}

function vectorLength([x, y]) {
  return Math.sqrt(x * x + y * y);
}

// The direction that turns b into the direction of a: their quotient, as of complex numbers.
function directionQuotient(a, b) {
  const product = vectorLength(a) * vectorLength(b);
  if (!(product > 0)) return [1, 0];
  return [(a[0] * b[0] + a[1] * b[1]) / product, (b[0] * a[1] - b[1] * a[0]) / product];
}
