// Loads the tables of families without blocking the page.

import { needPieces } from "../../data/needs.js";

// Data up to this size, in bytes, are loaded without a request.
export const MAX_AUTOLOAD_BYTES = 48e6;

/** The families that a query needs: those it names, or all that have curves. */
export function requestedFamilies(atlas, ids) {
  const withCurves = atlas.families.filter(({ script, curves }) => script && curves > 0);
  return ids ? withCurves.filter(({ id }) => ids.includes(id)) : withCurves;
}

/**
 * Loads the tables of families, `listed` in the atlas, piece after piece, up to `limit` bytes and at least
 * one piece. Calls `onLoad(families, state)` with the families loaded so far, at least in part, occasionally
 * and at the end; `state` is { done, curves, total, bytes }: whether loading has ended, the number of curves
 * loaded, of all, and the size of their tables. Calls `onError` with the message for data that cannot be
 * read, which are skipped. Returns a function that stops loading.
 */
export function loadTables(atlas, listed, limit, onLoad, onError) {
  let stopped = false;
  const there = [];
  const total = listed.reduce((sum, { curves }) => sum + curves, 0);
  const size = listed.reduce((sum, { table_bytes: bytes }) => sum + bytes, 0);
  let [loadedBytes, reportedAt, pause] = [0, performance.now(), 400];
  const report = async (done) => {
    const began = performance.now();
    const curves = there.reduce((sum, family) => sum + loadedCurves(family), 0);
    onLoad([...there], { done, curves, total, bytes: size });
    // Lets the page handle input meanwhile.
    await new Promise((resume) => {
      setTimeout(resume, 0);
    });
    reportedAt = performance.now();
    pause = Math.max(400, 4 * (reportedAt - began));
  };
  const loadPiece = async (family, piece) => {
    await needPieces(family, [piece]);
    loadedBytes += piece.bytes;
    if (!stopped && performance.now() - reportedAt >= pause) await report(false);
  };
  const loadFamily = async ({ id, table_bytes: bytes }) => {
    const family = await atlas.family(id);
    there.push(family);
    if (family.table.bytes === 0) loadedBytes += bytes;
    for (const piece of family.table.pieces) {
      if (stopped) return;
      if (piece.data === null && loadedBytes > 0 && loadedBytes + piece.bytes > limit) return;
      await loadPiece(family, piece);
    }
  };
  const load = async () => {
    for (const family of listed) {
      if (loadedBytes > 0 && family.curves > 0 && loadedBytes >= limit) break;
      try {
        await loadFamily(family);
      } catch (error) {
        onError(error.message);
      }
      if (stopped) return;
      if (performance.now() - reportedAt >= pause) await report(false);
      if (stopped) return;
    }
    await report(true);
  };
  load();
  return () => {
    stopped = true;
  };
}

/** The number of curves of a family, from the first, whose table is loaded. */
export function loadedCurves({ table, curves: { count } }) {
  return table.pieces[table.loadedPieces]?.firstCurve ?? count;
}
