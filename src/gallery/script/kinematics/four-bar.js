// The four-bar in a linkage: its lengths, its class and type, and its transmission angle.

import { degreesOf } from "./angles.js";
import { lengthTolerance, linkLength, placeOnLink } from "./linkage.js";

/**
 * The four-bar in a linkage, { frame, crank, coupler, rocker, class, type, shortest, joints: { o, a, b, c }
 * }, the joints being crank pivot, crank pin, rocker pin and rocker pivot; null where its moving joints are
 * other than a crank, one dyad on crank pin and frame, rigid points, and parallelograms attached to them.
 *
 * Seen from another link than the fixed one, that link is the frame, the link opposite it the coupler, and
 * the crank the link at the origin of the view. `class` is Grashof's (Natesan, table 3.1), `type` McCarthy's
 * (table 2.2).
 */
export function fourBarOf(linkage) {
  const pins = fourBarPins(linkage);
  if (!pins) return null;
  const [o, a, b, c] = pins;
  const lengths = [
    linkLength(linkage, o, c),
    linkLength(linkage, o, a),
    linkLength(linkage, a, b),
    linkLength(linkage, b, c),
  ];
  if (lengths.includes(null)) return null;
  const [frame, crank, coupler, rocker] = lengths;
  const bar = { frame, crank, coupler, rocker };
  const shortest = Object.keys(bar).reduce((best, name) => (bar[name] < bar[best] ? name : best));
  return { ...bar, class: grashofClass(bar), type: mccarthyType(bar), shortest, joints: { o, a, b, c } };
}

/** Whether a joint is on the coupler of a four-bar of a linkage. */
export function isOnCoupler(linkage, { joints: { a, b } }, joint) {
  return linkage.links.some((link) => [joint, a, b].every((other) => placeOnLink(link, other)));
}

function fourBarPins({ joints, links, seenFrom }) {
  let [crank, dyad] = [null, null];
  for (const [id, { step }] of joints.entries()) {
    if (step.kind === "crank" && !crank) crank = { a: id, o: step.pivot };
    else if (step.kind === "dyad" && !dyad) dyad = { b: id, base: step.base };
    else if (!["fixed", "rigid", "parallelogram"].includes(step.kind)) return null;
  }
  if (!crank || !dyad || !dyad.base.includes(crank.a)) return null;
  const c = dyad.base[0] === crank.a ? dyad.base[1] : dyad.base[0];
  if (!placeOnLink(links[0], c)) return null;
  const round = [crank.o, crank.a, dyad.b, c];
  if (!seenFrom) return round;
  // From the origin of the view round the loop, away from the joint on its x-axis.
  const at = round.indexOf(seenFrom[0]);
  if (at < 0) return null;
  const [next, opposite, last] = [1, 2, 3].map((k) => round[(at + k) % 4]);
  if (seenFrom[1] === last) return [seenFrom[0], next, opposite, last];
  return seenFrom[1] === next ? [seenFrom[0], last, opposite, next] : null;
}

/**
 * Grashof's class of lengths { frame, crank, coupler, rocker }. Lengths whose sums agree to within a few
 * units in the last place make a change point: they are meant to be equal.
 */
function grashofClass({ frame, crank, coupler, rocker }) {
  const [shortest, la, lb, longest] = [frame, crank, coupler, rocker].sort((a, b) => a - b);
  const excess = longest - lb - (la - shortest);
  if (Math.abs(excess) <= lengthTolerance(longest + shortest + la + lb)) return "change-point";
  if (excess > 0) return "triple-rocker";
  if (frame === shortest) return "drag-link";
  return coupler === shortest ? "double-rocker" : "crank-rocker";
}

/** McCarthy's type, by the signs that say whether the limits of input and output exist (table 2.2). */
function mccarthyType({ frame: g, crank: a, coupler: h, rocker: b }) {
  const tolerance = lengthTolerance(g + a + h + b);
  const signs = [g - a + (h - b), g - a - (h - b), h - a - (g - b)];
  if (signs.some((sign) => Math.abs(sign) <= tolerance)) return "change-point";
  const types = {
    "+++": "crank-rocker",
    "+--": "rocker-crank",
    "--+": "double-crank",
    "-+-": "double-rocker",
    "---": "00 double-rocker",
    "++-": "0π double-rocker",
    "+-+": "π0 double-rocker",
    "-++": "ππ double-rocker",
  };
  return types[signs.map((sign) => (sign > 0 ? "+" : "-")).join("")];
}

/** Whether a four-bar is driven by its coupler; then the transmission angles at both its pins count. */
export function isCouplerDriven(linkage, { joints: { a, b } }) {
  return linkage.joints.some(({ step }, id) => {
    const ends = [step.pivot, id];
    return step.kind === "crank" && ends.includes(a) && ends.includes(b);
  });
}

/**
 * The transmission angles of a four-bar in a pose, in degrees from 0 to 180: { mu, atRocker, atCrank }.
 * `atRocker` is that at the rocker's pin between coupler and rocker, `atCrank` that at the crank's where the
 * coupler drives, else null; `mu` is the worse of them, further from 90.
 */
export function transmissionAt(linkage, fourBar, pose) {
  const { o, a, b, c } = fourBar.joints;
  const angle = (from, pin, to) => {
    const [ux, uy] = [pose[2 * from] - pose[2 * pin], pose[2 * from + 1] - pose[2 * pin + 1]];
    const [vx, vy] = [pose[2 * to] - pose[2 * pin], pose[2 * to + 1] - pose[2 * pin + 1]];
    return Math.abs(degreesOf(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy)));
  };
  const atRocker = angle(a, b, c);
  const atCrank = linkage.seenFrom && isCouplerDriven(linkage, fourBar) ? angle(o, a, b) : null;
  const isWorse = atCrank !== null && Math.abs(atCrank - 90) > Math.abs(atRocker - 90);
  return { mu: isWorse ? atCrank : atRocker, atRocker, atCrank };
}
