// Loads families one after another without blocking the page.

// An atlas up to this size, in bytes, is loaded completely without a request.
const MAX_AUTOLOAD_BYTES = 48e6;

/** The families that a query needs: those it names, or all if they are not too large together, or none. */
export function requestedFamilies(atlas, ids) {
  const withCurves = atlas.families.filter(({ script, curves }) => script && curves > 0);
  if (ids) return withCurves.filter(({ id }) => ids.includes(id));
  const bytes = withCurves.reduce((sum, family) => sum + (family.bytes ?? 0), 0);
  return bytes <= MAX_AUTOLOAD_BYTES ? withCurves : [];
}

/**
 * Loads families one after another. Calls `onLoad(families, done, all)` with those loaded so far,
 * occasionally and at the end, and `onError` with the message for a family that cannot be read, which is
 * skipped. Returns a function that stops loading.
 */
export function loadFamilies(atlas, listed, onLoad, onError) {
  let stopped = false;
  const there = [];
  const load = async () => {
    let reportedAt = performance.now();
    for (const [k, { id }] of listed.entries()) {
      try {
        there.push(await atlas.family(id));
      } catch (error) {
        onError(error.message);
      }
      if (stopped) return;
      const isLast = k === listed.length - 1;
      if (!isLast && performance.now() - reportedAt < 400) continue;
      onLoad([...there], k + 1, listed.length);
      // Lets the page handle input meanwhile.
      await new Promise((resume) => {
        setTimeout(resume, 0);
      });
      reportedAt = performance.now();
    }
    if (!listed.length) onLoad([], 0, 0);
  };
  load();
  return () => {
    stopped = true;
  };
}
