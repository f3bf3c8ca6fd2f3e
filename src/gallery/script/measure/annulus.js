// The narrowest ring between two circles about one centre that holds a row of points, as far as it is known:
// { x, y, radius, width }, the centre, the radius halfway between the circles and how far they are apart.
// Rows of points are arrays x and y, from `first` up to, not with, `last`.

import { exchangedTurns } from "./exchange.js";

/**
 * The narrowest ring of a row of at least four points, which lie on an arc of a circle or nearly so, whose
 * radius is no more than `largest`; null as soon as it must be wider than `most`, and done as soon as it is
 * known to be no wider. `turns` is { four, three } of another row much like this, or empty; the points are
 * those of this afterwards.
 *
 * Its circles go through four of the points by turns, outer and inner: of any four the ring is no wider than
 * that of all, and four are exchanged for others until it is no narrower.
 */
export function ringWithin(x, y, first, last, turns, most, largest) {
  const free = freeRing(x, y, first, last, turns, most);
  if (!free || free.radius <= largest) return free;
  // The row is flatter than the largest circle, which touches it best somewhere between its ends. About a
  // point in the middle the centre is turned to where the ring is narrowest: three points tell.
  const middle = first + ((last - first) >> 1);
  const row = oneWay(x, y, first, last);
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
    const off = side * Math.sqrt(Math.max(largest * largest - rest * rest, 0));
    return ringAbout(rx, ry, x[middle] + ux * rest - uy * off, y[middle] + uy * rest + ux * off, a, b);
  };
  turns.three ??= [row.first, row.first + ((end - row.first) >> 1), end];
  return exchangedRing(row.x, row.y, row.first, row.last, turns.three, most, through);
}

/** The ring about a centre that holds a row of points. */
export function ringRound(x, y, first, last, cx, cy) {
  let [low, high] = [Infinity, 0];
  for (let i = first; i < last; i++) {
    const square = (x[i] - cx) * (x[i] - cx) + (y[i] - cy) * (y[i] - cy);
    if (square < low) low = square;
    if (square > high) high = square;
  }
  [low, high] = [Math.sqrt(low), Math.sqrt(high)];
  return { x: cx, y: cy, radius: (low + high) / 2, width: high - low };
}

function freeRing(x, y, first, last, turns, most) {
  if (turns.four) {
    const ring = exchangedRing(x, y, first, last, turns.four, most, ringThrough);
    if (ring) return ring;
  }
  turns.four = guessedTurns(x, y, first, last);
  const ring = ringThrough(x, y, turns.four);
  if (!ring || ring.width > most) return null;
  if (Number.isFinite(most)) turns.four = siftedTurns(x, y, first, last, turns.four, most);
  return exchangedRing(x, y, first, last, turns.four, most, ringThrough);
}

// Four points of a row where those of a narrow ring may be.
function guessedTurns(x, y, first, last) {
  const end = last - first - 1;
  const part = (by, of) => first + Math.floor((by * end) / of);
  const square = (k) => (x[k] - x[first]) * (x[k] - x[first]) + (y[k] - y[first]) * (y[k] - y[first]);
  // Where a polynomial of the third degree has its extremes: the first guess is good. Of a row that goes
  // nearly round the ends are nearly one point, and tell the less.
  const isRound = square(last - 1) < square(first + (end >> 1)) / 4;
  const quarter = Math.floor(end / 4);
  const four = isRound
    ? [1, 3, 5, 7].map((k) => part(k, 8))
    : [first, first + quarter, last - 1 - quarter, last - 1];
  // A row that goes there and back on one arc has pairs of points in one place.
  return ringThrough(x, y, four) ? four : [1, 6, 11, 17].map((k) => part(k, 20));
}

