// Selects the families to search.

import { h } from "../dom.js";
import { formatBytes } from "../footer.js";

/**
 * Checkboxes for the families of an atlas; calls `changed(ids)` with those checked, null for all. Null if
 * there is only one family.
 */
export function familyChooser(atlas, loaded, changed) {
  const withCurves = atlas.families.filter(({ script, curves }) => script && curves > 0);
  if (withCurves.length < 2) return null;
  const chosen = new Set(loaded.map(({ id }) => id));
  const bytes = withCurves.reduce((sum, family) => sum + (family.bytes ?? 0), 0);
  const tick = (id) => {
    if (!chosen.delete(id)) chosen.add(id);
    changed(
      chosen.size === withCurves.length
        ? null
        : withCurves.map((family) => family.id).filter((one) => chosen.has(one)),
    );
  };
  const box = (family) => {
    const input = h("input", { type: "checkbox", onchange: () => tick(family.id) });
    input.checked = chosen.has(family.id);
    return h(
      "label",
      { class: "check" },
      input,
      h("span", {}, family.title),
      h("span", { class: "count" }, family.curves.toLocaleString("en")),
    );
  };
  return h(
    "details",
    { class: "more-filters", open: chosen.size === 0 },
    h("summary", {}, "Families", h("span", { class: "note" }, ` ${chosen.size} of ${withCurves.length}`)),
    h(
      "div",
      { class: "toolbar" },
      h(
        "button",
        { type: "button", class: "quiet", onclick: () => changed(withCurves.map(({ id }) => id)) },
        `All (${formatBytes(bytes)})`,
      ),
      h("button", { type: "button", class: "quiet", onclick: () => changed([]) }, "None"),
    ),
    h(
      "fieldset",
      { class: "words" },
      h("legend", { class: "visually-hidden" }, "Families"),
      withCurves.map(box),
    ),
  );
}
