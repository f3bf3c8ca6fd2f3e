// The parameters and measures of curves next to each other, with differences emphasized.

import { cellValues, measureValue } from "../../data/family.js";
import { h } from "../dom.js";
import { formatNumber, standaloneMeasureLabel, measureText } from "../labels.js";

/**
 * A table of parameters and measures of curves, [{ family, curve, name }]: a column for each, differing rows
 * first.
 */
export function factsTable(curves, measures, labels) {
  const rows = [...parameterRows(curves), ...measureRows(curves, measures)].filter(({ texts }) =>
    texts.some((text) => text !== "–"),
  );
  for (const row of rows) row.differs = row.texts.some((text) => text !== row.texts[0]);
  const line = ({ label, texts, differs }) =>
    h(
      "tr",
      { class: differs ? "differs" : "same" },
      h("th", { scope: "row" }, label),
      texts.map((text, k) =>
        h("td", { class: differs && text !== texts[0] ? "other" : null, "data-column": k + 1 }, text),
      ),
    );
  const same = rows.filter(({ differs }) => !differs);
  return h(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": "Comparison of parameters and measures" },
    h(
      "table",
      { class: "figures compared-facts" },
      h("caption", { class: "note" }, "Differences from the first curve are in bold."),
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("td", {}),
          labels.map((label) => h("th", { scope: "col" }, label)),
        ),
      ),
      h("tbody", {}, rows.filter(({ differs }) => differs).map(line)),
      same.length
        ? h(
            "tbody",
            { class: "alike" },
            h(
              "tr",
              {},
              h("th", { scope: "rowgroup", colspan: curves.length + 1, class: "note" }, "Identical"),
            ),
            same.map(line),
          )
        : null,
    ),
  );
}

function parameterRows(curves) {
  const names = [...new Set(curves.flatMap(({ family }) => family.names))];
  const value = ({ family, curve }, name) => {
    const at = family.names.indexOf(name);
    return at < 0 ? "–" : formatNumber(cellValues(family, family.curves.cell[curve])[at], 6);
  };
  const family = { label: "family", texts: curves.map((one) => one.family.title) };
  return [family, ...names.map((name) => ({ label: name, texts: curves.map((one) => value(one, name)) }))];
}

function measureRows(curves, measures) {
  return measures.map((measure) => ({
    label: standaloneMeasureLabel(measure.name),
    texts: curves.map(({ family, curve }) =>
      measureValue(family, curve, measure.name) === undefined ? "–" : measureText(family, curve, measure),
    ),
  }));
}
