// Angles in degrees and radians. Right-handed axes, counter-clockwise positive.

/** Degrees to radians. */
export function radiansOf(deg) {
  return deg * (Math.PI / 180);
}

/** Radians to degrees. */
export function degreesOf(rad) {
  return rad * (180 / Math.PI);
}

/** What is left of `a` after whole periods: from 0 up to `period`. */
export function remainderOf(a, period) {
  const rest = a % period;
  return rest < 0 ? rest + Math.abs(period) : rest;
}

/**
 * Cosine and sine of an angle in degrees. The angle is first brought within 45 degrees of a quarter turn,
 * which is exact, so that quarter turns have exact zeros and ones and symmetric angles symmetric values.
 */
export function cosSinOfDegrees(deg) {
  const turn = remainderOf(deg, 360);
  const quarter = Math.floor((turn + 45) / 90);
  const rest = turn - 90 * quarter;
  const isDiagonal = Math.abs(rest) === 45;
  const c = isDiagonal ? Math.SQRT1_2 : Math.cos(radiansOf(rest));
  const s = isDiagonal ? Math.sign(rest) * Math.SQRT1_2 : Math.sin(radiansOf(rest));
  switch (quarter) {
    case 1:
      return [-s, c];
    case 2:
      return [-c, -s];
    case 3:
      return [s, -c];
    default:
      return [c, s];
  }
}
