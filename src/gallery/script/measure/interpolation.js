// Interpolates a curve between its samples: near each, by the polynomial of the fourth degree, in the length
// of the chords, through it and two on either side.

import { neighbourSample } from "./sampled-curve.js";

/**
 * The point and the input at a position on a curve, counted in samples from the first: [x, y, input].
 * Positions wrap round a closed curve, on which they may be slightly negative.
 */
export function pointAndInputAt(curve, place) {
  const { count: n, x, y, inputs, turn, curvatures, sharp } = curve;
  if (place < 0) {
    const found = pointAndInputAt(curve, place + n);
    found[2] -= turn;
    return found;
  }
  const whole = Math.floor(place);
  const i = whole % n;
  const part = place - whole;
  const rounds = Math.floor(whole / n) * turn;
  if (part === 0) return [x[i], y[i], inputs[i] + rounds];
  const after = neighbourSample(curve, i, 1);
  const next = after < 0 ? i : after;
  const sx = x[next] - x[i];
  const sy = y[next] - y[i];
  const chord = Math.sqrt(sx * sx + sy * sy);
  const input = inputs[next] + (next < i ? turn : 0);
  // An arc over the chord, as flat as the curve is at the flatter end; at a reversal the curvature at the
  // other end counts.
  let bend = Math.abs(curvatures[i]) < Math.abs(curvatures[next]) ? curvatures[i] : curvatures[next];
  if (sharp[i]) bend = curvatures[next];
  else if (sharp[next]) bend = curvatures[i];
  const height = Math.min(Math.max((bend * chord * part * (1 - part)) / 2, -0.2), 0.2);
  const straight = [
    x[i] + sx * part + sy * height,
    y[i] + sy * part - sx * height,
    inputs[i] + (input - inputs[i]) * part,
  ];
  // About the sample that is nearer, by the length of the chords; halfway the one goes over into the other.
  const over = Math.min(Math.max((part - 0.25) * 2, 0), 1);
  const before = over < 1 ? pointAbout(curve, i, part * chord, inputs[i], straight, chord) : null;
  const behind = over > 0 ? pointAbout(curve, next, (part - 1) * chord, input, straight, chord) : null;
  const found = before ?? behind;
  if (before && behind) for (let k = 0; k < 3; k++) found[k] += (behind[k] - before[k]) * over;
  const low = Math.min(inputs[i], input);
  const high = Math.max(inputs[i], input);
  found[2] = Math.min(Math.max(found[2], low), high) + rounds;
  return found;
}

// The point and the input so far along the chords from a sample. Where the path turns back its samples on the
// other side do not determine it; and where they lie too unevenly, a polynomial through them strays further
// from their chord than a curve that is known by its samples does: then it is the point on the arc over the
// chord.
function pointAbout(curve, k, u, from, straight, chord) {
  const near = localPolynomial(curve, k);
  if (!near || !near.isSmooth) return [straight[0], straight[1], straight[2]];
  const { x: cx, y: cy, input: ci } = near;
  const px = curve.x[k] + ((((cx[4] * u + cx[3]) * u + cx[2]) * u + cx[1]) * u + cx[0]);
  const py = curve.y[k] + ((((cy[4] * u + cy[3]) * u + cy[2]) * u + cy[1]) * u + cy[0]);
  const input = from + ((((ci[4] * u + ci[3]) * u + ci[2]) * u + ci[1]) * u + ci[0]);
  const dx = px - straight[0];
  const dy = py - straight[1];
  const isClose = dx * dx + dy * dy <= 0.04 * chord * chord && Number.isFinite(input);
  return isClose ? [px, py, input] : [straight[0], straight[1], straight[2]];
}

/**
 * The point at a position and the total variation of the input from the first sample to it: [x, y,
 * travelled].
 */
export function pointAndTravelAt(curve, place) {
  const { count: n, travel, inputs } = curve;
  if (place < 0) {
    const arrived = pointAndTravelAt(curve, place + n);
    arrived[2] -= travel[n];
    return arrived;
  }
  const whole = Math.floor(place);
  const i = whole % n;
  const found = pointAndInputAt(curve, i + (place - whole));
  const gone = Math.min(Math.abs(found[2] - inputs[i]), travel[i + 1] - travel[i]);
  found[2] = Math.floor(whole / n) * travel[n] + travel[i] + gone;
  return found;
}

/** The greatest extent in a direction, near the furthest sample. */
export function maxExtent(curve, [dx, dy], top) {
  const height = dx * curve.x[top] + dy * curve.y[top];
  const near = localPolynomial(curve, top);
  if (!near) return height;
  const rise = maximumNear(near, (u) => {
    const [p] = derivativesNear(near, u);
    return dx * p[0] + dy * p[1];
  });
  // A curve does not rise above its furthest sample by more than a part of the way to the next.
  return rise > 0 && rise < 0.5 * (near.ends[1] - near.ends[0]) ? height + rise : height;
}

