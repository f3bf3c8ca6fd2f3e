// The parameters and measures of curves next to each other, with differences emphasized.

import { cellValues, measureValue } from "../../data/family.js";
import { h } from "../dom.js";
import { formatNumber, measureText } from "../labels.js";

/**
 * A table of parameters and measures of curves: a column for each, differing rows first.
 * @param {CurveOfFamily[]} curves @param {Measure[]} measures @param {string[]} labels
 */
export function factsTable(curves, measures, labels) {
  const rows = [...parameterRows(curves), ...measureRows(curves, measures)]
    .filter(({ texts }) => texts.some((text) => text !== "–"))
    .map((row) => ({ ...row, differs: row.texts.some((text) => text !== row.texts[0]) }));
  /** @param {{ label: string, texts: (string | undefined)[], differs: boolean }} _ */
  const line = ({ label, texts, differs }) => {
    const cells = texts.map((text, k) =>
      h("td", { class: differs && text !== texts[0] ? "other" : null, "data-column": k + 1 }, text),
    );
    return h(differs ? "tr.differs" : "tr.same", h("th", { scope: "row" }, label), cells);
  };
  const heads = labels.map((label) => h("th", { scope: "col" }, label));
  const identical = h("th.note", { scope: "rowgroup", colspan: curves.length + 1 }, "Identical");
  const same = rows.filter(({ differs }) => !differs);
  return h(
    "div.scroll",
    { tabindex: "0", role: "region", "aria-label": "Comparison of parameters and measures" },
    h(
      "table.figures.compared-facts",
      h("caption.note", "Differences from the first curve are in bold."),
      h("thead", h("tr", h("td"), heads)),
      h("tbody", rows.filter(({ differs }) => differs).map(line)),
      same.length ? h("tbody.alike", h("tr", identical), same.map(line)) : null,
    ),
  );
}

function parameterRows(/** @type {CurveOfFamily[]} */ curves) {
  const names = [...new Set(curves.flatMap(({ family }) => family.names))];
  const value = (/** @type {CurveOfFamily} */ { family, curve }, /** @type {string} */ name) => {
    const at = family.names.indexOf(name);
    return at < 0 ? "–" : formatNumber(cellValues(family, family.curves.cell[curve])[at], 6);
  };
  const family = { label: "family", texts: curves.map((one) => one.family.title) };
  return [family, ...names.map((name) => ({ label: name, texts: curves.map((one) => value(one, name)) }))];
}

function measureRows(/** @type {CurveOfFamily[]} */ curves, /** @type {Measure[]} */ measures) {
  return measures.map((measure) => ({
    label: measure.title,
    texts: curves.map(({ family, curve }) =>
      measureValue(family, curve, measure.name) === undefined ? "–" : measureText(family, curve, measure),
    ),
  }));
}
