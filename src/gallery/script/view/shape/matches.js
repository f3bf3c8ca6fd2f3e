// Finds the curves of the atlas that are nearest to a path.

import { curveKey, curveOutline } from "../../data/family.js";
import { needCurves, needPieces } from "../../data/needs.js";
import { drawnPath, ShapeSearch, WHOLE } from "../../kernel/shape-search.js";
import { releaseIndex, shapeIndex } from "./indexes.js";

// The number of curves that are compared exactly.
const WANTED = 120;

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
    const candidates =
      found && found.length > WANTED ? await nearestCandidates(search, found, signal) : found;
    if (!candidates) return null;
    /** @type {Match[]} */ const matches = [];
    for (const { family, curve } of candidates) {
      const fit = await search.fit(await loadedOutline(family, curve));
      const name = `${family.id}:${curveKey(family, curve)}`;
      if (fit) matches.push({ ...fit, family, curve, name });
      if (signal.aborted) return null;
    }
    return matches.sort((a, b) => a[by] - b[by]);
  } finally {
    await search.close();
  }
}

/**
 * The likeliest curves of all parts; null if stopped.
 * @param {App} app @param {SearchKernel} kernel @param {ShapeSearch} search @param {SearchedPart[]} parts @param {AbortSignal} signal @param {(part: SearchedPart, searched: number) => void} progress
 */
async function candidatesOf(app, kernel, search, parts, signal, progress) {
  /** @type {Candidate[]} */ let candidates = [];
  let searched = 0;
  for (const part of parts) {
    progress(part, searched);
    try {
      await needPieces(part.family, part.pieces);
    } catch (error) {
      app.announce(error.message);
      continue;
    }
    if (signal.aborted) return null;
    const index = await shapeIndex(kernel, part, signal);
    const found = index && (await search.candidates(index, signal));
    if (index && !part.isKept) await releaseIndex(kernel, index);
    if (!found) return null;
    candidates = likeliest([...candidates, ...found], search.most);
    searched += part.count;
  }
  return candidates;
}

/**
 * Those that are wanted of the candidates, compared closely; null if stopped.
 * @param {ShapeSearch} search @param {Candidate[]} candidates @param {AbortSignal} signal
 */
async function nearestCandidates(search, candidates, signal) {
  /** @type {Candidate[]} */ const compared = [];
  for (const { family, curve } of candidates) {
    const likeness = await search.likeness(await loadedOutline(family, curve));
    if (likeness !== null) compared.push({ family, curve, likeness });
    if (signal.aborted) return null;
  }
  return likeliest(compared, WANTED);
}

function likeliest(/** @type {Candidate[]} */ candidates, /** @type {number} */ most) {
  return candidates.sort((a, b) => b.likeness - a.likeness).slice(0, most);
}

/** @returns {Promise<Outline>} */
async function loadedOutline(/** @type {Family} */ family, /** @type {number} */ curve) {
  await needCurves(family, [curve]);
  return curveOutline(family, curve);
}
