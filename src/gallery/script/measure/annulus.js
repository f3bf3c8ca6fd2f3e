// Computes the narrowest annulus that contains a row of points, or the best one found: { x, y, radius, width
// }, the centre, the radius halfway between the two circles, and the distance between them. Rows of points
// are arrays x and y, from `first` up to, not with, `last`.

import { exchangePoint } from "./remez.js";

/**
 * The narrowest annulus of a row of at least four points on or near an arc of a circle, whose radius is at
 * most `maxRadius`; null as soon as it must be wider than `most`; finished as soon as it is known to be no
 * wider. `turns` is { four, three } of a similar row, or empty, and is updated to the points of this one.
 *
 * Its circles go through four of the points, alternating between outer and inner: the annulus of any four is
 * no wider than that of all, and points are exchanged until it is no narrower.
 */
export function narrowestAnnulusWithin(x, y, first, last, turns, most, maxRadius) {
  const free = freeAnnulus(x, y, first, last, turns, most);
  if (!free || free.radius <= maxRadius) return free;
  // The row is flatter than the largest circle, which touches it best somewhere between its ends. About a
  // point in the middle the centre is turned to where the annulus is narrowest: three points determine it.
  const middle = first + ((last - first) >> 1);
  const row = sortedAlong(x, y, first, last);
  const end = row.last - 1;
  const [ex, ey] = [row.x[end] - row.x[row.first], row.y[end] - row.y[row.first]];
  const side = ex * (free.y - y[middle]) - ey * (free.x - x[middle]) >= 0 ? 1 : -1;
  const through = (rx, ry, [a, b, c]) => {
    // As far from the middle as it may be, and as far from the first as from the third.
    const [dx, dy] = [rx[c] - rx[a], ry[c] - ry[a]];
    const size = Math.sqrt(dx * dx + dy * dy);
    if (!(size > 0)) return null;
    const [ux, uy] = [dx / size, dy / size];
    const rest = ux * ((rx[a] + rx[c]) / 2 - x[middle]) + uy * ((ry[a] + ry[c]) / 2 - y[middle]);
    const off = side * Math.sqrt(Math.max(maxRadius * maxRadius - rest * rest, 0));
    return annulusWithCentre(
      rx,
      ry,
      x[middle] + ux * rest - uy * off,
      y[middle] + uy * rest + ux * off,
      a,
      b,
    );
  };
  turns.three ??= [row.first, row.first + ((end - row.first) >> 1), end];
  return annulusByExchange(row.x, row.y, row.first, row.last, turns.three, most, through);
}

/** The annulus about a centre that encloses a row of points. */
export function enclosingAnnulus(x, y, first, last, cx, cy) {
  let [low, high] = [Infinity, 0];
  for (let i = first; i < last; i++) {
    const square = (x[i] - cx) * (x[i] - cx) + (y[i] - cy) * (y[i] - cy);
    if (square < low) low = square;
    if (square > high) high = square;
  }
  [low, high] = [Math.sqrt(low), Math.sqrt(high)];
  return { x: cx, y: cy, radius: (low + high) / 2, width: high - low };
}

function freeAnnulus(x, y, first, last, turns, most) {
  if (turns.four) {
    const annulus = annulusByExchange(x, y, first, last, turns.four, most, annulusThrough);
    if (annulus) return annulus;
  }
  turns.four = initialPoints(x, y, first, last);
  const annulus = annulusThrough(x, y, turns.four);
  if (!annulus || annulus.width > most) return null;
  if (Number.isFinite(most)) turns.four = improveBySubset(x, y, first, last, turns.four, most);
  return annulusByExchange(x, y, first, last, turns.four, most, annulusThrough);
}

// Four points of a row where those of a narrow annulus may be.
function initialPoints(x, y, first, last) {
  const end = last - first - 1;
  const part = (by, of) => first + Math.floor((by * end) / of);
  const square = (k) => (x[k] - x[first]) * (x[k] - x[first]) + (y[k] - y[first]) * (y[k] - y[first]);
  // Where a polynomial of the third degree has its extremes: the first guess is good. Of a row that goes
  // nearly round the ends are nearly one point, and determine it less well.
  const isRound = square(last - 1) < square(first + (end >> 1)) / 4;
  const quarter = Math.floor(end / 4);
  const four = isRound
    ? [1, 3, 5, 7].map((k) => part(k, 8))
    : [first, first + quarter, last - 1 - quarter, last - 1];
  // A row that goes forth and back on one arc has pairs of points in one place.
  return annulusThrough(x, y, four) ? four : [1, 6, 11, 17].map((k) => part(k, 20));
}

// Four points of a long row exchanged for better ones, of a few of its points only.
function improveBySubset(x, y, first, last, four, most) {
  const FEW = 16;
  const end = last - first - 1;
  if (end < 2 * FEW) return four;
  const at = Array.from({ length: FEW + 1 }, (_, k) => first + Math.floor((k * end) / FEW));
  const [fx, fy] = [at.map((k) => x[k]), at.map((k) => y[k])];
  const among = four.map((k) => Math.floor(((k - first) * FEW) / end));
  annulusByExchange(fx, fy, 0, FEW + 1, among, most, annulusThrough);
  return annulusThrough(fx, fy, among) ? among.map((k) => at[k]) : four;
}

