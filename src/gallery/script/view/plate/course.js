// A circuit as a course to travel: places on it by part, 0 at its beginning and 1 at its end, and by pass and
// input.
//
// Equal parts are equal times of play: the input goes evenly, and slows down towards limits, as a hand would
// move it, so that no joint leaps there.

import { easedInput } from "../../kinematics/spacing.js";

/**
 * The course of a circuit { passes, closed }: { passes, closed, starts }, `starts` being the part each pass
 * begins at.
 */
export function courseOf({ passes, closed }) {
  const lengths = passes.map(({ from, to }) => Math.abs(to - from));
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const starts = new Float64Array(passes.length + 1);
  lengths.forEach((length, k) => {
    starts[k + 1] = whole > 0 ? starts[k] + length / whole : (k + 1) / passes.length;
  });
  starts[passes.length] = 1;
  return { passes, closed, starts, whole };
}

/** Puts { pass, input } of a part of a course into `place`: the place of the pass, and its input. */
export function placeAtPart({ passes, starts }, part, place) {
  let k = 0;
  while (k < passes.length - 1 && part >= starts[k + 1]) k += 1;
  const share = (part - starts[k]) / (starts[k + 1] - starts[k]);
  place.pass = k;
  if (share <= 0) place.input = passes[k].from;
  else if (share >= 1) place.input = passes[k].to;
  else place.input = easedInput(passes[k], share);
  return place;
}

/** The part of a course at which a pass has an input. */
export function partOfInput({ passes, starts }, k, input) {
  const { from, to, begin, end } = passes[k];
  const eased = to === from ? 0 : Math.min(Math.max((input - from) / (to - from), 0), 1);
  const [fromFlat, toFlat] = [begin.flat !== 0, end.flat !== 0];
  let share = eased;
  if (fromFlat && toFlat) share = Math.acos(1 - 2 * eased) / Math.PI;
  else if (fromFlat) share = Math.acos(1 - eased) / (Math.PI / 2);
  else if (toFlat) share = Math.asin(eased) / (Math.PI / 2);
  return starts[k] + (starts[k + 1] - starts[k]) * share;
}

/** The places where the input turns round, or may not go on, as parts of the course; of a full turn none. */
export function turningParts({ passes, closed, starts }) {
  const parts = [];
  passes.forEach((pass, k) => {
    const before = passes[k - 1] ?? (closed ? passes[passes.length - 1] : null);
    const heading = (one) => Math.sign(one.to - one.from);
    if (!before || heading(before) !== heading(pass)) parts.push(starts[k]);
  });
  if (!closed) parts.push(1);
  return parts;
}

/** A part brought back onto the course: round a closed one, to the ends of another. */
export function heldPart({ closed }, part) {
  return closed ? part - Math.floor(part) : Math.min(Math.max(part, 0), 1);
}

/**
 * Moves a place { pass, input } of a course towards the input `wanted`, which a hand on the crank asks for,
 * and returns `wanted` as it is then to be counted, whole turns having been taken off. Over the end of a pass
 * it goes on to the next one. Where the input turns round there, it stays at the limit; a hand that goes
 * `slack` beyond comes back on the other branch. `place.isBeyond` remembers that it has.
 */
export function followedInput(course, place, wanted, slack) {
  const { passes, closed } = course;
  let want = wanted;
  for (let guard = 0; guard <= passes.length + 1; guard++) {
    const pass = passes[place.pass];
    const [low, high] = pass.from < pass.to ? [pass.from, pass.to] : [pass.to, pass.from];
    if (want >= low && want <= high) {
      place.input = want;
      place.isBeyond = false;
      return want;
    }
    const edge = want > high ? high : low;
    const forward = edge === pass.to;
    place.input = edge;
    const next = neighbouringPass(passes, place.pass, forward, closed);
    if (next === null) return want;
    const meets = forward ? passes[next].from : passes[next].to;
    const away = forward ? passes[next].to : passes[next].from;
    if (Math.sign(away - meets) === Math.sign(want - edge)) {
      // The motion goes on the same way: the seam of a turn, or a change point.
      want -= edge - meets;
      place.pass = next;
      place.input = meets;
      continue;
    }
    if (!place.isBeyond && Math.abs(want - edge) > slack) {
      place.pass = next;
      place.input = meets;
      place.isBeyond = true;
      want -= edge - meets;
    }
    return want;
  }
  return want;
}

function neighbouringPass(passes, k, forward, closed) {
  const next = k + (forward ? 1 : -1);
  if (next >= 0 && next < passes.length) return next;
  return closed ? (next + passes.length) % passes.length : null;
}

/**
 * The part of a course, within `reach` of a part, at which a distance is least: `distance(part)` is asked for
 * on parts of the course. A hand that drags a joint goes on along its path so.
 */
export function nearestPart(course, from, distance, reach = 0.15) {
  const STEPS = 24;
  const at = (part) => distance(heldPart(course, part));
  const [low, high] = course.closed
    ? [from - reach, from + reach]
    : [Math.max(from - reach, 0), Math.min(from + reach, 1)];
  const step = (high - low) / (2 * STEPS);
  let best = from;
  let least = at(from);
  for (let k = 0; k <= 2 * STEPS; k++) {
    const part = low + k * step;
    const far = at(part);
    if (far < least) [best, least] = [part, far];
  }
  let [a, b] = [best - step, best + step];
  const GOLDEN = (Math.sqrt(5) - 1) / 2;
  for (let k = 0; k < 24; k++) {
    const [c, d] = [b - GOLDEN * (b - a), a + GOLDEN * (b - a)];
    if (at(c) < at(d)) b = d;
    else a = c;
  }
  const middle = (a + b) / 2;
  return heldPart(course, at(middle) < least ? middle : best);
}
