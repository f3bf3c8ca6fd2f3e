// The options of the search by shape: whole or partial curves, mirror images, ranking; and its address,
// `?d=…` or `?like=evans:12.1.1`, and options; what the four-bars for it must be.

import { choiceBox, h, selectOf } from "../dom.js";

const DEFAULT_MIN_SHARE = 0.15;
const DEFAULT_MAX_LINK = 10;

/** Parses a query: `d` is a drawn shape, `like` the name of a curve; without `part` it is not known. */
export function parseShapeQuery(/** @type {Query} */ query) {
  /** @type {SearchOptions["by"]} */ const by = query.get("by") === "greatest" ? "greatest" : "rms";
  const least = Number(query.get("least"));
  const link = query.get("max-link");
  const maxLink = link === "inf" ? Infinity : Number(link);
  return {
    d: query.get("d"),
    like: query.get("like"),
    part: query.has("part") ? query.get("part") !== "no" : null,
    least: least > 0 && least <= 1 ? least : DEFAULT_MIN_SHARE,
    mirror: query.get("mirror") !== "no",
    by,
    families: query.get("family")?.split(",").filter(Boolean) ?? null,
    fullTurn: query.get("input") !== "any",
    maxLink: maxLink > 0 ? maxLink : DEFAULT_MAX_LINK,
  };
}

/** The inverse of parseShapeQuery. @param {ShapeQuery} _ */
export function formatShapeQuery({ d, like, part, least, mirror, by, families, fullTurn, maxLink }) {
  return {
    d,
    like,
    part: part === null ? null : part ? "yes" : "no",
    least: part && least !== DEFAULT_MIN_SHARE ? least : null,
    mirror: mirror ? null : "no",
    by: by === "rms" ? null : by,
    family: families?.join(","),
    input: fullTurn ? null : "any",
    "max-link": maxLink === DEFAULT_MAX_LINK ? null : maxLink === Infinity ? "inf" : maxLink,
  };
}

const MIN_SHARES = [0.05, 0.1, 0.15, 0.25, 0.5];

/** The controls of a query (query.js), which they change before calling `changed()`: { element, mark() }. */
export function shapeOptions(/** @type {ShapeQuery} */ query, changed) {
  const set = (name, value) => {
    query[name] = value;
    changed();
  };
  const isPart = (value) => ({ name: "shape-part", onchange: () => set("part", value) });
  const whole = choiceBox("radio", isPart(false), "a whole curve");
  const part = choiceBox("radio", isPart(true), "a part of a curve, at least");
  const mark = () => {
    whole.input.checked = !query.part;
    part.input.checked = query.part === true;
  };
  mark();
  const onchange = ({ target }) => set("mirror", target.checked);
  const mirror = choiceBox(
    "checkbox",
    { name: "mirror", checked: query.mirror, onchange },
    "Include mirror images",
  );
  const element = h(
    "fieldset.shape-options",
    h("legend", "The shape is"),
    whole.element,
    h(
      "div.toolbar",
      part.element,
      minShareSelect(query.least, (least) => set("least", least)),
    ),
    mirror.element,
    rankingSelect(query.by, (by) => set("by", by)),
  );
  return { element, mark };
}

function minShareSelect(least, choose) {
  const values = [...new Set([...MIN_SHARES, least])].sort((a, b) => a - b);
  const onchange = ({ target }) => choose(Number(target.value));
  const options = values.map((value) => [value, `${Math.round(100 * value)} %`]);
  return selectOf({ "aria-label": "Minimum part of a curve", onchange }, options, least);
}

function rankingSelect(by, choose) {
  const attributes = { id: "shape-by", onchange: ({ target }) => choose(target.value) };
  const options = ["rms", "greatest"].map((name) => [name, `${name} deviation`]);
  return h("span.field.row", h("label", { for: "shape-by" }, "Rank by"), selectOf(attributes, options, by));
}
