// The view that compares pinned curves.

import { address } from "../../data/address.js";
import { curveCaption } from "../../data/family.js";
import { fill, h } from "../dom.js";
import { formatCaption, formatChanges } from "../labels.js";
import { matchesRoute, routeAddress } from "../route-address.js";
import { exportMenu } from "../export/menu.js";
import { alignCurve } from "./align.js";
import { ALIGNMENTS, parseComparisonQuery, formatComparisonQuery, MAX_COMPARED } from "./query.js";
import { loadComparedCurve } from "./load-curve.js";
import { factsTable } from "./facts.js";
import { refinePicture } from "./refine.js";
import { letterOf, overlaidPicture, sideBySidePictures, strokeSample } from "./picture.js";

/** The route `#/compare?c=evans:12.1.1,watt:3.1.1&view=side|over&align=…`; opening it pins its curves. */
export const compareRoute = {
  name: "compare",
  label: "Compare",
  href: (app) => routeAddress("compare", { c: app.pins.names.join(",") }, app),
  matches: (target, app) => matchesRoute("compare", target, app),
  open: async (app, { query }) => {
    const view = new CompareView(app);
    await view.setQuery(parseComparisonQuery(query));
    return {
      title: "Compare",
      element: view.element,
      update: (target) => {
        view.setQuery(parseComparisonQuery(target.query));
        return true;
      },
      leave: () => view.leave(),
    };
  },
};

/**
 * Returns a function that restores the focus to the control with the same name after an element's content has
 * been replaced.
 */
function keepFocus(element) {
  const nameOf = (control) => control.id || control.getAttribute("aria-label") || control.textContent;
  const focused = element.contains(document.activeElement) ? nameOf(document.activeElement) : null;
  return () => {
    if (focused === null || element.contains(document.activeElement)) return;
    const again = [...element.querySelectorAll("button, select, a")].find(
      (control) => nameOf(control) === focused && !control.disabled,
    );
    (again ?? element.querySelector("select, button"))?.focus();
  };
}

class CompareView {
  constructor(app) {
    this.app = app;
    this.loaded = new Map();
    this.body = h("div", { class: "comparison" });
    this.tools = h("div", { class: "toolbar" });
    this.exportSlot = h("div", {});
    this.count = h("p", { class: "lede" });
    this.element = h(
      "div",
      { class: "view wide compare-view" },
      h("div", { class: "head" }, h("div", {}, h("h1", {}, "Compare"), this.count), this.exportSlot),
      this.tools,
      this.body,
    );
    this.unwatch = app.pins.watch(() => this.refresh());
  }

  async setQuery(query) {
    this.query = query;
    if (query.names && String(query.names) !== String(this.app.pins.names)) this.app.pins.set(query.names);
    else await this.refresh();
  }

  /** Shows the pinned curves and updates the address. */
  async refresh() {
    const { app, query } = this;
    const names = [...app.pins.names];
    app.replace(routeAddress("compare", formatComparisonQuery(query, names), app));
    for (const name of names) {
      if (!this.loaded.has(name)) this.loaded.set(name, await loadComparedCurve(app.atlas, name));
    }
    // The pins may have changed meanwhile.
    if (String(names) !== String(app.pins.names)) return;
    const found = names.map((name) => this.loaded.get(name));
    this.show(
      found.filter(({ family }) => family),
      found.filter(({ family }) => !family),
    );
  }

  show(all, missing) {
    const focused = keepFocus(this.element);
    this.render(all, missing);
    focused();
  }

