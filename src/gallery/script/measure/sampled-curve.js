// A curve as a row of samples, with arc lengths and curvatures.
//
// Between two samples the curve is approximated by a circular arc with the mean of the curvatures at both; a
// circle itself is measured exactly, and any smooth curve to the fourth order of the distance of its samples.
// That holds over limits too, where the curve continues smoothly though the input reverses.

/**
 * The sampled curve of a joint on a circuit: { x, y, samples, inputs, count, closed, turn, travel,
 * curvatures, sharp, intervals, localPolynomials }: the samples that have a position, the index of each in
 * its circuit and its input; whether the last is followed by the first, and the net change of the input over
 * one round; the total variation of the input up to each sample and then to the first again; the signed
 * curvature at each, of the circle through it and its neighbours; whether the path turns sharply at it; the
 * number of intervals between samples; and a cache for interpolation.js.
 */
export function sampledCurveOf(circuit, joint, { isLength }) {
  const [x, y] = [circuit.x[joint], circuit.y[joint]];
  const samples = [];
  for (let i = 0; i < circuit.count; i++) if (Number.isFinite(x[i]) && Number.isFinite(y[i])) samples.push(i);
  const count = samples.length;
  const inputs = Float64Array.from(samples, (i) => circuit.input[i]);
  // The last step is less than half a turn.
  const isTurning = circuit.closed && !isLength && count > 1;
  const turn = isTurning ? Math.round((inputs[count - 1] - inputs[0]) / 360) * 360 : 0;
  const curve = {
    x: Float64Array.from(samples, (i) => x[i]),
    y: Float64Array.from(samples, (i) => y[i]),
    samples,
    inputs,
    count,
    closed: circuit.closed,
    turn,
    travel: inputTravel(inputs, circuit.closed, turn),
    intervals: count < 2 ? 0 : circuit.closed ? count : count - 1,
    localPolynomials: new Array(count).fill(null),
  };
  curve.curvatures = Float64Array.from(samples, (_, i) => curvatureAt(curve, i));
  curve.sharp = samples.map((_, i) => turnsBeyond(curve, i, 0.5));
  return curve;
}

function inputTravel(inputs, closed, turn) {
  const count = inputs.length;
  const travel = new Float64Array(count + 1);
  for (let i = 1; i < count; i++) travel[i] = travel[i - 1] + Math.abs(inputs[i] - inputs[i - 1]);
  // An open curve goes no further than its last sample.
  if (count > 0)
    travel[count] = travel[count - 1] + (closed ? Math.abs(inputs[0] + turn - inputs[count - 1]) : 0);
  return travel;
}

/** The sample an offset after another, wrapping round a closed curve; -1 if there is none. */
export function neighbourSample({ closed, count }, i, off) {
  const k = i + off;
  if (closed) return ((k % count) + count) % count;
  return k >= 0 && k < count ? k : -1;
}

/** The signed curvature of the circle through three points of a row; 0 where there is none. */
export function curvatureThrough(x, y, a, b, c) {
  const [ux, uy, vx, vy] = [x[b] - x[a], y[b] - y[a], x[c] - x[b], y[c] - y[b]];
  const [wx, wy] = [x[c] - x[a], y[c] - y[a]];
  const sides = Math.sqrt(ux * ux + uy * uy) * Math.sqrt(vx * vx + vy * vy) * Math.sqrt(wx * wx + wy * wy);
  const bend = (2 * (ux * vy - uy * vx)) / sides;
  return Number.isFinite(bend) ? bend : 0;
}

function curvatureAt(curve, i) {
  let [before, at, after] = [neighbourSample(curve, i, -1), i, neighbourSample(curve, i, 1)];
  if (before < 0 && after < 0) return 0;
  const or = (k, other) => (k < 0 ? other : k);
  // At an open end the circle is that through the end and the next two.
  if (before < 0) [before, at, after] = [i, after, or(neighbourSample(curve, i, 2), after)];
  else if (after < 0) [before, at, after] = [or(neighbourSample(curve, i, -2), before), before, i];
  return curvatureThrough(curve.x, curve.y, before, at, after);
}

/** Whether the path turns at a sample by more than the angle with this cosine. */
export function turnsBeyond(curve, i, cosine) {
  const [a, b] = [neighbourSample(curve, i, -1), neighbourSample(curve, i, 1)];
  if (a < 0 || b < 0) return false;
  const { x, y } = curve;
  const [ux, uy, vx, vy] = [x[i] - x[a], y[i] - y[a], x[b] - x[i], y[b] - y[i]];
  return ux * vx + uy * vy < cosine * Math.sqrt(ux * ux + uy * uy) * Math.sqrt(vx * vx + vy * vy);
}

