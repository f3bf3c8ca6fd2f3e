// The room where curves are found that are like a shape.

import { address } from "../../data/address.js";
import { curveAt, curveKey, curvePoints } from "../../data/family.js";
import { askedShape } from "../../shape/asked.js";
import { decodedShape, encodedShape } from "../../shape/encode.js";
import { shapeIn } from "../../shape/parse.js";
import { searching } from "../../shape/search.js";
import { fill, h } from "../dom.js";
import { familyChoice } from "../find/families.js";
import { familiesAsked, loadingFamilies } from "../find/loading.js";
import { captionInType } from "../page-words.js";
import { indexFor } from "./indexes.js";
import { overlayPicture } from "./overlay.js";
import { DrawingPad } from "./pad.js";
import { inSlices } from "./slices.js";

const SHOWN = 36;
const LEASTS = [0.05, 0.1, 0.15, 0.25, 0.5];

/** `#/shape?d=…` or `?like=evans:12.1.1`, with `part`, `least`, `mirror=no`, `by=greatest`, `family`. */
export const shapeRoom = {
  name: "shape",
  label: "By shape",
  opens: ({ path }) => path[0] === "shape",
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
    this.read(query);
    this.element = this.laidOut();
  }

  read(query) {
    const least = Number(query.get("least"));
    this.asked = {
      d: query.get("d"),
      like: query.get("like"),
      part: query.has("part") ? query.get("part") !== "no" : null,
      least: least > 0 && least <= 1 ? least : 0.15,
      mirror: query.get("mirror") !== "no",
      by: query.get("by") === "greatest" ? "greatest" : "rms",
      families: query.get("family")?.split(",").filter(Boolean) ?? null,
    };
  }

  laidOut() {
    const paste = h("textarea", {
      id: "shape-text",
      rows: 4,
      spellcheck: "false",
      placeholder: "x,y lines, JSON, points.csv, or an SVG path: M0 0 C…",
    });
    const wrong = h("p", { class: "trouble", role: "alert" });
    const use = () => {
      try {
        const { points, closed, said } = shapeIn(paste.value);
        fill(wrong);
        this.pad.show(points, closed);
        this.drawn(points, closed);
        this.app.say(`${said} read`);
      } catch (error) {
        fill(wrong, error.message);
      }
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
          h(
            "div",
            { class: "toolbar" },
            h(
              "button",
              {
                type: "button",
                onclick: () => {
                  this.pad.clear();
                  this.pad.element.focus();
                },
              },
              "Clear the pad",
            ),
          ),
          this.options(),
          h(
            "div",
            { class: "field" },
            h("label", { for: "shape-text" }, "Or paste points or a path"),
            paste,
            wrong,
            h("div", {}, h("button", { type: "button", onclick: use }, "Use what is pasted")),
          ),
          this.families,
        ),
        this.results,
      ),
    );
  }

  options() {
    const { asked } = this;
    const changed = () => {
      this.addressed();
      this.search();
    };
    const option = (type, name, label, isOn, act) => {
      const input = h("input", {
        type,
        name,
        onchange: (event) => {
          act(event.target.checked);
          changed();
        },
      });
      input.checked = isOn;
      return [h("label", { class: "check" }, input, label), input];
    };
    const [whole, wholeBox] = option("radio", "shape-part", "a whole curve", asked.part !== true, () => {
      asked.part = false;
    });
    const [part, partBox] = option(
      "radio",
      "shape-part",
      "a part of a curve, no less than",
      asked.part === true,
      () => {
        asked.part = true;
      },
    );
    this.marks = () => {
      [wholeBox.checked, partBox.checked] = [!asked.part, asked.part === true];
    };
    const least = h(
      "select",
      {
        "aria-label": "Least part of a curve",
        onchange: (event) => {
          asked.least = Number(event.target.value);
          changed();
        },
      },
      [...new Set([...LEASTS, asked.least])]
        .sort((a, b) => a - b)
        .map((value) => h("option", { value }, `${Math.round(100 * value)} %`)),
    );
    least.value = String(asked.least);
    const by = h(
      "select",
      {
        id: "shape-by",
        onchange: (event) => {
          asked.by = event.target.value;
          changed();
        },
      },
      h("option", { value: "rms" }, "rms deviation"),
      h("option", { value: "greatest" }, "greatest deviation"),
    );
    by.value = asked.by;
    return h(
      "fieldset",
      { class: "shape-options" },
      h("legend", {}, "What is drawn is"),
      whole,
      h("div", { class: "toolbar" }, part, least),
      option("checkbox", "mirror", "mirror images too", asked.mirror, (isOn) => {
        asked.mirror = isOn;
      })[0],
      h("span", { class: "field row" }, h("label", { for: "shape-by" }, "Ranked by"), by),
    );
  }

  async begin() {
    await this.take();
    const { app, asked } = this;
    this.stop?.();
    const listed = familiesAsked(app.atlas, asked.families);
    fill(
      this.families,
      familyChoice(app.atlas, asked.families, listed, (families) => {
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
    const drawn = asked.d && decodedShape(asked.d);
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
    this.shape = askedShape(points, closed);
    this.asked.part ??= !closed;
    this.marks?.();
  }

  drawn(points, closed) {
    this.shape = askedShape(points, closed);
    if (!this.shape) return;
    Object.assign(this.asked, { d: encodedShape(this.shape.points, closed), like: null, part: !closed });
    this.marks();
    this.addressed();
    this.search();
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
      searching(indexes, this.shape, { part: part === true, least, mirror, by }),
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
    const sentence = found.length
      ? `The nearest of ${count.toLocaleString("en")} curves, by their ${by === "rms" ? "rms" : "greatest"} deviation in % of the shape’s extent`
      : "Nothing is like this";
    fill(this.status, sentence);
    this.app.say(sentence);
    this.results.removeAttribute("aria-busy");
    fill(
      this.results,
      found.map((one) => this.likeness(one)),
    );
  }

  likeness(one) {
    const { family, curve, name, rms, greatest } = one;
    const percent = (value) => `${(100 * value).toFixed(2)} %`;
    const caption = family.cells.caption[family.curves.cell[curve]];
    const [first, second] = this.asked.by === "rms" ? [rms, greatest] : [greatest, rms];
    const words = this.asked.by === "rms" ? ["rms", "greatest"] : ["greatest", "rms"];
    const share = this.asked.part ? `, ${Math.round(100 * (one.to - one.from))} % of the curve` : "";
    const pin = h(
      "button",
      {
        type: "button",
        class: "quiet",
        onclick: () => {
          this.app.pins.toggle(name);
          pin.setAttribute("aria-pressed", String(this.app.pins.has(name)));
        },
        "aria-pressed": String(this.app.pins.has(name)),
      },
      "Pin",
      h("span", { class: "unseen" }, ` ${name}`),
    );
    return h(
      "li",
      {},
      h(
        "a",
        { href: address([family.id, "curve", curveKey(family, curve)]), "data-name": name },
        overlayPicture(one, this.shape, { width: 220, height: 170 }),
        h(
          "span",
          { class: "label" },
          h("b", {}, `${percent(first)} ${words[0]}`),
          ` ${percent(second)} ${words[1]}${share}`,
        ),
        h("span", { class: "label" }, captionInType(caption || name)),
      ),
      h("span", { class: "acts" }, h("a", { href: address(["shape"], { like: name }) }, "Like this"), pin),
    );
  }

  addressed() {
    const { d, like, part, least, mirror, by, families } = this.asked;
    this.app.replace(
      address(["shape"], {
        d,
        like,
        part: part === null ? null : part ? "yes" : "no",
        least: part && least !== 0.15 ? least : null,
        mirror: mirror ? null : "no",
        by: by === "rms" ? null : by,
        family: families?.join(","),
      }),
    );
  }

  /** Another shape has another address, and is shown anew. */
  update() {
    return false;
  }

  leave() {
    this.turn += 1;
    this.stop?.();
  }
}
