// The room where curves are found that are like a shape.

import { curveAt, curvePoints } from "../../data/family.js";
import { queryShape } from "../../shape/query-shape.js";
import { decodeShape, encodeShape } from "../../shape/encode.js";
import { searchByShape } from "../../shape/search.js";
import { fill, h } from "../dom.js";
import { familyChoice } from "../find/families.js";
import { familiesAsked, loadingFamilies } from "../find/loading.js";
import { watchPins } from "../pin-button.js";
import { isInRoom, roomAddress } from "../room-address.js";
import { indexFor } from "./indexes.js";
import { listedLikeness } from "./likeness.js";
import { shapeOptions } from "./options.js";
import { DrawingPad } from "./pad.js";
import { pasteField } from "./paste.js";
import { shapeQueryOf, shapeQuestionOf } from "./question.js";
import { inSlices } from "./slices.js";

const SHOWN = 36;

/** `#/shape?d=…` or `?like=evans:12.1.1`, with `part`, `least`, `mirror=no`, `by=greatest`, `family`. */
export const shapeRoom = {
  name: "shape",
  label: "By shape",
  way: (app) => roomAddress("shape", {}, app),
  opens: (place, app) => isInRoom("shape", place, app),
  view: async (app, { query }) => {
    const room = new ShapeRoom(app, query);
    await room.begin();
    return {
      title: "By shape",
      element: room.element,
      update: (place) => room.update(place.query),
      leave: () => room.leave(),
    };
  },
};

class ShapeRoom {
  constructor(app, query) {
    this.app = app;
    this.turn = 0;
    this.indexes = [];
    this.pad = new DrawingPad(
      (points, closed) => this.drawn(points, closed),
      (text) => app.say(text),
    );
    this.status = h("p", { class: "counted" }, "Draw a curve, paste one, or begin with one of the atlas");
    this.results = h("ol", { class: "likenesses" });
    this.families = h("div", {});
    this.asked = shapeQuestionOf(query);
    this.options = shapeOptions(this.asked, () => this.ask());
    this.element = this.laidOut();
  }

  laidOut() {
    const clear = () => {
      this.pad.clear();
      this.pad.element.focus();
    };
    const use = ({ points, closed, said }) => {
      this.pad.show(points, closed);
      this.drawn(points, closed);
      this.app.say(`${said} read`);
    };
    return h(
      "div",
      { class: "room wide shape-room" },
      h("div", { class: "head" }, h("div", {}, h("h1", {}, "By shape"), this.status)),
      h(
        "div",
        { class: "shape-split" },
        h(
          "div",
          { class: "panel" },
          this.pad.element,
          this.pad.help,
          h("div", { class: "toolbar" }, h("button", { type: "button", onclick: clear }, "Clear the pad")),
          this.options.element,
          pasteField(use),
          this.families,
        ),
        this.results,
      ),
    );
  }

  async begin() {
    await this.take();
    const { app, asked } = this;
    this.unwatch ??= watchPins(app, this.element);
    this.stop?.();
    const listed = familiesAsked(app.atlas, asked.families);
    fill(
      this.families,
      familyChoice(app.atlas, listed, (families) => {
        asked.families = families;
        this.addressed();
        this.begin();
      }),
    );
    this.stop = loadingFamilies(
      app.atlas,
      listed,
      (families, done, all) => {
        this.loaded = families;
        this.isWhole = done === all;
        this.search();
      },
      (sentence) => app.say(sentence),
    );
  }

  /** Takes the shape of the address: a drawn one, or a curve of the atlas. */
  async take() {
    const { asked, app } = this;
    const drawn = asked.d && decodeShape(asked.d);
    if (drawn) this.given(drawn.points, drawn.closed);
    if (drawn || !asked.like) return;
    const [id, key] = asked.like.split(":");
    const family = await app.atlas.family(id);
    const curve = curveAt(family, key ?? "");
    if (curve === undefined) throw new Error(`There is no curve ${key} in the family ${id}.`);
    this.given(curvePoints(family, curve), family.curves.closed[curve] === 1);
  }

  given(points, closed) {
    this.pad.show(points, closed);
    this.shape = queryShape(points, closed);
    this.asked.part ??= !closed;
    this.options.mark();
  }

  drawn(points, closed) {
    this.shape = queryShape(points, closed);
    if (!this.shape) return;
    Object.assign(this.asked, { d: encodeShape(this.shape.points, closed), like: null, part: !closed });
    this.options.mark();
    this.ask();
  }

  /** Searches what is loaded; a later search stops an earlier one. */
  async search() {
    if (!this.shape || !this.loaded) return;
    this.turn += 1;
    const mine = this.turn;
    const stopped = () => mine !== this.turn;
    const { part, least, mirror, by } = this.asked;
    this.results.setAttribute("aria-busy", "true");
    const indexes = [];
    for (const family of this.loaded) {
      fill(this.status, "Looking through ", family.title);
      const index = await indexFor(family, part ? least : null, stopped);
      if (!index) return;
      indexes.push(index);
    }
    const began = performance.now();
    const found = await inSlices(
      searchByShape(indexes, this.shape, { part: part === true, least, mirror, by }),
      stopped,
    );
    if (!found) return;
    this.element.dataset.milliseconds = (performance.now() - began).toFixed(0);
    this.show(found.slice(0, SHOWN));
    // What a search for parts needs is made while nothing is asked.
    if (!part && this.isWhole)
      for (const family of this.loaded) if (!(await indexFor(family, least, stopped))) return;
  }

  show(found) {
    const { by } = this.asked;
    const count = this.loaded.reduce((sum, { curves }) => sum + curves.count, 0);
    const ranked = `by their ${by} deviation in % of the shape’s extent`;
    const sentence = found.length
      ? `The ${found.length === 1 ? "" : `${found.length} `}nearest of ${count.toLocaleString("en")} curves, ${ranked}`
      : "Nothing is like this";
    fill(this.status, sentence);
    this.app.say(sentence);
    this.results.removeAttribute("aria-busy");
    fill(
      this.results,
      found.map((one) => listedLikeness(this.app, one, this.shape, this.asked)),
    );
  }

  /** What is asked is another: so are the address and what is found. */
  ask() {
    this.addressed();
    this.search();
  }

  addressed() {
    this.app.replace(roomAddress("shape", shapeQueryOf(this.asked), this.app));
  }

  /** Another shape has another address, and is shown anew. */
  update() {
    return false;
  }

  leave() {
    this.turn += 1;
    this.unwatch?.();
    this.stop?.();
  }
}
