// Finds the inputs at which one two-valued joint can be placed: where its dyad is neither too short nor too
// long. If a dyad connects a point of the crank's link to the frame, its limits have a closed form; for any
// other they are searched.

import { inputPosition } from "./positions.js";
import { lengthTolerance, placeOnLink } from "./linkage.js";
import { extentRange, searchClosingSpans } from "./limit-search.js";
import { rangeEnd, endFromFlatDyad, intersectSpans } from "./span.js";
import { closedFormSpans, extentFromBaseLength, extentFromProjection } from "./closed-form.js";

/**
 * The parts of a span where a dyad closes, given the sides of the dyads before it: { parts, reason }, with
 * the reason why there are none. `nextId` gives the numbers of new ends.
 */
export function closingSpans(linkage, index, span, signs, nextId) {
  const dyad = dyadOf(linkage, index);
  let parts;
  if (dyad.step.kind === "piston") {
    parts = intersectSpans(span, strokeOfPiston(linkage, dyad, nextId), 0, linkage.input);
  } else if (dyad.swing) {
    parts = intersectSpans(span, closedFormSpans(dyad.swing, index, nextId), 3, linkage.input);
  } else {
    parts = searchClosingSpans(linkage, dyad, span, signs, nextId);
  }
  return { parts, reason: parts.length > 0 ? null : shortfallOfDyad(linkage, dyad, span, signs) };
}

// A two-valued joint, { joint, index, step, bounds, vanishes, swing }. Its extent, the length of its base or,
// of a slide, how far its line runs to the left of the joint its link hangs on, must lie within its bounds
// for the dyad to close.
function dyadOf(linkage, index) {
  const joint = linkage.joints.findIndex(({ step }) => step.index === index && step.kind !== "directed");
  const { step } = linkage.joints[joint];
  // Whether its joint is not determined where its base vanishes: it is placed by continuity there.
  const vanishes = step.kind === "dyad" || (step.kind === "slot" && step.offset === 0);
  const dyad = { joint, index, step, bounds: boundsOfStep(step), vanishes };
  return { ...dyad, swing: swingOfDyad(linkage, dyad) };
}

function boundsOfStep({ kind, lengths, offset, length }) {
  if (kind === "dyad") return [Math.abs(lengths[0] - lengths[1]), lengths[0] + lengths[1]];
  if (kind === "slot") return [Math.abs(offset), Infinity];
  return kind === "slide" ? [-length, length] : [0, 0];
}

// What a piston's length can be: from where crank and frame are folded, or from nothing, to where they are
// stretched.
function strokeOfPiston(linkage, { index, step }, nextId) {
  const { base, length, offset } = step;
  const [c, o] = base.map((joint) => placeOnLink(linkage.links[0], joint));
  if (!c || !o) return [];
  const frame = Math.sqrt((c.x - o.x) * (c.x - o.x) + (c.y - o.y) * (c.y - o.y));
  const leg = (b) => Math.sqrt(Math.max((b - offset) * (b + offset), 0));
  const [folded, stretched] = [leg(Math.abs(frame - length)), leg(frame + length)];
  const end = (at) => {
    const stop = inputPosition(linkage.input, at);
    return at > 0 ? endFromFlatDyad(stop, "limit", index, nextId()) : rangeEnd(stop, nextId());
  };
  return folded < stretched ? [{ lower: end(folded), upper: end(stretched) }] : [];
}

// The extent as the projection or the length of an arm that turns with the crank; null where it is none.
function swingOfDyad(linkage, { step, bounds }) {
  if (linkage.input.isLength || linkage.input.period !== 360) return null;
  const crank = linkage.joints.findIndex((joint) => joint.step.kind === "crank");
  if (crank < 0) return null;
  const { pivot } = linkage.joints[crank].step;
  const [frame, ...moving] = linkage.links;
  const pivotPlace = placeOnLink(frame, pivot);
  const arm = moving.find((link) => placeOnLink(link, pivot) && placeOnLink(link, crank));
  if (!pivotPlace || !arm) return null;
  if (step.kind === "slide") return swingOfSlide(step, bounds, frame, arm, pivotPlace);
  if (step.kind !== "dyad" && step.kind !== "slot") return null;
  for (const [p, q] of [step.base, [step.base[1], step.base[0]]]) {
    const [onArm, fixed] = [placeOnLink(arm, p), placeOnLink(frame, q)];
    if (onArm && fixed) {
      return extentFromBaseLength(
        [onArm.x, onArm.y],
        [fixed.x - pivotPlace.x, fixed.y - pivotPlace.y],
        bounds,
      );
    }
  }
  return null;
}

function swingOfSlide({ from, line, offset }, bounds, frame, arm, pivot) {
  const onArm = placeOnLink(arm, from);
  const [p, q] = line.map((joint) => placeOnLink(frame, joint));
  if (!onArm || !p || !q) return null;
  const [dx, dy] = [q.x - p.x, q.y - p.y];
  const d = Math.sqrt(dx * dx + dy * dy);
  const [ux, uy] = [dx / d, dy / d];
  const distance = offset - (ux * (pivot.y - p.y) - uy * (pivot.x - p.x));
  return extentFromProjection([onArm.x, onArm.y], [-uy, ux], distance, bounds);
}

/** Why a linkage is not assembled if its positions, or their squares, overflow. */
export const OUT_OF_RANGE_REASON = "its lengths are too large or too small for double precision";

// Why a dyad closes nowhere in a span, in a sentence.
function shortfallOfDyad(linkage, dyad, span, signs) {
  const { joint, step, swing, bounds } = dyad;
  const [low, high] = bounds;
  const nameOf = (id) => linkage.joints[id].name;
  const name = nameOf(joint);
  if (step.kind === "piston") return `${name} cannot be placed by an actuator of any length in the range`;
  const isWhole = swing && !span.lower;
  const [least, greatest] = isWhole ? swing.extent : extentRange(linkage, dyad, span, signs);
  const size = Number.isFinite(high) ? Math.max(Math.abs(greatest), high) : Math.abs(greatest);
  if (!(size * size >= 2 ** -1022 && size * size < Infinity)) return OUT_OF_RANGE_REASON;
  if (step.kind === "slide") {
    const nearest = shortNumber(least > 0 ? least : -greatest);
    const link = shortNumber(step.length);
    const stays = `its line stays ${nearest} or more from ${nameOf(step.from)}`;
    return `${name} cannot be placed: ${stays}, and the link of ${link} is too short`;
  }
  const [from, to] = step.base.map(nameOf);
  const bases = `${name} cannot be placed: ${from} and ${to}`;
  if (step.kind === "slot") {
    return `${bases} are ${shortNumber(greatest)} or less apart, and the offset is ${shortNumber(low)}`;
  }
  const [l0, l1] = step.lengths.map(shortNumber);
  if (greatest <= low && greatest <= lengthTolerance(high)) {
    return `${name} has no position: ${from} and ${to} coincide throughout`;
  }
  const links = `links of ${l0} and ${l1}`;
  if (least >= high) {
    return `${bases} are ${shortNumber(least)} or more apart, ${links} reach ${shortNumber(high)}`;
  }
  if (greatest <= low) {
    return `${bases} are ${shortNumber(greatest)} or less apart, ${links} need ${shortNumber(low)}`;
  }
  return `${name} cannot be placed: ${links} never span the distance of ${from} and ${to} in the range`;
}

// Up to six significant digits.
function shortNumber(x) {
  return String(Number(x.toPrecision(6)));
}
