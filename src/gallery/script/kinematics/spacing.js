// Spaces samples unevenly in the input: dense towards limits, or even along the path.

import { passLength } from "./pass.js";
import { posesAt } from "./poses.js";

/**
 * The input at a part of a pass, dense towards the ends where a dyad lies flat: there a joint's place goes
 * with the root of the input, and this makes it go evenly.
 */
export function easedInput(pass, part) {
  const [fromFlat, toFlat] = [pass.begin.flat !== 0, pass.end.flat !== 0];
  let eased = part;
  if (fromFlat && toFlat) eased = (1 - Math.cos(Math.PI * part)) / 2;
  else if (fromFlat) eased = 1 - Math.cos((Math.PI / 2) * part);
  else if (toFlat) eased = Math.sin((Math.PI / 2) * part);
  return pass.from + (pass.to - pass.from) * eased;
}

/**
 * The cumulative length of a joint's path over a pass, by chords: { whole, part(share) }, the total length,
 * and the part of the pass, an argument of easedInput, at which a share of that length is reached.
 */
export function cumulativeLength(linkage, pass, joint) {
  const CHORDS = 2048;
  const parts = Array.from({ length: CHORDS + 1 }, (_, i) => i / CHORDS);
  const places = posesAt(
    linkage,
    pass,
    parts.map((part) => easedInput(pass, part)),
  );
  const [x, y] = [places.x[joint], places.y[joint]];
  const lengths = [0];
  for (let i = 1; i <= CHORDS; i++) {
    const [dx, dy] = [x[i] - x[i - 1], y[i] - y[i - 1]];
    const chord = Math.sqrt(dx * dx + dy * dy);
    // A place that is undefined adds nothing.
    lengths.push(lengths[i - 1] + (Number.isFinite(chord) ? chord : 0));
  }
  const whole = lengths[CHORDS];
  const part = (share) => {
    const length = share * whole;
    let i = lengths.findIndex((l) => !(l < length));
    i = Math.min(Math.max(i < 0 ? CHORDS : i, 1), CHORDS);
    const [before, after] = [lengths[i - 1], lengths[i]];
    const over = after > before ? (length - before) / (after - before) : 1;
    return parts[i - 1] + (parts[i] - parts[i - 1]) * over;
  };
  return { whole, part, length: passLength(pass) };
}
