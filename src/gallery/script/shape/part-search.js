// Finds the curves with a portion like a shape, by the windows of the index.

import { resampledShape } from "./query-shape.js";
import { CHORDS, SPANS, WINDOW, directionOf, windowAt, windowCount } from "./shape-index.js";
import { correlation, WindowRefiner } from "./window-refiner.js";
import { normalised } from "./fourier.js";
import { Shortlist } from "./whole-search.js";

// The number of curves whose best windows are compared more closely.
const CLOSER = 600;

/**
 * Finds, step by step, the `most` curves of an index with a portion most like a shape, none shorter than `least`
 * of the curve's length, as `candidateCurves`. The index must have its windows.
 * @param {ShapeIndex} index @param {Shape} shape @returns {Generator<void, Candidate[]>}
 */
export function* candidateParts(index, shape, { mirror, least, most }) {
  const own = windowOf(shape);
  if (!own) return [];
  const best = newBestWindows(index.count);
  for (let s = 0; s < SPANS.length && (s === 0 || SPANS[s - 1] > least); s += 1)
    yield* scanSpan(index, s, own, mirror, best);
  const closer = new Shortlist(CLOSER);
  const refiner = new WindowRefiner(index);
  const refineSeeds = (curve, seeds, rounds) => {
    const moved = seeds.map((seed) => ({
      ...seed,
      ...refiner.refine(curve, own.orientations[seed.orientation], seed, 0.9 * least, rounds),
    }));
    return moved.sort((a, b) => b.value - a.value);
  };
  for (let curve = 0; curve < index.count; curve += 1) {
    // Windows are so far apart that their correlation is meaningful only after a round or two.
    const seeds = refineSeeds(curve, seedsOf(index, curve, own, best).slice(0, SEEDS), 2);
    if (seeds.length) closer.offer({ index, curve, value: seeds[0].value, seeds });
    if (curve % 128 === 127) yield;
  }
  const list = new Shortlist(most);
  let k = 0;
  for (const { curve, seeds } of closer.best()) {
    const [nearest] = refineSeeds(curve, seeds.slice(0, 3), 6);
    list.offer({ index, curve, value: nearest.value, seeds: [nearest] });
    if ((k += 1) % 32 === 0) yield;
  }
  return list.best();
}

/**
 * A shape as a window of unit energy, in four orientations, and the directions of its chords; null for a
 * point.
 */
function windowOf(/** @type {Shape} */ shape) {
  const { points } = resampledShape(shape, WINDOW, true);
  const re = Float64Array.from({ length: WINDOW }, (_, n) => points[2 * n]);
  const im = Float64Array.from({ length: WINDOW }, (_, n) => points[2 * n + 1]);
  if (!normalised(re, im)) return null;
  const ends = resampledShape(shape, CHORDS + 1, true).points;
  const chords = Uint8Array.from({ length: CHORDS }, (_, k) =>
    directionOf(ends[2 * k + 2] - ends[2 * k], ends[2 * k + 3] - ends[2 * k + 1]),
  );
  const back = (values) => values.slice().reverse();
  const mirrored = im.map((value) => -value);
  // 0 as given, 1 reversed, 2 and 3 their mirror images.
  const orientations = [
    { re, im },
    { re: back(re), im: back(im) },
    { re, im: mirrored },
    { re: back(re), im: back(mirrored) },
  ];
  return { chords, orientations };
}

/**
 * For each half of each curve and each orientation, the window whose chords, after rotation, differ least in
 * direction from the shape's.
 */
function newBestWindows(count) {
  const slots = SLOTS * count;
  return {
    difference: new Uint8Array(slots).fill(NOT_LIKE),
    span: new Uint8Array(slots),
    window: new Uint16Array(slots),
  };
}

// A window with this sum of differences of seven chords, in 256ths of a turn, is not like the shape at all.
const NOT_LIKE = 110;
// The number of windows kept of a curve: one that starts in each half of it, in each of four orientations.
const SLOTS = 8;
const SEEDS = 4;
// The difference of one chord, likewise.
const OTHER_CHORD = 28;

/** Compares the directions of the chords of all windows of a span. @param {ShapeIndex} index */
function* scanSpan(index, s, { chords }, mirror, best) {
  const each = windowCount(SPANS[s]);
  const away = Uint8Array.from({ length: 256 }, (_, k) => Math.min(k, 256 - k));
  const steps = Uint16Array.from({ length: CHORDS }, (_, k) => Math.round((k * SPANS[s] * each) / CHORDS));
  const turn = (chords[CHORDS - 1] - chords[0]) & 255;
  const slice = Math.max(Math.floor(30000 / each), 1);
  for (let from = 0; from < index.count; from += slice) {
    for (let curve = from; curve < Math.min(from + slice, index.count); curve += 1) {
      scanCurve(index, curve, s, { each, away, steps, turn, chords, mirror }, best);
    }
    yield;
  }
}

