// The atlas: the summary of all families, and the data of each family and the kernel, loaded on first use.

import { unpackGzip } from "./packed.js";
import { headReader, PieceReader } from "./reader.js";

// The size of the files whose points are kept, in bytes: a search takes from them what it needs, one after another.
const MAX_KEPT_BYTES = 48e6;

/**
 * Opens the atlas of a document: its summary, `family(id)`, which resolves to a family (reader.js) when its head is loaded, and
 * `kernelModule()`, to the module of the kernel, unpacked. The file of a plate (view/export/plate-file.js) has it in its summary.
 *
 * A page opened from disk cannot fetch files but can load scripts; the scripts of families and the kernel call `couplerAtlas`.
 * @param {Document} document @param {Window & { couplerAtlas?: Statements }} window
 */
export function openAtlas(document, window) {
  /** @type {AtlasSummary} */ const summary = JSON.parse(document.getElementById("atlas")?.textContent ?? "");
  /** @type {Map<string, Promise<Family>>} */ const heads = new Map();
  /** @type {Map<string, Family>} */ const families = new Map();
  const cache = outlineCache();
  /** @type {PieceReader | null} */ let reader = null;
  /** @type {{ family?: Family, piece?: Piece, kernel?: KernelFile } | null} */ let finished = null;
  window.couplerAtlas = {
    begin: (head) => {
      reader = headReader(head);
    },
    piece: ({ id, series, number }) => {
      const family = families.get(id);
      const piece = family?.[series === "table" ? "table" : "outlines"].pieces[number - 1];
      reader = family && piece ? new PieceReader(family, [piece]) : null;
    },
    cells: (rows) => reader?.cells(rows),
    curves: (outlines, comment) => reader?.curves(outlines, comment),
    page: (page) => reader?.page(page),
    end: () => {
      finished = reader && { family: reader.finish(), piece: reader.pieces[0] };
    },
    kernel: (kernel) => {
      finished = { kernel };
    },
  };
  /**
   * Runs a script; resolves to what `accept` takes of it. Scripts run one at a time, each followed by its load event.
   * @template T @param {string} file @param {(done: NonNullable<typeof finished>) => T | undefined | false} accept @returns {Promise<T>}
   */
  const run = (file, accept) =>
    new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = file;
      const failed = () => {
        script.remove();
        reject(new Error(`${file} cannot be read: render the atlas again`));
      };
      script.onload = () => {
        const accepted = finished && accept(finished);
        reader = finished = null;
        if (!accepted) return failed();
        script.remove();
        return resolve(accepted);
      };
      script.onerror = failed;
      document.head.append(script);
    });
  /** @param {Piece} piece */
  const load = async (piece) => {
    piece.loading ??= run(piece.file, (done) => done.piece === piece).finally(() => {
      piece.loading = null;
    });
    await piece.loading;
    cache.use(piece);
  };
  const loadHead = async (/** @type {string} */ id, /** @type {string} */ script) => {
    const head = await run(script, ({ family }) => family?.id === id && family);
    families.set(id, Object.assign(head, { load, used: cache.use }));
    return head;
  };
  const family = (/** @type {string} */ id) => {
    const script = summary.families.find((candidate) => candidate.id === id)?.script;
    const head = heads.get(id) ?? (script && loadHead(id, script));
    if (!head) return Promise.reject(new Error(`there is no family “${id}” in this atlas`));
    heads.set(id, head);
    return head;
  };
  const { script, sha256, module } = summary.kernel;
  /** @returns {Promise<KernelFile>} */ const kernelFile = async () => {
    if (module) return { sha256, module };
    const file = await run(script, (done) => done.kernel);
    if (file.sha256 === sha256) return file;
    throw new Error(`${script} is of another version than this page: render the atlas again`);
  };
  const kernelModule = async () =>
    unpackGzip((await kernelFile()).module).catch((error) => {
      throw new Error(`${script} is damaged: render the atlas again`, { cause: error });
    });
  return { ...summary, family, kernelFile, kernelModule };
}

// A family with more pages than this has them in subfolders of as many.
const PAGES_PER_FOLDER = 1000;

/** A family as the atlas lists it. */
export function listedFamily(/** @type {Atlas} */ { families }, /** @type {string} */ id) {
  const listed = families.find((family) => family.id === id);
  if (!listed) throw new Error(`there is no family “${id}” in this atlas`);
  return listed;
}

/** The file of a page, numbered from 1; null if the family's pages are not written as files. */
export function pageFile(/** @type {Atlas} */ atlas, /** @type {string} */ id, /** @type {number} */ page) {
  const shown = atlas.families.find((family) => family.id === id);
  if (!shown?.page_format || page > shown.pages) return null;
  const name = `${id}-${String(page).padStart(3, "0")}.${shown.page_format}`;
  return `${id}/${pageFolder(page, shown.pages)}${name}`;
}

/** The subfolder of a page of `pages`, "0001-1000/"; empty if the pages have none. */
function pageFolder(/** @type {number} */ page, /** @type {number} */ pages) {
  if (pages <= PAGES_PER_FOLDER) return "";
  const first = PAGES_PER_FOLDER * Math.floor((page - 1) / PAGES_PER_FOLDER) + 1;
  const last = Math.min(first + PAGES_PER_FOLDER - 1, pages);
  const digits = Math.max(String(pages).length, 4);
  return `${[first, last].map((number) => String(number).padStart(digits, "0")).join("-")}/`;
}

/**
 * Keeps the pieces of points that were used last, up to `maxBytes` of files, and those that are held (needs.js); `use(piece)` is called
 * with a loaded piece. Pieces of tables are kept, since they are small; those in the head of a family have no file to be loaded from again.
 */
export function outlineCache(maxBytes = MAX_KEPT_BYTES) {
  /** The pieces with data, the one used last at the end. @type {Set<Piece>} */
  const kept = new Set();
  const use = (/** @type {Piece} */ piece) => {
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
