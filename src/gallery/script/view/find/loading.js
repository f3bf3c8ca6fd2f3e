// Selects the families to search, and loads their tables without blocking the page.

import { needPieces } from "../../data/needs.js";
import { sumOf } from "../../data/number.js";
import { buttonOf, choiceBox, fill, h, nextTurn } from "../dom.js";
import { formatBytes, formatCount } from "../labels.js";

// Data up to this size, in bytes, are loaded without a request.
export const MAX_AUTOLOAD_BYTES = 48e6;

/** The families that a query needs: those it names, or all that have curves. */
export function requestedFamilies(/** @type {Atlas} */ atlas, /** @type {string[] | null} */ ids) {
  const withCurves = atlas.families.filter(({ script, curves }) => script && curves > 0);
  return ids ? withCurves.filter(({ id }) => ids.includes(id)) : withCurves;
}

/**
 * Loads the tables of families, piece after piece, up to `limit` bytes and at least one piece. Calls `onLoad` with
 * the families loaded so far, at least in part, occasionally and at the end; `onError` with the message for data
 * that cannot be read, which are skipped.
 * @param {Atlas} atlas @param {ListedFamily[]} listed @param {number} limit @param {AbortSignal} signal
 * @param {(families: Family[], state: LoadState) => void} onLoad @param {(message: string) => void} onError
 */
export async function loadTables(atlas, listed, limit, signal, onLoad, onError) {
  /** @type {Family[]} */ const there = [];
  const total = sumOf(listed, ({ curves }) => curves);
  const size = sumOf(listed, (family) => family.table_bytes);
  let [loadedBytes, reportedAt, pause] = [0, performance.now(), 400];
  const report = async (/** @type {boolean} */ done) => {
    const began = performance.now();
    const curves = sumOf(there, loadedCurves);
    onLoad([...there], { done, curves, total, bytes: size });
    await nextTurn();
    reportedAt = performance.now();
    pause = Math.max(400, 4 * (reportedAt - began));
  };
  const loadPiece = async (/** @type {Family} */ family, /** @type {Piece} */ piece) => {
    await needPieces(family, [piece]);
    loadedBytes += piece.bytes;
    if (!signal.aborted && performance.now() - reportedAt >= pause) await report(false);
  };
  const loadFamily = async (/** @type {ListedFamily} */ { id, table_bytes: bytes }) => {
    const family = await atlas.family(id);
    there.push(family);
    if (family.table.bytes === 0) loadedBytes += bytes;
    for (const piece of family.table.pieces) {
      if (signal.aborted) return;
      if (piece.data === null && loadedBytes > 0 && loadedBytes + piece.bytes > limit) return;
      await loadPiece(family, piece);
    }
  };
  for (const family of listed) {
    if (loadedBytes > 0 && family.curves > 0 && loadedBytes >= limit) break;
    try {
      await loadFamily(family);
    } catch (error) {
      onError(error.message);
    }
    if (signal.aborted) return;
    if (performance.now() - reportedAt >= pause) await report(false);
    if (signal.aborted) return;
  }
  await report(true);
}

/** The number of curves of a family, from the first, whose table is loaded. @param {Family} _ */
export function loadedCurves({ table, curves: { count } }) {
  return table.pieces[table.loadedPieces]?.firstCurve ?? count;
}

/** A line below the count of a search: how many curves are not loaded, and a button that calls `load()`. Empty while loading goes on, or if all are loaded. */
export function loadAllLine(/** @type {() => void} */ load) {
  const element = h("p.load-all.toolbar", { hidden: true });
  const text = (/** @type {LoadState} */ { curves, total }) =>
    `${formatCount(total - curves, "curve is", "curves are")} not loaded`;
  const show = (/** @type {LoadState | null} */ state) => {
    const isLine = state?.done && state.curves < state.total;
    element.hidden = !isLine;
    if (!isLine) return fill(element);
    const { total, bytes } = state;
    const words = `Load all ${formatCount(total, "curve")} (${formatBytes(bytes)})`;
    return fill(element, h("span.note", text(state)), " ", buttonOf(words, load));
  };
  return { element, show, text };
}

/**
 * Checkboxes for the families of an atlas; calls `changed(ids)` with those checked, null for all. Null if there is only one family.
 * @param {(ids: string[] | null) => void} changed
 */
export function familyChooser(/** @type {Atlas} */ atlas, /** @type {ListedFamily[]} */ loaded, changed) {
  const withCurves = requestedFamilies(atlas, null);
  if (withCurves.length < 2) return null;
  const ids = withCurves.map(({ id }) => id);
  const chosen = new Set(loaded.map(({ id }) => id));
  const bytes = sumOf(withCurves, (family) => family.bytes);
  const tick = (/** @type {string} */ id) => {
    if (!chosen.delete(id)) chosen.add(id);
    changed(chosen.size === ids.length ? null : ids.filter((one) => chosen.has(one)));
  };
  const box = (/** @type {ListedFamily} */ { id, title, curves }) => {
    const attributes = { checked: chosen.has(id), onchange: () => tick(id) };
    const label = [h("span", title), h("span.count", curves.toLocaleString("en"))];
    return choiceBox("checkbox", attributes, label).element;
  };
  /** @param {string} label @param {string[]} ids */
  const choose = (label, ids) => buttonOf(label, () => changed(ids), { class: "quiet" });
  const all = choose(`All (${formatBytes(bytes)})`, ids);
  return h(
    "details.more-filters",
    { open: chosen.size === 0 },
    h("summary", "Families", h("span.note", ` ${chosen.size} of ${withCurves.length}`)),
    h("div.toolbar", all, choose("None", [])),
    h("fieldset.words", h("legend.visually-hidden", "Families"), withCurves.map(box)),
  );
}
