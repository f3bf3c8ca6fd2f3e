// Matches that are the same curve: cognates and families that overlap draw it again.

import { ShapeSearch, WHOLE } from "../../kernel/shape-search.js";

// Whole curves are the same to this part of their size, as four-bars of `find`.
const SAME = 1e-3;

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
    // The same curve deviates as much from the path.
    const { rms, greatest } = one.match;
    if (Math.abs(rms - match.rms) > SAME || Math.abs(greatest - match.greatest) > 3 * SAME) continue;
    if (one.match.outline.closed !== match.outline.closed) continue;
    const fit = await one.search.fit(match.outline);
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
