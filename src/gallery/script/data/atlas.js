// The atlas: the summary of all families, and the data of each family, loaded on first use.

import { outlineCache } from "./cache.js";
import { FamilyReader, PieceReader } from "./reader.js";

/**
 * Opens the atlas of `document`: { title, program, measures, families: [{ id, title, … }], book, family(id)
 * }. `family(id)` resolves to a family (reader.js) when its head is loaded; its method `load(piece)` loads a
 * piece, and `used(piece)` keeps a loaded one from being dropped soon.
 *
 * A page opened from disk cannot fetch files but can load scripts; the scripts of families call
 * `couplerAtlas`.
 */
export function openAtlas(document, window) {
  const summary = JSON.parse(document.getElementById("atlas").textContent);
  const heads = new Map();
  const families = new Map();
  const cache = outlineCache();
  let reader = null;
  let finished = null;
  window.couplerAtlas = {
    begin: (head) => {
      reader = new FamilyReader(head);
    },
    piece: ({ id, series, number }) => {
      const family = families.get(id);
      const piece = (series === "table" ? family?.table : family?.outlines)?.pieces[number - 1];
      reader = piece ? new PieceReader(family, piece) : null;
    },
    cells: (rows) => reader?.cells(rows),
    curves: (outlines) => reader?.curves(outlines),
    page: (page) => reader?.page(page),
    end: () => {
      finished = { result: reader?.finish(), piece: reader?.piece };
    },
  };
  // Scripts run one at a time, each followed by its load event.
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
  const loadPiece = (family, piece) => {
    piece.loading ??= run(piece.file, (done) => done.piece === piece).finally(() => {
      piece.loading = null;
    });
    return piece.loading.then(() => cache.use(piece));
  };
  const loadHead = (shown) =>
    run(shown.script, ({ result }) => result?.id === shown.id && result).then((family) => {
      families.set(shown.id, family);
      family.load = (piece) => loadPiece(family, piece);
      family.used = (piece) => cache.use(piece);
      return family;
    });
  const family = (id) => {
    const shown = summary.families.find((candidate) => candidate.id === id);
    if (!shown?.script) return Promise.reject(new Error(`there is no family “${id}” in this atlas`));
    if (!heads.has(id)) heads.set(id, loadHead(shown));
    return heads.get(id);
  };
  return { ...summary, family };
}

// A family with more pages than this has them in subfolders of as many.
const PAGES_PER_FOLDER = 1000;

/** The file of a page, numbered from 1; null if the family's pages are not written as files. */
export function pageFile(atlas, id, page) {
  const shown = atlas.families.find((family) => family.id === id);
  if (!shown?.page_format || page > shown.pages) return null;
  const name = `${id}-${String(page).padStart(3, "0")}.${shown.page_format}`;
  return `${id}/${pageFolder(page, shown.pages)}${name}`;
}

/** The subfolder of a page of `pages`, "0001-1000/"; empty if the pages have none. */
function pageFolder(page, pages) {
  if (pages <= PAGES_PER_FOLDER) return "";
  const first = PAGES_PER_FOLDER * Math.floor((page - 1) / PAGES_PER_FOLDER) + 1;
  const last = Math.min(first + PAGES_PER_FOLDER - 1, pages);
  const digits = Math.max(String(pages).length, 4);
  return `${[first, last].map((number) => String(number).padStart(digits, "0")).join("-")}/`;
}
