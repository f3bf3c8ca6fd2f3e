// Families for what looks through many of them: loaded one after another, so that the page stays awake.

// An atlas up to this size, in bytes, is loaded whole without being asked.
const MAX_AUTOLOAD_BYTES = 48e6;

/**
 * The families that a question is about: those it names, or all if they are not too much together, or none.
 */
export function requestedFamilies(atlas, ids) {
  const withCurves = atlas.families.filter(({ script, curves }) => script && curves > 0);
  if (ids) return withCurves.filter(({ id }) => ids.includes(id));
  const bytes = withCurves.reduce((sum, family) => sum + (family.bytes ?? 0), 0);
  return bytes <= MAX_AUTOLOAD_BYTES ? withCurves : [];
}

/**
 * Loads families one after another; `come(families, done, all)` is told of those that are there, now and then
 * and at the end. Gives a function that stops it. A family that cannot be read is told to `trouble` and left
 * out.
 */
export function loadFamilies(atlas, listed, come, trouble) {
  let stopped = false;
  const there = [];
  const load = async () => {
    let told = performance.now();
    for (const [k, { id }] of listed.entries()) {
      try {
        there.push(await atlas.family(id));
      } catch (error) {
        trouble(error.message);
      }
      if (stopped) return;
      const isLast = k === listed.length - 1;
      if (!isLast && performance.now() - told < 400) continue;
      come([...there], k + 1, listed.length);
      // A pause for what has been pressed meanwhile.
      await new Promise((resume) => {
        setTimeout(resume, 0);
      });
      told = performance.now();
    }
    if (!listed.length) come([], 0, 0);
  };
  load();
  return () => {
    stopped = true;
  };
}

/** Bytes in words: "6.4 MB". */
export function formatFamilyBytes(bytes) {
  return bytes < 1e6 ? `${Math.round(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}
