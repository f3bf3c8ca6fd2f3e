// The section with the four-bars whose coupler curves are nearest to a shape, three of which are on the target.

import { MAX_LIVE } from "../../kernel/finder.js";
import { buttonOf, fill, h } from "../dom.js";
import { saveFile } from "../export/files.js";
import { copyButton, fourBarItem } from "./match-item.js";
import { fourBarOptions } from "./query.js";

// While a shape changes, four-bars are looked up at most so often, in milliseconds.
const LIVE_MS = 300;

/** The section; `onFound(answers)` is called with those for the target. */
export class FourBarSection {
  /** Stopped by what is searched for next. */ searching = new AbortController();
  /** The last answers, with which the next begin while the shape is dragged. @type {FourBarAnswer[]} */
  answers = [];
  /** The shape to look up next. @type {{ shape: Outline, state: ShapeQuery, isDragged: boolean } | null} */
  next = null;
  isLooking = false;

  /** @param {App} app @param {(answers: FourBarAnswer[], isAtRest: boolean) => void} onFound */
  constructor(app, onFound) {
    this.app = app;
    this.onFound = onFound;
    this.live = h("p.note.live");
    this.status = h("p.counted");
    this.reasons = h("p.note.reasons");
    this.list = h("ol.four-bars");
    this.acts = h("div.toolbar");
    const note =
      "Four-bars found in an index of random ones and fitted to the path, as by coupler-atlas find. E is the root mean " +
      "square distance of the path from the curve, S the size of the path: up to 0.0001 S is exact, 0.01 S close, 0.05 S fair, and more poor.";
    const words = [h("h2", "Four-bars for this path"), h("p.note", note)];
    this.element = h("section.four-bar-section", { hidden: true }, words, this.status, this.list, this.acts);
  }

  /** Stops what is searched for; the signal for what follows. */
  stop() {
    this.next = null;
    this.searching.abort();
    this.searching = new AbortController();
    return this.searching.signal;
  }

  /** Without a shape there are no answers. */
  clear() {
    this.stop();
    this.#found([]);
    this.element.hidden = true;
    [this.status, this.reasons, this.list, this.acts].forEach((part) => fill(part));
  }

  /** Looks a shape that is being changed up, at most every 0.3 seconds; one that is dragged is followed by the answers before. */
  follow(/** @type {Outline} */ shape, /** @type {ShapeQuery} */ state, /** @type {boolean} */ isDragged) {
    this.next = { shape, state, isDragged };
    if (!this.isLooking) this.#look();
  }

  async #look() {
    this.isLooking = true;
    while (this.next) {
      const { shape, state, isDragged } = this.next;
      const signal = this.stop();
      const pause = new Promise((resume) => setTimeout(resume, LIVE_MS));
      const path = { shape, isPart: !shape.closed, name: "" };
      const options = fourBarOptions(state);
      try {
        const { fourBars } = await this.app.kernel.load();
        const poses = this.answers.slice(0, MAX_LIVE).map(({ pose }) => pose);
        const found = await (isDragged && poses.length
          ? fourBars.follow(path, options, poses, signal)
          : fourBars.lookUp(path, options, signal));
        if (!signal.aborted) this.#found(found);
      } catch {
        // A stroke that has just begun is no path; of a kernel that fails, the search at the end says so.
      }
      await pause;
    }
    this.isLooking = false;
  }

  #found(/** @type {FourBarAnswer[]} */ answers, isAtRest = false) {
    this.answers = answers;
    const { record } = answers[0] ?? {};
    const { quality, rms_relative: far = 0 } = record ?? {};
    fill(this.live, record ? `The nearest four-bar is ${quality}: E = ${far.toPrecision(2)} S` : "");
    this.onFound(answers.slice(0, MAX_LIVE), isAtRest);
  }

  /** Searches for a shape. @param {Outline} shape @param {ShapeQuery} state */
  async search(shape, state, /** @type {string} */ name) {
    const signal = this.stop();
    this.element.hidden = false;
    this.list.setAttribute("aria-busy", "true");
    fill(this.status, "Searching");
    fill(this.reasons);
    try {
      const kernel = await this.app.kernel.load();
      const path = { shape, isPart: state.part === true, name };
      await kernel.fourBars.find(path, fourBarOptions(state), signal, (found, isDone) =>
        this.show(found, shape, isDone),
      );
    } catch (error) {
      if (signal.aborted) return;
      fill(this.list);
      fill(this.acts);
      fill(this.status, `No four-bar is searched for: ${error.message}`);
      this.list.removeAttribute("aria-busy");
    }
  }

  /** Shows the answers so far. @param {FoundFourBars} found @param {Outline} shape */
  show(found, shape, /** @type {boolean} */ isDone) {
    const { answers, manifest, size, index_count: count, hindrances } = found;
    const among = `among ${count.toLocaleString("en")} four-bars and what is near them`;
    const none = "No four-bar meets these conditions";
    const nearest = answers.length === 1 ? "The nearest" : `The ${answers.length} nearest`;
    const isPoor = answers[0]?.record.quality === "poor";
    const poor = isPoor ? ", all of them poor" : "";
    const sentence = answers.length ? `${nearest} ${among}${poor}` : isDone ? none : "None yet";
    fill(this.status, sentence, isDone ? "" : "; the search goes on");
    if (isDone) {
      this.list.removeAttribute("aria-busy");
      fill(this.reasons, answers.length && !isPoor ? null : reasonText(hindrances));
      this.app.announce(sentence);
    }
    this.#found(answers, isDone);
    const items = answers.map((answer) => fourBarItem(this.app, answer, shape, size));
    fill(this.list, items);
    const save = () => saveFile({ name: "found.toml", type: "application/toml", bytes: manifest });
    const acts = [
      buttonOf("Save manifest of all", save),
      copyButton(this.app, "Copy manifest of all", manifest),
    ];
    fill(this.acts, answers.length ? acts : null);
  }
}

/** Why there is no near curve. @param {string[]} hindrances */
function reasonText(hindrances) {
  if (hindrances.length) return `What hinders is the path: ${hindrances.join("; ")}.`;
  return "Nothing of the path is known to hinder: allow cranks that do not turn fully, longer links, smaller transmission angles or other pivots.";
}
