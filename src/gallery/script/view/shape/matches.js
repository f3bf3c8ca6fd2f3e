// Finds the curves of the atlas that are nearest to a path.

import { curveCaption, curveKey, curveOutline, givenCurves } from "../../data/family.js";
import { needPieces } from "../../data/needs.js";
import { KernelFailure } from "../../kernel/instance.js";
import { drawnPath, ShapeSearch, WHOLE } from "../../kernel/shape-search.js";
import { releaseIndex, shapeIndex } from "./indexes.js";

// The number of curves that are compared exactly.
const WANTED = 120;
// Whole curves are the same to this part of their size, as four-bars of `find`.
const SAME = 1e-3;
// The number of curves that are compared closely in a call.
const CLOSELY_PER_CALL = 64;

/**
 * The curves of some parts of families that are most like a shape, the nearest first; null if stopped. A closed shape
 * has whole curves near it, unless it is a part; an open one has open curves as wholes, and portions of others that are
 * as long as almost all of them. `progress(part, searched)` is called before each part.
 * @param {App} app @param {SearchedPart[]} parts @param {Outline} shape @param {SearchOptions} options
 * @param {AbortSignal} signal @param {(part: SearchedPart, searched: number) => void} progress
 */
export async function nearestCurves(app, parts, shape, options, signal, progress) {
  const { isPart, mirror, by } = options;
  const { curveSearch: kernel } = await app.kernel.load();
  const path = await drawnPath(kernel, shape, isPart);
  const least = isPart ? options.least : WHOLE;
  const search = await ShapeSearch.open(kernel, path, { mirror, least, wanted: WANTED });
  try {
    const found = await candidatesOf(app, kernel, search, parts, signal, progress);
    const isMany = found && found.length > WANTED;
    const candidates = isMany ? await nearestCandidates(search, found, signal) : found;
    const taken = candidates && (await takenCurves(candidates, signal));
    if (!taken) return null;
    /** @type {Match[]} */ const matches = [];
    for (const one of taken) {
      const { fit, invariants } = await search.fit(one.outline);
      if (fit) matches.push({ ...fit, ...one, invariants });
      if (signal.aborted) return null;
    }
    return matches.sort((a, b) => a[by] - b[by]);
  } finally {
    await search.close();
  }
}

/**
 * The likeliest curves of all parts, in their order; null if stopped.
 * @param {App} app @param {SearchKernel} kernel @param {ShapeSearch} search @param {SearchedPart[]} parts @param {AbortSignal} signal @param {(part: SearchedPart, searched: number) => void} progress
 */
async function candidatesOf(app, kernel, search, parts, signal, progress) {
  /** @type {(ShapeIndex & { before: number })[]} */ const searched = [];
  let count = 0;
  /** @type {number[]} */ let numbers = [];
  for (const part of parts) {
    progress(part, count);
    let index;
    try {
      index = await shapeIndex(kernel, part, signal);
    } catch (error) {
      if (error instanceof KernelFailure) throw error;
      app.announce(error.message);
      continue;
    }
    const found = index && (await search.compare(index, signal));
    if (index && !part.isKept) await releaseIndex(kernel, index);
    if (!index || !found) return null;
    numbers = Array.from(found);
    searched.push({ ...index, before: count });
    count += part.count;
  }
  return numbers
    .sort((a, b) => a - b)
    .map((number) => {
      const { family, first, before } = searched.findLast((index) => index.before <= number) ?? searched[0];
      return { family, curve: first + number - before };
    });
}

/**
 * Those that are wanted of the candidates, compared closely; null if stopped.
 * @param {ShapeSearch} search @param {CurveOfFamily[]} candidates @param {AbortSignal} signal @returns {Promise<CurveOfFamily[] | null>}
 */
async function nearestCandidates(search, candidates, signal) {
  /** @type {(CurveOfFamily & { likeness: number })[]} */ const compared = [];
  let room;
  for (let from = 0; from < candidates.length;) {
    const { family, curve } = candidates[from];
    const piece = family.outlines.ofCurve(curve);
    const isOther = (/** @type {CurveOfFamily} */ one) =>
      one.family !== family || family.outlines.ofCurve(one.curve) !== piece;
    const some = candidates.slice(from, from + CLOSELY_PER_CALL);
    const end = some.findIndex(isOther);
    some.length = end < 0 ? some.length : end;
    from += some.length;
    await needPieces(family, [piece]);
    if (signal.aborted) return null;
    const given = givenCurves(
      family,
      some.map((one) => one.curve),
      room,
    );
    const { likenesses, points = given.points } = await search.compareClosely(given);
    room = points.buffer;
    some.forEach(
      (one, k) => likenesses[k] === likenesses[k] && compared.push({ ...one, likeness: likenesses[k] }),
    );
  }
  return compared.sort((a, b) => b.likeness - a.likeness).slice(0, WANTED);
}

/** Takes curves out of their pieces; null if stopped. @param {CurveOfFamily[]} candidates @param {AbortSignal} signal */
async function takenCurves(candidates, signal) {
  /** @type {TakenCurve[]} */ const taken = [];
  for (const { family, curve } of candidates) {
    await needPieces(family, [family.outlines.ofCurve(curve)]);
    if (signal.aborted) return null;
    const name = `${family.id}:${curveKey(family, curve)}`;
    const caption = curveCaption(family, curve);
    taken.push({ family, curve, name, caption, outline: curveOutline(family, curve) });
  }
  return taken;
}

/**
 * The nearest matches (matches.js), at most `most`, each with the others whose whole curves are similar to it; null if stopped.
 * @param {App} app @param {Match[]} matches the nearest first @param {boolean} mirror whether mirror images are the same @param
 * {AbortSignal} signal @returns {Promise<MergedMatch[] | null>}
 */
export async function mergedMatches(app, matches, /** @type {number} */ most, mirror, signal) {
  const { curveSearch: kernel } = await app.kernel.load();
  /** @type {(MergedMatch & { search: ShapeSearch })[]} */ const merged = [];
  try {
    for (const match of matches) {
      const { outline } = match;
      const same = await sameAmong(merged, match);
      if (same) same.others.push(match);
      else if (merged.length < most) {
        // A shape with symmetries is fitted in several ways: curves are compared wherever they are.
        const path = { points: outline.points, kind: outline.closed ? "closed" : "part" };
        const search = await ShapeSearch.open(kernel, path, { mirror, least: WHOLE });
        merged.push({ match, search, others: [] });
      }
      if (signal.aborted) return null;
    }
    return merged;
  } finally {
    for (const { search } of merged) await search.close();
  }
}

/** @param {(MergedMatch & { search: ShapeSearch })[]} merged @param {Match} match */
async function sameAmong(merged, match) {
  for (const one of merged) {
    const { outline, invariants } = one.match;
    if (outline.closed !== match.outline.closed) continue;
    if (invariants.some((value, k) => Math.abs(value - match.invariants[k]) > 3 * SAME)) continue;
    const { fit } = await one.search.fit(match.outline);
    if (fit && fit.rms < SAME && Math.abs(fit.to - fit.from) > 1 - SAME) return one;
  }
  return null;
}

/** The families of a match, "Evans; Chebyshev and 5 more curves". */
export function familiesText(/** @type {MergedMatch} */ { match, others }) {
  const [first, second] = new Set([match, ...others].map(({ family }) => family.title));
  const rest = others.length - (second ? 1 : 0);
  const named = second ? `${first}; ${second}` : first;
  return rest ? `${named} and ${rest} more ${rest === 1 ? "curve" : "curves"}` : named;
}