/** The length of the chord from a sample to the next. */
export function chordLengthAfter(curve, i) {
  const next = neighbourSample(curve, i, 1);
  if (next < 0) return 0;
  const [dx, dy] = [curve.x[next] - curve.x[i], curve.y[next] - curve.y[i]];
  return Math.sqrt(dx * dx + dy * dy);
}

/**
 * The arcs from each sample to the next: { length, area }, the area between arc and chord, positive to the
 * left.
 */
export function curveArcs(curve) {
  curve.arcs ??= Array.from({ length: curve.intervals }, (_, i) => arcAfter(curve, i));
  return curve.arcs;
}

function arcAfter(curve, i) {
  const next = neighbourSample(curve, i, 1);
  const chord = chordLengthAfter(curve, i);
  const bend = (curve.curvatures[i] + curve.curvatures[next]) / 2;
  // The sine of half the arc's angle. Where the samples are too far apart for the curvature, at a cusp, the
  // chord does.
  const sine = (bend * chord) / 2;
  if (Math.abs(sine) > 0.5 || chord === 0) return { length: chord, area: 0 };
  const square = sine * sine;
  if (square < 1e-4) {
    // asin(x)/x and (d - sin d)/(2 k^2) by their series, good to 1e-16 below this.
    const length = chord * (1 + (square / 6) * (1 + ((square * 9) / 20) * (1 + (square * 25) / 42)));
    const area = ((chord * chord * sine) / 6) * (1 + ((square * 3) / 10) * (1 + (square * 25) / 28));
    return { length, area };
  }
  const angle = 2 * Math.asin(sine);
  return { length: angle / bend, area: (angle - Math.sin(angle)) / (2 * bend * bend) };
}

/** The length of the whole path. */
export function curveLength(curve) {
  return curveArcs(curve).reduce((sum, arc) => sum + arc.length, 0);
}

/** The enclosed area, positive counter-clockwise; null for an open curve. */
export function enclosedArea(curve) {
  if (!curve.closed || curve.count === 0) return null;
  const { x, y } = curve;
  return curveArcs(curve).reduce((sum, arc, i) => {
    const next = neighbourSample(curve, i, 1);
    const [ax, ay, bx, by] = [x[i] - x[0], y[i] - y[0], x[next] - x[0], y[next] - y[0]];
    return sum + (ax * by - ay * bx) / 2 + arc.area;
  }, 0);
}

/** The furthest sample in a direction, of equal ones the last; -1 if there is none. */
export function furthestSample({ x, y, count }, [dx, dy]) {
  let [best, most] = [-1, -Infinity];
  for (let i = 0; i < count; i++) {
    const height = dx * x[i] + dy * y[i];
    if (height >= most) [best, most] = [i, height];
  }
  return best;
}

/**
 * The number of inflections. Samples where the curve is straight, to a part in ten million or to the rounding
 * of positions, or where it turns sharply, are skipped.
 */
export function inflectionCount(curve) {
  const { x, y, count, curvatures, sharp, closed } = curve;
  let size = 0;
  for (let i = 0; i < count; i++) size = Math.max(size, Math.hypot(x[i] - x[0], y[i] - y[0]));
  const before = (i) =>
    neighbourSample(curve, i, -1) < 0 ? 0 : chordLengthAfter(curve, neighbourSample(curve, i, -1));
  const tells = (i) => {
    const bend = Math.abs(curvatures[i]);
    return bend * size > 1e-7 && bend * chordLengthAfter(curve, i) * before(i) > 1e-12 * size && !sharp[i];
  };
  const ways = [];
  for (let i = 0; i < count; i++) if (tells(i)) ways.push(curvatures[i] > 0);
  let changes = 0;
  for (let i = 1; i < ways.length; i++) if (ways[i] !== ways[i - 1]) changes += 1;
  return changes + (closed && ways.length > 0 && ways[0] !== ways[ways.length - 1] ? 1 : 0);
}

/** The greatest distance of the curve from the chords between its samples, except at cusps. */
export function maxSagitta(curve) {
  let most = 0;
  for (let i = 0; i < curve.count; i++) {
    const chord = chordLengthAfter(curve, i);
    most = Math.max(most, Math.min((chord * chord * Math.abs(curve.curvatures[i])) / 8, chord / 2));
  }
  return most;
}
