// One point in for another, where the best line, strip or ring is known by a few points that it touches by
// turns (de la Vallée Poussin, Remez).

/**
 * Points by turns on the one side and on the other, in order, with one of them exchanged for a new point that
 * is further out than they: for a neighbour on the same side, or else for the one at the other end.
 * `isLike(k)` tells whether the k-th of them is on the side of the new point.
 */
export function exchangedTurns(turns, fresh, isLike) {
  const n = turns.length;
  const before = turns.filter((k) => k < fresh).length;
  if (before === 0 && !isLike(0)) return [fresh, ...turns.slice(0, n - 1)];
  if (before === n && !isLike(n - 1)) return [...turns.slice(1), fresh];
  const neighbours = [Math.max(before - 1, 0), Math.min(before, n - 1)];
  const gone = isLike(neighbours[0]) ? neighbours[0] : neighbours[1];
  return turns.map((k, at) => (at === gone ? fresh : k));
}
