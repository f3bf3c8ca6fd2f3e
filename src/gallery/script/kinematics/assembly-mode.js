// The sides of all two-valued joints at once, an assembly mode, as the bits of a number: 0 is left, 1 is
// right. Sets of them that lie flat somewhere are numbers too: bit k stands for the k-th two-valued joint.

/** The side of a dyad in a mode: 1 left, -1 right. */
export function sideOf(signs, dyad) {
  return (signs >> dyad) & 1 ? -1 : 1;
}

/** A mode with another side (1 or -1) of one dyad. */
export function modeWithSide(signs, dyad, side) {
  return side > 0 ? signs & ~(1 << dyad) : signs | (1 << dyad);
}

/** The sides of the first few dyads; of the others, left. */
export function truncatedMode(signs, dyads) {
  return signs & ((1 << dyads) - 1);
}

/** Modes are in the order of their first dyads' sides, left before right. */
export function compareModes(a, b) {
  const differ = a ^ b;
  return differ === 0 ? 0 : (a & differ & -differ) !== 0 ? 1 : -1;
}

/** All modes of that many dyads; the side of the last changes fastest, left first. */
export function allModes(dyads) {
  const modes = [];
  for (let k = 0; k < 1 << dyads; k++) {
    let signs = 0;
    for (let dyad = 0; dyad < dyads; dyad++) signs |= ((k >> (dyads - 1 - dyad)) & 1) << dyad;
    modes.push(signs);
  }
  return modes;
}

/** What each dyad's height is multiplied by: its side, or 0 where it lies flat. */
export function dyadSigns(signs, flat, dyads) {
  const modes = new Float64Array(Math.max(dyads, 1));
  for (let dyad = 0; dyad < dyads; dyad++) modes[dyad] = (flat >> dyad) & 1 ? 0 : sideOf(signs, dyad);
  return modes;
}

/** Of the dyads of a set, the one that is placed first; none of none. */
export function firstDyad(flat) {
  return flat & -flat;
}

/** Of the dyads of a set, the one that is placed last; none of none. */
export function lastDyad(flat) {
  return flat === 0 ? 0 : 1 << (31 - Math.clz32(flat));
}
