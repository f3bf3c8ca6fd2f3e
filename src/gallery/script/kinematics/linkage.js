// A linkage in numbers, with its motion options, and queries of it.
//
// { joints: [{name, step}], links: [[{joint, x, y}]], traced: [joint], seenFrom: [origin, end]|null,
//   placement: {mirror, cos, sin}, dyads, input: {isLength, period},
//   travel: {signs, start, range, circuits, continuation, coincident, arc} }
//
// Joints are in the order they are placed: each step refers to earlier joints only. The first link is the
// frame. A step is { kind, … } as LinkageBuilder makes it; `index` is a two-valued joint's place among them.

/** The position of a joint in a link's own frame, { joint, x, y }; undefined if it is not on the link. */
export function placeOnLink(link, joint) {
  return link.find((place) => place.joint === joint);
}

/** The distance of two joints of one link; null where no link has both. */
export function linkLength(linkage, from, to) {
  for (const link of linkage.links) {
    const [a, b] = [placeOnLink(link, from), placeOnLink(link, to)];
    if (a && b) return Math.sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  return null;
}

/** The link that is at rest for the observer: the one seen from, or the one the fixed joints are on. */
export function groundOf(linkage) {
  const isSeenFrom = (link) => linkage.seenFrom?.every((joint) => placeOnLink(link, joint));
  return (linkage.seenFrom && linkage.links.find(isSeenFrom)) ?? linkage.links[0];
}

/** Sums of lengths closer than this are equal: a few units in the last place of the sum of all. */
export function lengthTolerance(sum) {
  return 4 * Number.EPSILON * sum;
}

/** The factor of angles: 1, or -1 if the placement mirrors the linkage. */
export function handednessOf(linkage) {
  return linkage.placement.mirror ? -1 : 1;
}

/**
 * The input of joints: { isLength, period }, the period in degrees after which every joint is where it was.
 */
export function inputOfJoints(joints) {
  let turns = 1;
  for (const { step } of joints) {
    // A length never comes round: its period is beyond all lengths.
    if (step.kind === "piston") return { isLength: true, period: Number.MAX_VALUE / 8 };
    if (step.kind === "gear") turns = (turns / greatestDivisor(turns, step.ratio[1])) * step.ratio[1];
  }
  return { isLength: false, period: 360 * turns };
}

/** The greatest common divisor of two positive whole numbers. */
export function greatestDivisor(a, b) {
  return b === 0 ? a : greatestDivisor(b, a % b);
}

/**
 * The linkage reduced to one of the points at its end that no other joint depends on, as { linkage, joint }:
 * to compute one point of many at many inputs without placing the others. The joints before those points keep
 * their indices.
 */
export function singlePointLinkage(linkage, joint) {
  let first = linkage.joints.length;
  let base = linkage.seenFrom ? Math.max(...linkage.seenFrom) : 0;
  while (first > 0 && linkage.joints[first - 1].step.kind === "rigid") {
    base = Math.max(base, ...linkage.joints[first - 1].step.base);
    if (base >= first - 1) break;
    first -= 1;
  }
  if (first >= linkage.joints.length) return { linkage, joint };
  const kept = (id) => id < first || id === joint;
  const renamed = (id) => Math.min(id, first);
  const joints = linkage.joints.filter((_, id) => kept(id));
  const links = linkage.links.map((link) =>
    link.filter((place) => kept(place.joint)).map((place) => ({ ...place, joint: renamed(place.joint) })),
  );
  return { linkage: { ...linkage, joints, links, traced: [renamed(joint)] }, joint: renamed(joint) };
}
