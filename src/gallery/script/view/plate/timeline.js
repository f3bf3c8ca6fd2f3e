// A timeline over a circuit: positions are given by part, 0 at the start and 1 at the end, or by pass and
// input.
//
// Equal parts take equal time: the input is uniform but slows down towards limits, so that no joint jumps there.

/** The timeline of a circuit: `starts` has the part at which each pass starts, `whole` is the total input travel. @param {Circuit} _ */
export function timelineOf(/** @type {Circuit} */ { passes, closed }) {
  const lengths = passes.map(({ from, to }) => Math.abs(to - from));
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const starts = new Float64Array(passes.length + 1);
  lengths.forEach((length, k) => {
    starts[k + 1] = whole > 0 ? starts[k] + length / whole : (k + 1) / passes.length;
  });
  starts[passes.length] = 1;
  return { passes, closed, starts, whole };
}

/** Sets `place` to the pass index and the input at a part of a timeline. @param {number} part */
export function placeAtPart(/** @type {Timeline} */ { passes, starts }, part, /** @type {Place} */ place) {
  let k = 0;
  while (k < passes.length - 1 && part >= starts[k + 1]) k += 1;
  const share = (part - starts[k]) / (starts[k + 1] - starts[k]);
  place.pass = k;
  if (share <= 0) place.input = passes[k].from;
  else if (share >= 1) place.input = passes[k].to;
  else place.input = easedInput(passes[k], share);
  return place;
}

/**
 * The input at a part of a pass, dense towards the ends where two links are in line: there a joint's place goes
 * with the root of the input, and this makes it go evenly.
 * @param {number} part
 */
function easedInput(/** @type {Pass} */ { from, to, from_is_flat: fromFlat, to_is_flat: toFlat }, part) {
  let eased = part;
  if (fromFlat && toFlat) eased = (1 - Math.cos(Math.PI * part)) / 2;
  else if (fromFlat) eased = 1 - Math.cos((Math.PI / 2) * part);
  else if (toFlat) eased = Math.sin((Math.PI / 2) * part);
  return from + (to - from) * eased;
}

/** The part of a timeline at which a pass has an input. @param {Timeline} _ */
export function partOfInput({ passes, starts }, /** @type {number} */ k, /** @type {number} */ input) {
  const { from, to, from_is_flat: fromFlat, to_is_flat: toFlat } = passes[k];
  const eased = to === from ? 0 : Math.min(Math.max((input - from) / (to - from), 0), 1);
  let share = eased;
  if (fromFlat && toFlat) share = Math.acos(1 - 2 * eased) / Math.PI;
  else if (fromFlat) share = Math.acos(1 - eased) / (Math.PI / 2);
  else if (toFlat) share = Math.asin(eased) / (Math.PI / 2);
  return starts[k] + (starts[k + 1] - starts[k]) * share;
}

/** The limit positions, where the input reverses or ends, as parts of the timeline; none for a full rotation. */
export function turningParts(/** @type {Timeline} */ { passes, closed, starts }) {
  const parts = [];
  passes.forEach((pass, k) => {
    const before = passes[k - 1] ?? (closed ? passes[passes.length - 1] : null);
    const heading = (/** @type {Pass} */ one) => Math.sign(one.to - one.from);
    if (!before || heading(before) !== heading(pass)) parts.push(starts[k]);
  });
  if (!closed) parts.push(1);
  return parts;
}

/** Wraps a part onto a closed timeline, or clamps it to the ends of an open one. @param {Timeline} _ */
export function clampPart({ closed }, /** @type {number} */ part) {
  return closed ? part - Math.floor(part) : Math.min(Math.max(part, 0), 1);
}

/** Moves a place by an amount of input along a timeline, over limits and change points. @param {number} by */
export function stepPlace(/** @type {Timeline} */ timeline, /** @type {Place} */ place, by) {
  const { from, to } = timeline.passes[place.pass];
  const next = place.input + Math.sign(to - from) * by;
  if ((next - from) * (next - to) <= 0) place.input = next;
  else {
    const part = partOfInput(timeline, place.pass, place.input) + by / timeline.whole;
    placeAtPart(timeline, clampPart(timeline, part), place);
  }
}

/**
 * Moves a position { pass, input } of a timeline towards the input `wanted` of a dragged crank, and returns `wanted` less the full turns
 * that were completed. Continues over the end of a pass onto the next one. Where the input reverses, it stays at the limit; a drag more
 * than `slack` beyond returns on the other branch, which `place.isBeyond` records.
 * @param {number} wanted @param {number} slack
 */
export function followInput(/** @type {Timeline} */ timeline, /** @type {Place} */ place, wanted, slack) {
  const { passes, closed } = timeline;
  let target = wanted;
  for (let guard = 0; guard <= passes.length + 1; guard++) {
    const pass = passes[place.pass];
    const [low, high] = pass.from < pass.to ? [pass.from, pass.to] : [pass.to, pass.from];
    if (target >= low && target <= high) {
      place.input = target;
      place.isBeyond = false;
      return target;
    }
    const edge = target > high ? high : low;
    const forward = edge === pass.to;
    place.input = edge;
    const next = adjacentPass(passes, place.pass, forward, closed);
    if (next === null) return target;
    const meets = forward ? passes[next].from : passes[next].to;
    const away = forward ? passes[next].to : passes[next].from;
    // The motion may continue in the same direction: the seam of a rotation, or a change point.
    const isOn = Math.sign(away - meets) === Math.sign(target - edge);
    if (!isOn && (place.isBeyond || Math.abs(target - edge) <= slack)) return target;
    target -= edge - meets;
    place.pass = next;
    place.input = meets;
    if (isOn) continue;
    place.isBeyond = true;
    return target;
  }
  return target;
}

/** @param {number} k @param {boolean} forward @param {boolean} closed */
function adjacentPass(/** @type {Pass[]} */ passes, k, forward, closed) {
  const next = k + (forward ? 1 : -1);
  if (next >= 0 && next < passes.length) return next;
  return closed ? (next + passes.length) % passes.length : null;
}

/**
 * The part of a timeline, within `reach` of the part `from`, at which `distance(part)` is least; a dragged joint follows its path with it.
 * @param {number} from @param {(part: number) => number} distance
 */
export function nearestPart(/** @type {Timeline} */ timeline, from, distance, reach = 0.15) {
  const STEPS = 24;
  const at = (/** @type {number} */ part) => distance(clampPart(timeline, part));
  const [low, high] = timeline.closed
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
  return clampPart(timeline, at(middle) < least ? middle : best);
}
