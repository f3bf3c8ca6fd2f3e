// The section with the four-bars whose coupler curves are nearest to a shape.

import { MAX_FOUR_BARS } from "../../kernel/finder.js";
import { searchedPath } from "../../shape/query-shape.js";
import { buttonOf, choiceBox, fill, h, selectOf } from "../dom.js";
import { saveFile, copyText } from "../export/save.js";
import { fourBarItem } from "./four-bar-item.js";

const LONGEST_LINKS = [3, 5, 10, 20, 50, Infinity];

/** The section and its options, which change the query before `changed()` is called. */
export class FourBarSection {
  /** @param {App} app @param {ShapeQuery} query @param {() => void} changed */
  constructor(app, query, changed) {
    this.app = app;
    this.query = query;
    this.status = h("p.counted");
    this.list = h("ol.four-bars");
    this.acts = h("div.toolbar");
    const fullTurn = choiceBox(
      "checkbox",
      {
        name: "full-turn",
        checked: query.fullTurn,
        onchange: ({ target }) => {
          query.fullTurn = target.checked;
          changed();
        },
      },
      "The crank turns fully",
    );
    const choose = {
      id: "max-link",
      onchange: ({ target }) => {
        query.maxLink = Number(target.value);
        changed();
      },
    };
    const lengths = [...new Set([...LONGEST_LINKS, query.maxLink])].sort((a, b) => a - b);
    const options = lengths.map((length) => [
      length,
      length === Infinity ? "of any length" : `up to ${length} S`,
    ]);
    const longest = selectOf(choose, options, query.maxLink);
    const label = h("label", { for: "max-link" }, "Links");
    const tools = h("div.toolbar", fullTurn.element, h("span.field.row", label, longest));
    const note =
      "Four-bars found in an index of random ones and fitted to the path, as by coupler-atlas find. E is the root mean " +
      "square distance of the path from the curve, S the size of the path.";
    this.element = h(
      "section.four-bar-section",
      { hidden: true },
      h("h2", "Four-bars for this path"),
      h("p.note", note),
      tools,
      this.status,
      this.list,
      this.acts,
    );
  }

  /** Without a shape there are no answers. */
  clear() {
    this.element.hidden = true;
    [this.status, this.list, this.acts].forEach((part) => fill(part));
  }

  /** Searches for a shape in slices. @param {Shape} shape @param {Slices} slices */
  async search(shape, slices) {
    const { fullTurn, maxLink, part, like } = this.query;
    this.element.hidden = false;
    this.list.setAttribute("aria-busy", "true");
    fill(this.status, "Searching");
    try {
      const kernel = await this.app.kernel.load();
      const path = { ...searchedPath(shape, part === true), name: like ?? "the drawn path" };
      await kernel.fourBars.find(path, { fullTurn, maxLink }, slices, (found, isDone) =>
        this.show(found, path, isDone),
      );
    } catch (error) {
      if (slices.stopped()) return;
      fill(this.list);
      fill(this.acts);
      fill(this.status, `No four-bar is searched for: ${error.message}`);
      this.list.removeAttribute("aria-busy");
    }
  }

  /** Shows the answers so far. @param {FoundFourBars} found @param {Outline} path */
  show(found, path, isDone) {
    const { answers, manifest, size, index_count: count } = found;
    const among = `among ${count.toLocaleString("en")} four-bars and what is near them`;
    const none = "No four-bar meets these conditions: allow cranks that do not turn fully, or longer links";
    const nearest = answers.length === 1 ? "The nearest" : `The ${answers.length} nearest`;
    const sentence = answers.length ? `${nearest} ${among}` : isDone ? none : "None yet";
    fill(this.status, sentence, isDone ? "" : "; the search goes on");
    if (isDone) {
      this.list.removeAttribute("aria-busy");
      this.app.announce(sentence);
    }
    fill(
      this.list,
      answers.slice(0, MAX_FOUR_BARS).map((answer) => fourBarItem(this.app, answer, path, size)),
    );
    const save = () =>
      saveFile({ name: "found.toml", type: "application/toml", bytes: new TextEncoder().encode(manifest) });
    const copy = async () => {
      if (await copyText("manifest", manifest)) this.app.announce("Manifest copied");
    };
    fill(
      this.acts,
      answers.length
        ? [buttonOf("Save manifest of all", save), buttonOf("Copy manifest of all", copy)]
        : null,
    );
  }
}