// Four points of a long row exchanged for better ones, of a few of its points only.
function siftedTurns(x, y, first, last, four, most) {
  const FEW = 16;
  const end = last - first - 1;
  if (end < 2 * FEW) return four;
  const at = Array.from({ length: FEW + 1 }, (_, k) => first + Math.floor((k * end) / FEW));
  const [fx, fy] = [at.map((k) => x[k]), at.map((k) => y[k])];
  const among = four.map((k) => Math.floor(((k - first) * FEW) / end));
  exchangedRing(fx, fy, 0, FEW + 1, among, most, ringThrough);
  return ringThrough(fx, fy, among) ? among.map((k) => at[k]) : four;
}

// The points of a nearly straight row in the order in which they lie along it, should it go there and back.
function oneWay(x, y, first, last) {
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
function ringThrough(x, y, [a, b, c, d]) {
  // The centre is as far from the one as from the other of each pair.
  const [ux, uy, vx, vy] = [x[c] - x[a], y[c] - y[a], x[d] - x[b], y[d] - y[b]];
  const p = (ux * (x[c] + x[a]) + uy * (y[c] + y[a])) / 2;
  const q = (vx * (x[d] + x[b]) + vy * (y[d] + y[b])) / 2;
  const turn = ux * vy - uy * vx;
  const ring = ringAbout(x, y, (p * vy - q * uy) / turn, (ux * q - vx * p) / turn, a, b);
  return Number.isFinite(ring.radius) ? ring : null;
}

// The circles about a centre through two points.
function ringAbout(x, y, cx, cy, a, b) {
  const [ra, rb] = [a, b].map((k) => Math.sqrt((x[k] - cx) * (x[k] - cx) + (y[k] - cy) * (y[k] - cy)));
  return { x: cx, y: cy, radius: (ra + rb) / 2, width: Math.abs(ra - rb) };
}

// The narrowest ring of a row of points, by some of them that are by turns on its two circles, which go
// `through` those.
function exchangedRing(x, y, first, last, turns, most, through) {
  const ROUNDS = 24;
  let ring = through(x, y, turns);
  let best = null;
  for (let round = 0; ring && round < ROUNDS; round++) {
    if (ring.width > most) return null;
    const { x: cx, y: cy } = ring;
    let [low, high, lowest, highest] = [Infinity, -Infinity, first, first];
    for (let i = first; i < last; i++) {
      const square = (x[i] - cx) * (x[i] - cx) + (y[i] - cy) * (y[i] - cy);
      if (square < low) [low, lowest] = [square, i];
      if (square > high) [high, highest] = [square, i];
    }
    [low, high] = [Math.sqrt(low), Math.sqrt(high)];
    const found = { x: cx, y: cy, radius: (low + high) / 2, width: high - low };
    if (!best || found.width < best.width) best = found;
    if (found.width <= ring.width * (1 + 1e-9) || (Number.isFinite(most) && found.width <= most)) break;
    const isInside = ring.radius - low > high - ring.radius;
    const next = exchangedForRing(x, y, turns, isInside ? lowest : highest, isInside, ring, through);
    if (!next) break;
    for (let k = 0; k < turns.length; k++) turns[k] = next.turns[k];
    ring = next.ring;
  }
  return best && best.width <= most ? best : null;
}

function exchangedForRing(x, y, turns, fresh, isInside, ring, through) {
  if (turns.includes(fresh)) return null;
  const distance = (k, { x: cx, y: cy }) => Math.sqrt((x[k] - cx) * (x[k] - cx) + (y[k] - cy) * (y[k] - cy));
  const own = turns.map((k) => distance(k, ring) < ring.radius);
  const next = exchangedTurns(turns, fresh, (k) => own[k] === isInside);
  const wider = through(x, y, next);
  if (wider && wider.width > ring.width) return { turns: next, ring: wider };
  // On a long arc it may be another that goes: one that lies within the ring of the rest.
  let best = null;
  turns.forEach((k, gone) => {
    const others = turns.map((other, at) => (at === gone ? fresh : other)).sort((a, b) => a - b);
    const other = through(x, y, others);
    if (!other || Math.abs(distance(k, other) - other.radius) > other.width * (0.5 + 1e-9)) return;
    if (!best || other.width < best.ring.width) best = { turns: others, ring: other };
  });
  return best;
}
