// The layout of By shape, the target on the left and results on the right, and its controls: how curves are compared, and what four-bars must be.

import { boxOfPoints } from "../../draw/plane-view.js";
import { buttonOf, choiceBox, fill, h } from "../dom.js";
import { PathField } from "./path-field.js";
import { numbersOf } from "./query.js";

const percents = (/** @type {number} */ value) => `${Math.round(100 * value)} %`;

/** How curves of the atlas are compared with the shape. @param {Store<ShapeQuery>} store */
export function shapeOptions(store) {
  /** @param {boolean} part */
  const isPart = (part) => ({ name: "shape-part", onchange: () => store.change({ part }) });
  const whole = choiceBox("radio", isPart(false), "a whole curve");
  const part = choiceBox("radio", isPart(true), "a part of a curve, at least");
  const least = selectBox(store, "least", "Minimum part of a curve", [0.05, 0.1, 0.15, 0.25, 0.5], percents);
  const mirror = checkBox(store, "mirror", "Include mirror images");
  const by = selectBox(store, "by", "Rank by", ["rms", "greatest"], (name) => `by ${name} deviation`);
  store.watch((state) => {
    whole.input.checked = state.part === false;
    part.input.checked = state.part === true;
  });
  const rows = [h("div.toolbar", whole.element, part.element, least), h("div.toolbar", mirror, by)];
  return h("fieldset.shape-options", h("legend", "The shape is"), rows);
}

/** What four-bars must be, as `find` has it: chips that are on or off. @param {Store<ShapeQuery>} store @param {() => Outline | null} shape */
export function fourBarChips(store, shape) {
  const anyMu = (/** @type {number} */ mu) => (mu ? `μ at least ${mu}°` : "any μ");
  /** @param {number} length */
  const links = (length) => (length === Infinity ? "links of any length" : `links up to ${length} S`);
  const box = choiceBox("checkbox", {}, "Pivots in a box");
  box.input.onchange = () => store.change({ pivots: box.input.checked ? boxAround(shape()) : null });
  const corners = h("input", { "aria-label": "Corners of the box, x, y, x, y", size: 18 });
  corners.onchange = () => {
    const pivots = numbersOf(corners.value, 4);
    corners.setAttribute("aria-invalid", String(!pivots));
    if (pivots) store.change({ pivots });
  };
  const show = (/** @type {Pick<ShapeQuery, "pivots">} */ { pivots }) => {
    box.input.checked = pivots !== null;
    corners.hidden = pivots === null;
    corners.value = pivots?.join(", ") ?? "";
    corners.setAttribute("aria-invalid", "false");
  };
  corners.onblur = () => show(store.state);
  store.watch(show);
  return h(
    "div.toolbar.chips",
    checkBox(store, "fullTurn", "The crank turns fully"),
    selectBox(store, "mu", "Least transmission angle", [0, 20, 30, 40, 45, 50], anyMu),
    selectBox(store, "maxLink", "Longest link", [3, 5, 10, 20, 50, Infinity], links),
    box.element,
    corners,
  );
}

/** The box of a shape, half as large again on each side, in round numbers. @param {Outline | null} shape */
function boxAround(shape) {
  const [x0, y0, x1, y1] = shape ? boxOfPoints(shape.points) : [0, 0, 100, 100];
  const by = Math.max(x1 - x0, y1 - y0) / 2;
  return [x0 - by, y0 - by, x1 + by, y1 + by].map((value) => Number(value.toPrecision(3)));
}

/** @param {Store<ShapeQuery>} store @param {"mirror" | "fullTurn"} name @param {string} label */
function checkBox(store, name, label) {
  const { input, element } = choiceBox("checkbox", { name }, label);
  input.onchange = () => store.change({ [name]: input.checked });
  store.watch((state) => {
    input.checked = state[name];
  });
  return element;
}

/**
 * A choice of some values, and of the one that the address has.
 * @template {string | number} T @param {Store<ShapeQuery>} store @param {"least" | "by" | "mu" | "maxLink"} name
 * @param {string} label @param {T[]} values @param {(value: T) => string} text
 */
function selectBox(store, name, label, values, text) {
  const element = h("select", { "aria-label": label });
  const isNumber = typeof values[0] === "number";
  element.onchange = () => store.change({ [name]: isNumber ? Number(element.value) : element.value });
  store.watch((state) => {
    const chosen = /** @type {T} */ (state[name]);
    const all = [...new Set([...values, chosen])];
    if (isNumber) all.sort((a, b) => Number(a) - Number(b));
    const options = all.map((value) => h("option", { value, selected: value === chosen }, text(value)));
    fill(element, options);
  });
  return element;
}

/** The element of a view with its parts. @param {ShapeView} view */
export function shapeLayout(view) {
  const { target, store, status, loadAll, families } = view;
  const clear = () => {
    view.clear();
    target.element.focus();
  };
  const field = new PathField(view.app, (outline, name) => view.setShape(outline, name));
  const heading = h("div", h("h1", "By shape"), status, loadAll.element);
  const tools = h("div.toolbar", buttonOf("Clear", clear));
  const chips = fourBarChips(store, () => view.shape);
  const panel = h(
    "div.panel",
    target.element,
    view.fourBars.live,
    view.fourBars.reasons,
    tools,
    chips,
    shapeOptions(store),
    field.element,
    target.help,
    families,
  );
  const results = h("div.shape-results", view.results, view.fourBars.element);
  const element = h("div.view.wide.shape-view", h("div.head", heading), h("div.shape-split", panel, results));
  field.listen(element);
  return element;
}
