// The atlas: the summary of all families, and the data of each family, loaded on first use.

import { FamilyReader } from "./family.js";

/**
 * Opens the atlas of `document`: { title, program, measures, families: [{ id, title, … }], book, family(id)
 * }.
 *
 * A page opened from disk cannot fetch files but can load scripts; the scripts of families call
 * `couplerAtlas`.
 */
export function openAtlas(document, window) {
  const summary = JSON.parse(document.getElementById("atlas").textContent);
  const loading = new Map();
  let reader = null;
  let loaded = null;
  window.couplerAtlas = {
    begin: (head) => {
      reader = new FamilyReader(head);
    },
    cells: (chunk) => reader.cells(chunk),
    page: (page) => reader.page(page),
    end: () => {
      loaded = reader.finish();
    },
  };
  const load = (shown) =>
    new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = shown.script;
      const failed = () => reject(new Error(`${shown.script} cannot be read: render the atlas again`));
      // Scripts run one at a time, each followed by its load event.
      script.onload = () => {
        script.remove();
        if (loaded?.id === shown.id) resolve(loaded);
        else failed();
        reader = loaded = null;
      };
      script.onerror = failed;
      document.head.append(script);
    });
  const family = (id) => {
    const shown = summary.families.find((candidate) => candidate.id === id);
    if (!shown?.script) return Promise.reject(new Error(`there is no family “${id}” in this atlas`));
    if (!loading.has(id)) loading.set(id, load(shown));
    return loading.get(id);
  };
  return { ...summary, family };
}

/** The file of a page, numbered from 1; null if the family's pages are not written as files. */
export function pageFile(atlas, id, page) {
  const shown = atlas.families.find((family) => family.id === id);
  if (!shown?.page_format || page > shown.pages) return null;
  return `${id}/${id}-${String(page).padStart(3, "0")}.${shown.page_format}`;
}
