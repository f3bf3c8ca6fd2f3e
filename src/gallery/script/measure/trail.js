// A curve as the row of its samples, and what is known of it between them.
//
// Between two samples the curve is taken for an arc of the circle that bends as the curve does at both; a
// circle itself is measured exactly, and any smooth curve to the fourth order of the distance of its samples.
// That holds over limits too, where the curve goes on smoothly though the input turns.

/**
 * The trail of a joint on a circuit: { x, y, samples, inputs, count, closed, turn, travel, bends, sharp,
 * intervals, nears }: the samples that have a place, the number of each in its circuit and its input; whether
 * the last is followed by the first, and how much the input has changed after once round; how far the input
 * has gone, there and back, up to each sample and then to the first again; the signed curvature at each, of
 * the circle through it and its neighbours; whether the path turns sharply about it; how many intervals there
 * are between samples; and room for what between.js finds.
 */
export function trailOf(circuit, joint, { isLength }) {
  const [x, y] = [circuit.x[joint], circuit.y[joint]];
  const samples = [];
  for (let i = 0; i < circuit.count; i++) if (Number.isFinite(x[i]) && Number.isFinite(y[i])) samples.push(i);
  const count = samples.length;
  const inputs = Float64Array.from(samples, (i) => circuit.input[i]);
  // The last step is less than half a turn.
  const isTurning = circuit.closed && !isLength && count > 1;
  const turn = isTurning ? Math.round((inputs[count - 1] - inputs[0]) / 360) * 360 : 0;
  const trail = {
    x: Float64Array.from(samples, (i) => x[i]),
    y: Float64Array.from(samples, (i) => y[i]),
    samples,
    inputs,
    count,
    closed: circuit.closed,
    turn,
    travel: travelOfTrail(inputs, circuit.closed, turn),
    intervals: count < 2 ? 0 : circuit.closed ? count : count - 1,
    nears: new Array(count).fill(null),
  };
  trail.bends = Float64Array.from(samples, (_, i) => bendOfTrail(trail, i));
  trail.sharp = samples.map((_, i) => turnsFurther(trail, i, 0.5));
  return trail;
}

function travelOfTrail(inputs, closed, turn) {
  const count = inputs.length;
  const travel = new Float64Array(count + 1);
  for (let i = 1; i < count; i++) travel[i] = travel[i - 1] + Math.abs(inputs[i] - inputs[i - 1]);
  // An open curve goes no further than its last sample.
  if (count > 0)
    travel[count] = travel[count - 1] + (closed ? Math.abs(inputs[0] + turn - inputs[count - 1]) : 0);
  return travel;
}

/** The sample that many after another, round a closed curve; -1 where there is none. */
export function sampleAfter({ closed, count }, i, off) {
  const k = i + off;
  if (closed) return ((k % count) + count) % count;
  return k >= 0 && k < count ? k : -1;
}

/** The signed curvature of the circle through three points of a row; 0 where there is none. */
export function bendThrough(x, y, a, b, c) {
  const [ux, uy, vx, vy] = [x[b] - x[a], y[b] - y[a], x[c] - x[b], y[c] - y[b]];
  const [wx, wy] = [x[c] - x[a], y[c] - y[a]];
  const sides = Math.sqrt(ux * ux + uy * uy) * Math.sqrt(vx * vx + vy * vy) * Math.sqrt(wx * wx + wy * wy);
  const bend = (2 * (ux * vy - uy * vx)) / sides;
  return Number.isFinite(bend) ? bend : 0;
}

function bendOfTrail(trail, i) {
  let [before, at, after] = [sampleAfter(trail, i, -1), i, sampleAfter(trail, i, 1)];
  if (before < 0 && after < 0) return 0;
  const or = (k, other) => (k < 0 ? other : k);
  // At an open end the circle is that through the end and the next two.
  if (before < 0) [before, at, after] = [i, after, or(sampleAfter(trail, i, 2), after)];
  else if (after < 0) [before, at, after] = [or(sampleAfter(trail, i, -2), before), before, i];
  return bendThrough(trail.x, trail.y, before, at, after);
}