/**
 * Compares the windows of one curve. The first and the last chord alone exclude most windows: their angle
 * must be that of the shape, for the shape as given and for its reversed mirror image; or the opposite, for
 * the two other orientations.
 */
function scanCurve(/** @type {ShapeIndex} */ index, curve, s, given, best) {
  const { each, away, turn, mirror } = given;
  const windows = index.windows?.[s] ?? new Uint8Array();
  const base = curve * each;
  const beyond = base + each;
  const last = base + (index.closed[curve] ? each : Math.floor((1 - SPANS[s]) * each) + 1);
  const [before, after, end] = [given.steps[3], given.steps[4], given.steps[CHORDS - 1]];
  const { chords } = given;
  const [early, inner, late] = [chords[4] - chords[0], chords[4] - chords[3], chords[7] - chords[4]];
  const first = SLOTS * curve;
  let at = first;
  const half = base + (each >> 1);
  const { difference } = best;
  for (let from = base; from < last; from += 1) {
    at = from < half ? first : first + 4;
    const to = from + end < beyond ? from + end : from + end - each;
    const angle = windows[to] - windows[from];
    const same = away[(angle - turn) & 255];
    const other = away[(angle + turn) & 255];
    if (same >= OTHER_CHORD && other >= OTHER_CHORD) continue;
    // The two chords in the middle: their differences and those of the ends bound the sum of all from below.
    const third = windows[from + before < beyond ? from + before : from + before - each];
    const fourth = windows[from + after < beyond ? from + after : from + after - each];
    const [p, q, r] = [third - windows[from], fourth - third, windows[to] - fourth];
    if (same < OTHER_CHORD) {
      const middle = away[(q - inner) & 255];
      if (middle + away[(r - late) & 255] + away[(p + q - early) & 255] < difference[at])
        keepIfNearer(windows, base, from - base, given, 0, best, at, s);
      if (mirror && middle + away[(p - late) & 255] + away[(q + r - early) & 255] < difference[at + 3])
        keepIfNearer(windows, base, from - base, given, 3, best, at, s);
    }
    if (other < OTHER_CHORD) {
      const middle = away[(q + inner) & 255];
      if (middle + away[(p + late) & 255] + away[(q + r + early) & 255] < difference[at + 1])
        keepIfNearer(windows, base, from - base, given, 1, best, at, s);
      if (mirror && middle + away[(r + late) & 255] + away[(p + q + early) & 255] < difference[at + 2])
        keepIfNearer(windows, base, from - base, given, 2, best, at, s);
    }
  }
}

/**
 * Keeps a window, for an orientation, if its chords are nearer to the shape's than those of the best so far.
 */
function keepIfNearer(windows, base, w, given, orientation, best, at, s) {
  const most = best.difference[at + orientation];
  const sum = differenceOf(windows, base, w, given, orientation, most);
  if (sum >= most) return;
  best.difference[at + orientation] = sum;
  best.span[at + orientation] = s;
  best.window[at + orientation] = w;
}

/**
 * The sum of the differences in direction of a window's chords, turned so that the fourth agrees; or more
 * than `most`.
 */
function differenceOf(windows, base, w, { each, away, steps, chords }, orientation, most) {
  const reversed = orientation % 2 === 1;
  const sign = orientation < 2 ? 1 : -1;
  let sum = 0;
  let turned = 0;
  // From the middle outwards.
  for (let n = 0; n < CHORDS; n += 1) {
    const k = n % 2 ? (CHORDS - 1 - n) >> 1 : (CHORDS + n) >> 1;
    const at = w + steps[reversed ? CHORDS - 1 - k : k];
    const delta = sign * windows[base + (at < each ? at : at - each)] - chords[k];
    if (n === 0) turned = delta;
    const other = away[(delta - turned) & 255];
    sum += other;
    if (other > OTHER_CHORD || sum >= most) return most;
  }
  return sum;
}

/**
 * The best windows of a curve, one for each half and orientation that has one, with their correlations, the
 * best first.
 */
function seedsOf(/** @type {ShapeIndex} */ index, curve, own, best) {
  const [re, im] = [new Float64Array(WINDOW), new Float64Array(WINDOW)];
  const seeds = [];
  for (let at = SLOTS * curve; at < SLOTS * (curve + 1); at += 1) {
    const orientation = at % 4;
    if (best.difference[at] >= NOT_LIKE) continue;
    const span = SPANS[best.span[at]];
    const seed = {
      orientation,
      mirror: orientation >= 2,
      reversed: orientation % 2 === 1,
      span,
      start: best.window[at] / windowCount(span),
    };
    windowAt(index, curve, seed.start, span, re, im);
    seeds.push({ ...seed, value: correlation(own.orientations[orientation], re, im) });
  }
  return seeds.sort((a, b) => b.value - a.value);
}
