// The exchange step of Remez and de la Vallée Poussin, for a line, strip or annulus that touches a few points
// on alternating sides.

/**
 * Points on alternating sides, in order, with one of them exchanged for a new point that is further out: for
 * a neighbour on the same side, or else for the one at the other end. `isLike(k)` is whether the k-th of them
 * is on the side of the new point.
 */
export function exchangePoint(turns, added, isLike) {
  const n = turns.length;
  const before = turns.filter((k) => k < added).length;
  if (before === 0 && !isLike(0)) return [added, ...turns.slice(0, n - 1)];
  if (before === n && !isLike(n - 1)) return [...turns.slice(1), added];
  const neighbours = [Math.max(before - 1, 0), Math.min(before, n - 1)];
  const gone = isLike(neighbours[0]) ? neighbours[0] : neighbours[1];
  return turns.map((k, at) => (at === gone ? added : k));
}