/** Whether the path turns about a sample through more than the angle of some cosine. */
export function turnsFurther(trail, i, cosine) {
  const [a, b] = [sampleAfter(trail, i, -1), sampleAfter(trail, i, 1)];
  if (a < 0 || b < 0) return false;
  const { x, y } = trail;
  const [ux, uy, vx, vy] = [x[i] - x[a], y[i] - y[a], x[b] - x[i], y[b] - y[i]];
  return ux * vx + uy * vy < cosine * Math.sqrt(ux * ux + uy * uy) * Math.sqrt(vx * vx + vy * vy);
}

/** The length of the chord from a sample to the next. */
export function chordAfter(trail, i) {
  const next = sampleAfter(trail, i, 1);
  if (next < 0) return 0;
  const [dx, dy] = [trail.x[next] - trail.x[i], trail.y[next] - trail.y[i]];
  return Math.sqrt(dx * dx + dy * dy);
}

/**
 * The arcs from each sample to the next: { length, area }, the area between arc and chord, positive to the
 * left.
 */
export function arcsOfTrail(trail) {
  trail.arcs ??= Array.from({ length: trail.intervals }, (_, i) => arcAfter(trail, i));
  return trail.arcs;
}

function arcAfter(trail, i) {
  const next = sampleAfter(trail, i, 1);
  const chord = chordAfter(trail, i);
  const bend = (trail.bends[i] + trail.bends[next]) / 2;
  // The sine of half the arc's angle. Where the samples are too far apart for their bend, at a cusp, the
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
export function lengthOfTrail(trail) {
  return arcsOfTrail(trail).reduce((sum, arc) => sum + arc.length, 0);
}

/** The area the path goes round, positive counter-clockwise; null of an open curve. */
export function areaOfTrail(trail) {
  if (!trail.closed || trail.count === 0) return null;
  const { x, y } = trail;
  return arcsOfTrail(trail).reduce((sum, arc, i) => {
    const next = sampleAfter(trail, i, 1);
    const [ax, ay, bx, by] = [x[i] - x[0], y[i] - y[0], x[next] - x[0], y[next] - y[0]];
    return sum + (ax * by - ay * bx) / 2 + arc.area;
  }, 0);
}

/** The sample that is furthest in a direction; of equal ones the last, -1 where there is none. */
export function topOfTrail({ x, y, count }, [dx, dy]) {
  let [best, most] = [-1, -Infinity];
  for (let i = 0; i < count; i++) {
    const height = dx * x[i] + dy * y[i];
    if (height >= most) [best, most] = [i, height];
  }
  return best;
}

/**
 * How often the curve begins to bend the other way. Where it is straight, to a part in ten million or to what
 * places are rounded to, or turns sharply, its samples do not tell.
 */
export function inflectionsOfTrail(trail) {
  const { x, y, count, bends, sharp, closed } = trail;
  let size = 0;
  for (let i = 0; i < count; i++) size = Math.max(size, Math.hypot(x[i] - x[0], y[i] - y[0]));
  const before = (i) => (sampleAfter(trail, i, -1) < 0 ? 0 : chordAfter(trail, sampleAfter(trail, i, -1)));
  const tells = (i) => {
    const bend = Math.abs(bends[i]);
    return bend * size > 1e-7 && bend * chordAfter(trail, i) * before(i) > 1e-12 * size && !sharp[i];
  };
  const ways = [];
  for (let i = 0; i < count; i++) if (tells(i)) ways.push(bends[i] > 0);
  let changes = 0;
  for (let i = 1; i < ways.length; i++) if (ways[i] !== ways[i - 1]) changes += 1;
  return changes + (closed && ways.length > 0 && ways[0] !== ways[ways.length - 1] ? 1 : 0);
}

/** How far the curve is from the lines between its samples at most, but for cusps. */
export function sagittaOfTrail(trail) {
  let most = 0;
  for (let i = 0; i < trail.count; i++) {
    const chord = chordAfter(trail, i);
    most = Math.max(most, Math.min((chord * chord * Math.abs(trail.bends[i])) / 8, chord / 2));
  }
  return most;
}
