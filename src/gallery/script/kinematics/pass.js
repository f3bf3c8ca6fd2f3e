// A pass: a part of a circuit on which the input goes one way and every dyad keeps its side.
//
// { from, to, signs, begin, end }: the input it goes from and to, in degrees continuous along a circuit, or
// lengths; the sides of the dyads; and both ends as { at, cos, sin, flat }, with the dyads that lie flat
// there, none at the end of a range or a period. At a limit the direction is more exact than the angle.

/** A pass between two ends. */
export function passBetween(begin, end, signs) {
  return { from: begin.at, to: end.at, signs, begin, end };
}

/** 1 where the input rises on a pass, -1 where it falls. */
export function inputDirection(pass) {
  return pass.to >= pass.from ? 1 : -1;
}

/** How much the input changes over a pass. */
export function passLength(pass) {
  return Math.abs(pass.to - pass.from);
}

/** The least and the greatest input on it. */
export function passRange(pass) {
  return [Math.min(pass.from, pass.to), Math.max(pass.from, pass.to)];
}

export function reversedPass(pass) {
  return passBetween(pass.end, pass.begin, pass.signs);
}

/** The same pass shifted by whole turns. */
export function shiftedPass({ begin, end, signs }, by) {
  return passBetween({ ...begin, at: begin.at + by }, { ...end, at: end.at + by }, signs);
}

/** An interval { span, signs } traversed with a rising or falling input; a full turn from 0 to its period. */
export function passOfInterval({ span, signs }, rising, period) {
  const plain = ({ at, cos, sin, flat }) => ({ at, cos, sin, flat });
  const seam = (at) => ({ at, cos: 1, sin: 0, flat: 0 });
  const ends = span.lower ? [plain(span.lower), plain(span.upper)] : [seam(0), seam(period)];
  return rising ? passBetween(ends[0], ends[1], signs) : passBetween(ends[1], ends[0], signs);
}