  render(all, missing) {
    const curves = all.slice(0, MAX_COMPARED);
    const { query, app } = this;
    const beyond = all.length - curves.length;
    fill(
      this.count,
      all.length
        ? `${all.length} pinned`
        : "No curves are pinned. Pin curves in Find (p), By shape, on a page or on a plate.",
      beyond ? `; the first ${MAX_COMPARED} are compared` : "",
      missing.map(({ name, reason }) => `; skipped ${name}: ${reason}`),
    );
    fill(this.exportSlot, all.length ? exportMenu(app, () => all.map(({ name }) => name)) : null);
    fill(this.tools, all.length ? this.controls() : null);
    const aligned = curves.map((one, k) => alignCurve(curves[0], one, k > 0 ? query.align : "none"));
    const labels = curves.map(({ name }, k) => `${letterOf(k)} ${name}`);
    this.stop?.();
    const isOver = query.view === "over" && curves.length > 1;
    const picture = isOver
      ? overlaidPicture(aligned, `${labels.join(", ")}; alignment: ${ALIGNMENTS[query.align]}`)
      : sideBySidePictures(aligned);
    this.stop = refinePicture(picture, curves, aligned);
    fill(
      this.body,
      picture.element,
      h(
        "ol",
        { class: isOver ? "pinned-list" : "pinned-tiles" },
        curves.map((one, k) =>
          this.entry(one, k, curves, {
            deviation: aligned[k],
            picture: isOver ? strokeSample(k) : h("div", { class: "tile-picture" }, picture.elements[k]),
          }),
        ),
      ),
      curves.length ? factsTable(curves, app.atlas.measures, labels) : null,
    );
  }

  controls() {
    const { query, app } = this;
    const view = (name, label) =>
      h(
        "button",
        {
          type: "button",
          "aria-pressed": String(query.view === name),
          onclick: () => {
            query.view = name;
            this.refresh();
          },
        },
        label,
      );
    const align = h(
      "select",
      {
        id: "compare-align",
        onchange: (event) => {
          query.align = event.target.value;
          this.refresh();
        },
      },
      Object.entries(ALIGNMENTS).map(([value, label]) => h("option", { value }, label)),
    );
    align.value = query.align;
    return [
      h(
        "div",
        { class: "segments", role: "group", "aria-label": "Show" },
        view("side", "Side by side"),
        view("over", "Overlay"),
      ),
      h("span", { class: "field row" }, h("label", { for: "compare-align" }, "Alignment"), align),
      h("button", { type: "button", class: "quiet end", onclick: () => app.pins.set([]) }, "Unpin all"),
    ];
  }

  entry({ name, family, curve, key, changes }, k, curves, { deviation, picture }) {
    const { app } = this;
    const move = (by, label, sign) =>
      h(
        "button",
        {
          type: "button",
          class: "quiet",
          disabled: k + by < 0 || k + by >= curves.length,
          "aria-label": `Move ${letterOf(k)} ${label}`,
          onclick: () => this.move(k, by),
        },
        sign,
      );
    const percent = (value) => `${(100 * value).toFixed(2)} %`;
    return h(
      "li",
      {},
      picture,
      h(
        "div",
        { class: "named" },
        h("b", {}, letterOf(k)),
        " ",
        h("a", { href: address([family.id, "curve", key], changes) }, `${family.title}, ${key}`),
        h("p", { class: "caption" }, formatCaption(curveCaption(family, curve))),
        changes.size ? h("p", { class: "tag" }, formatCaption(formatChanges(changes))) : null,
        k > 0
          ? h(
              "p",
              { class: "deviation" },
              `${percent(deviation.rms)} rms from A, ${percent(deviation.greatest)} maximum`,
            )
          : null,
      ),
      h(
        "div",
        { class: "acts" },
        move(-1, "forward", "←"),
        move(1, "back", "→"),
        h(
          "button",
          {
            type: "button",
            class: "quiet",
            onclick: () => app.pins.toggle(name),
            "aria-label": `Unpin ${letterOf(k)}`,
          },
          "Unpin",
        ),
      ),
    );
  }

  move(k, by) {
    const names = [...this.app.pins.names];
    names.splice(k + by, 0, ...names.splice(k, 1));
    this.app.pins.set(names);
    this.app.announce(`${names[k + by]} is now ${letterOf(k + by)}`);
  }

  leave() {
    this.unwatch();
    this.stop?.();
    for (const { release } of this.loaded.values()) release?.();
  }
}