/** The greatest curvature near a sample. */
export function maxCurvatureNear(curve, i) {
  const near = localPolynomial(curve, i);
  if (!near) return Math.abs(curve.curvatures[i]);
  return maximumNear(near, (u) => {
    const [, v, a] = derivativesNear(near, u);
    const speed2 = v[0] * v[0] + v[1] * v[1];
    return Math.abs((v[0] * a[1] - v[1] * a[0]) / (speed2 * Math.sqrt(speed2)));
  });
}

/**
 * The signed distance of a point near a sample from the curve, positive to the left, and the curve's normal:
 * [distance, nx, ny].
 */
export function signedDistance(curve, px, py, i) {
  const near = localPolynomial(curve, i);
  if (!near) return null;
  const [ox, oy] = [curve.x[i] - px, curve.y[i] - py];
  let u = 0;
  // Newton's steps to where the way from the curve is square to it.
  for (let round = 0; round < 4; round++) {
    const [p, v, a] = derivativesNear(near, u);
    const [bx, by] = [ox + p[0], oy + p[1]];
    const step = (bx * v[0] + by * v[1]) / (v[0] * v[0] + v[1] * v[1] + bx * a[0] + by * a[1]);
    if (!Number.isFinite(step)) return null;
    u = Math.min(Math.max(u - step, near.ends[0]), near.ends[1]);
  }
  const [p, v] = derivativesNear(near, u);
  const speed = Math.sqrt(v[0] * v[0] + v[1] * v[1]);
  if (!(speed > 0)) return null;
  const [nx, ny] = [-v[1] / speed, v[0] / speed];
  return [-nx * (ox + p[0]) - ny * (oy + p[1]), nx, ny];
}

// The curve about a sample with two others on either side; null of fewer than five samples.
function localPolynomial(curve, i) {
  if (curve.count < 5) return null;
  curve.localPolynomials[i] ??= fitLocalPolynomial(curve, i);
  return curve.localPolynomials[i];
}

function fitLocalPolynomial(curve, i) {
  const { count: n, closed, x, y, inputs, turn } = curve;
  // Near the end of an open curve the five are those next to the end.
  const shift = closed ? 0 : Math.max(2 - i, 0) + Math.min(n - 3 - i, 0);
  const s = new Float64Array(5);
  const divided = [new Float64Array(5), new Float64Array(5), new Float64Array(5)];
  let before = 0;
  for (let k = 0; k < 5; k++) {
    const at = i + k - 2 + shift;
    const sample = at < 0 ? at + n : at >= n ? at - n : at;
    const over = at < 0 ? -turn : at >= n ? turn : 0;
    if (k > 0) s[k] = s[k - 1] + Math.hypot(x[sample] - x[before], y[sample] - y[before]);
    divided[0][k] = x[sample] - x[i];
    divided[1][k] = y[sample] - y[i];
    divided[2][k] = inputs[sample] + over - inputs[i];
    before = sample;
  }
  const own = s[2 - shift];
  for (let k = 0; k < 5; k++) s[k] -= own;
  const [px, py, input] = divided.map((values) => newtonPowers(values, s));
  const end = (k) => s[Math.min(Math.max(k - shift, 0), 4)];
  const isSmooth = [-2, -1, 0, 1, 2].every((off) => {
    const k = neighbourSample(curve, i, off);
    return k < 0 || !curve.sharp[k];
  });
  return { x: px, y: py, input, ends: [end(1), end(3)], isSmooth };
}

// Through values at five places: divided differences, and from products of (u - s) to powers of u.
function newtonPowers(values, s) {
  for (let order = 1; order < 5; order++) {
    for (let k = 4; k >= order; k--) values[k] = (values[k] - values[k - 1]) * (1 / (s[k] - s[k - order]));
  }
  const powers = new Float64Array(5);
  for (let k = 4; k >= 0; k--) {
    for (let n = 4; n > 0; n--) powers[n] = powers[n - 1] - powers[n] * s[k];
    powers[0] = values[k] - powers[0] * s[k];
  }
  return powers;
}

// The place, from the sample, and its first two derivatives.
function derivativesNear({ x, y }, u) {
  const [p, v, a] = [
    [0, 0],
    [0, 0],
    [0, 0],
  ];
  for (let n = 4; n >= 0; n--) {
    for (const [k, c] of [
      [0, x[n]],
      [1, y[n]],
    ]) {
      a[k] = a[k] * u + v[k] * 2;
      v[k] = v[k] * u + p[k];
      p[k] = p[k] * u + c;
    }
  }
  return [p, v, a];
}

// The greatest value between the samples before and after, by thirds.
function maximumNear({ ends }, of) {
  let [a, b] = ends;
  // To 1e-7 of the way between samples: what is flat there is known to the square of that.
  for (let round = 0; round < 40; round++) {
    const [c, d] = [a + (b - a) / 3, b - (b - a) / 3];
    if (of(c) > of(d)) b = d;
    else a = c;
  }
  return of(a);
}