// The points of a nearly straight row in the order in which they lie along it, in case it goes forth and
// back.
function sortedAlong(x, y, first, last) {
  const along = (to) => [x[to] - x[first], y[to] - y[first]];
  const [ax, ay] = along(last - 1);
  const reach = ax * ax + ay * ay;
  let [low, high, far, most] = [Infinity, -Infinity, first, 0];
  for (let i = first; i < last; i++) {
    const [dx, dy] = along(i);
    const at = ax * dx + ay * dy;
    low = Math.min(low, at);
    high = Math.max(high, at);
    if (dx * dx + dy * dy > most) [most, far] = [dx * dx + dy * dy, i];
  }
  if (low >= -1e-3 * reach && high <= 1.001 * reach) return { x, y, first, last };
  const [fx, fy] = along(far);
  const order = Array.from({ length: last - first }, (_, k) => first + k);
  order.sort((a, b) => fx * (x[a] - x[b]) + fy * (y[a] - y[b]));
  return { x: order.map((k) => x[k]), y: order.map((k) => y[k]), first: 0, last: order.length };
}

// The circles through the first and third of four points, and through the second and fourth; null where there
// are none.
function annulusThrough(x, y, [a, b, c, d]) {
  // The centre is as far from the one as from the other of each pair.
  const [ux, uy, vx, vy] = [x[c] - x[a], y[c] - y[a], x[d] - x[b], y[d] - y[b]];
  const p = (ux * (x[c] + x[a]) + uy * (y[c] + y[a])) / 2;
  const q = (vx * (x[d] + x[b]) + vy * (y[d] + y[b])) / 2;
  const turn = ux * vy - uy * vx;
  const annulus = annulusWithCentre(x, y, (p * vy - q * uy) / turn, (ux * q - vx * p) / turn, a, b);
  return Number.isFinite(annulus.radius) ? annulus : null;
}

// The circles about a centre through two points.
function annulusWithCentre(x, y, cx, cy, a, b) {
  const [ra, rb] = [a, b].map((k) => Math.sqrt((x[k] - cx) * (x[k] - cx) + (y[k] - cy) * (y[k] - cy)));
  return { x: cx, y: cy, radius: (ra + rb) / 2, width: Math.abs(ra - rb) };
}

// The narrowest annulus of a row of points, by some of them that alternate between its two circles, which go
// `through` those.
function annulusByExchange(x, y, first, last, turns, most, through) {
  const ROUNDS = 24;
  let annulus = through(x, y, turns);
  let best = null;
  for (let round = 0; annulus && round < ROUNDS; round++) {
    if (annulus.width > most) return null;
    const { x: cx, y: cy } = annulus;
    let [low, high, lowest, highest] = [Infinity, -Infinity, first, first];
    for (let i = first; i < last; i++) {
      const square = (x[i] - cx) * (x[i] - cx) + (y[i] - cy) * (y[i] - cy);
      if (square < low) [low, lowest] = [square, i];
      if (square > high) [high, highest] = [square, i];
    }
    [low, high] = [Math.sqrt(low), Math.sqrt(high)];
    const found = { x: cx, y: cy, radius: (low + high) / 2, width: high - low };
    if (!best || found.width < best.width) best = found;
    if (found.width <= annulus.width * (1 + 1e-9) || (Number.isFinite(most) && found.width <= most)) break;
    const isInside = annulus.radius - low > high - annulus.radius;
    const next = exchangeForAnnulus(x, y, turns, isInside ? lowest : highest, isInside, annulus, through);
    if (!next) break;
    for (let k = 0; k < turns.length; k++) turns[k] = next.turns[k];
    annulus = next.annulus;
  }
  return best && best.width <= most ? best : null;
}

function exchangeForAnnulus(x, y, turns, added, isInside, annulus, through) {
  if (turns.includes(added)) return null;
  const distance = (k, { x: cx, y: cy }) => Math.sqrt((x[k] - cx) * (x[k] - cx) + (y[k] - cy) * (y[k] - cy));
  const own = turns.map((k) => distance(k, annulus) < annulus.radius);
  const next = exchangePoint(turns, added, (k) => own[k] === isInside);
  const wider = through(x, y, next);
  if (wider && wider.width > annulus.width) return { turns: next, annulus: wider };
  // On a long arc it may be another that goes: one that lies within the annulus of the rest.
  let best = null;
  turns.forEach((k, gone) => {
    const others = turns.map((other, at) => (at === gone ? added : other)).sort((a, b) => a - b);
    const other = through(x, y, others);
    if (!other || Math.abs(distance(k, other) - other.radius) > other.width * (0.5 + 1e-9)) return;
    if (!best || other.width < best.annulus.width) best = { turns: others, annulus: other };
  });
  return best;
}
