// Drops the points of curves that are no longer needed.

/** The size of the files whose points are kept, in bytes: more than a search loads without a request. */
const MAX_KEPT_BYTES = 64e6;

/**
 * Keeps the pieces of points that were used last, up to `maxBytes` of files, and those that are held
 * (needs.js); `use(piece)` is called with a loaded piece. Pieces of tables are kept, since they are small;
 * those in the head of a family have no file to be loaded from again.
 */
export function outlineCache(maxBytes = MAX_KEPT_BYTES) {
  // The pieces with data, the one used last at the end.
  const kept = new Set();
  const use = (piece) => {
    if (piece.name === "table" || piece.bytes === 0) return;
    const isNew = !kept.delete(piece);
    kept.add(piece);
    if (!isNew) return;
    let bytes = [...kept].reduce((sum, one) => sum + one.bytes, 0);
    for (const one of kept) {
      if (bytes <= maxBytes) return;
      if (one === piece || one.holds > 0) continue;
      one.data = null;
      kept.delete(one);
      bytes -= one.bytes;
    }
  };
  return { use };
}
