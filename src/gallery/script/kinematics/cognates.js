// The cognates of a four-bar: the three four-bars with one coupler curve (S. Roberts 1875, Chebyshev 1878).

import { fourBarOf, isOnCoupler } from "./four-bar.js";
import { handednessOf, lengthTolerance, placeOnLink } from "./linkage.js";

/**
 * The four-bar of a linkage with one of its joints as coupler point, and its two cognates: { thirdPivot: [x,
 * y], cognates: [three] } in the plane the linkage is reported in, the original first; null if it is not a
 * four-bar, or if the joint is not on its coupler or is a pin.
 *
 * A cognate is { pivots: [[x, y], [x, y]], lengths: { frame, crank, coupler, rocker }, point: [along, left],
 * turnsAs: [crank, coupler, rocker as "crank" | "coupler" | "rocker"], arms }: the pivots of its crank and
 * its rocker, the coupler point from its crank pin towards its rocker pin, and which links of the original
 * its own turn as.
 *
 * With lambda = (M - A) / (B - A) as complex numbers the third pivot is Q = O + lambda (C - O), and one loop
 * has the pivots O and Q and the links lambda (B - A), lambda (A - O), lambda (B - C), the other C and Q.
 */
export function cognatesOf(linkage, joint) {
  const original = placedFourBar(linkage, joint);
  if (!original) return null;
  const { frame: g, crank: r, coupler: h, rocker: s } = original.lengths;
  const u = original.point;
  const w = [u[0] - h, u[1]];
  const [near, far] = [Math.hypot(...u), Math.hypot(...w)];
  if (near <= 1e-12 * h || far <= 1e-12 * h) return null;
  const [o, c] = original.pivots;
  const lambda = u.map((x) => x / h);
  const rest = w.map((x) => -x / h);
  const offset = complexProduct(lambda, [c[0] - o[0], c[1] - o[1]]);
  const thirdPivot = [o[0] + offset[0], o[1] + offset[1]];
  const scaled = (by, crank, coupler, rocker) => ({
    frame: by * g,
    crank,
    coupler: by * coupler,
    rocker: by * rocker,
  });
  const first = {
    pivots: [o, thirdPivot],
    lengths: scaled(near / h, near, r, s),
    point: [u[0] * (r / near), -u[1] * (r / near)],
    turnsAs: ["coupler", "crank", "rocker"],
    arms: [lambda, lambda],
  };
  const second = {
    pivots: [c, thirdPivot],
    lengths: scaled(far / h, far, s, r),
    point: [-w[0] * (s / far), w[1] * (s / far)],
    turnsAs: ["coupler", "rocker", "crank"],
    arms: [rest.map((x) => -x), rest],
  };
  const one = [1, 0];
  const itself = { ...original, turnsAs: ["crank", "coupler", "rocker"], arms: [one, one] };
  return { thirdPivot, cognates: [itself, drivenCognate(first), drivenCognate(second)] };
}

/**
 * The crank pin and the rocker pin of a cognate, [ax, ay, bx, by], in a pose of the linkage it was made of.
 */
export function cognatePins(linkage, { pivots, turnsAs, arms }, pose) {
  const { o, a, b, c } = fourBarOf(linkage).joints;
  const between = (from, to) => [pose[2 * to] - pose[2 * from], pose[2 * to + 1] - pose[2 * from + 1]];
  const bars = { crank: between(o, a), coupler: between(a, b), rocker: between(c, b) };
  const pin = (k, bar) => {
    const arm = complexProduct(arms[k], bars[bar]);
    return [pivots[k][0] + arm[0], pivots[k][1] + arm[1]];
  };
  return [...pin(0, turnsAs[0]), ...pin(1, turnsAs[2])];
}

// The four-bar at its position in the plane, and its coupler point.
function placedFourBar(linkage, joint) {
  const fourBar = fourBarOf(linkage);
  if (!fourBar || !isOnCoupler(linkage, fourBar, joint)) return null;
  const { frame, crank, coupler, rocker } = fourBar;
  const { o, a, b, c } = fourBar.joints;
  const link = linkage.links.find((other) => placeOnLink(other, a) && placeOnLink(other, b));
  const [from, to, place] = [a, b, joint].map((id) => placeOnLink(link, id));
  if (!place) return null;
  const along = [(to.x - from.x) / coupler, (to.y - from.y) / coupler];
  const m = [place.x - from.x, place.y - from.y];
  const point = [
    along[0] * m[0] + along[1] * m[1],
    (along[0] * m[1] - along[1] * m[0]) * handednessOf(linkage),
  ];
  const [onFrame, onEnd] = [o, c].map((id) => placeOnLink(linkage.links[0], id));
  // The view has the crank's pivot at its origin and the rocker's on its x-axis.
  const isOwn = !linkage.seenFrom && onFrame && onEnd;
  const pivots = isOwn
    ? [
        [onFrame.x, onFrame.y],
        [onEnd.x, onEnd.y],
      ]
    : [
        [0, 0],
        [frame, 0],
      ];
  const { mirror, cos, sin } = linkage.placement;
  const placed = ([x, y]) => complexProduct([cos, sin], [x, mirror ? -y : y]);
  return { pivots: pivots.map(placed), lengths: { frame, crank, coupler, rocker }, point };
}

// Driven by the shortest link, if that is on a pivot, or, of a kite, by the one that never rests; else by the
// one that turns as the original's crank; else by that on the original's pivot.
function drivenCognate(cognate) {
  const { crank, coupler, rocker, frame } = cognate.lengths;
  const tolerance = lengthTolerance(crank + coupler + rocker + frame);
  // A link as long as the frame rests while the other two, of one length, turn about its pin.
  const rests = (link, other) =>
    Math.abs(link - frame) <= tolerance && Math.abs(other - coupler) <= tolerance;
  let isBetter = cognate.turnsAs[2] === "crank";
  if (rests(crank, rocker) !== rests(rocker, crank)) isBetter = rests(crank, rocker);
  else if (
    Math.abs(rocker - crank) > tolerance &&
    Math.min(rocker, crank) <= Math.min(frame, coupler) + tolerance
  ) {
    isBetter = rocker < crank;
  }
  if (!isBetter) return cognate;
  const reversed = (list) => [...list].reverse();
  return {
    pivots: reversed(cognate.pivots),
    lengths: { frame, crank: rocker, coupler, rocker: crank },
    point: [coupler - cognate.point[0], -cognate.point[1]],
    turnsAs: reversed(cognate.turnsAs),
    arms: reversed(cognate.arms),
  };
}

function complexProduct([a, b], [c, d]) {
  return [a * c - b * d, a * d + b * c];
}
