// Searches for four-bars whose coupler curves are nearest to a path, in the kernel.

import { drawnPath } from "./shape-search.js";

// The time, in milliseconds, after which the index does not grow before a search, and after which the search says what it has found so far.
const GROW_MS = 1000;
const REPORT_MS = 2000;
// The time for the index before a first look, and for a four-bar that follows a path.
const FIRST_MS = 150;
const FOLLOW_MS = 80;

/** The most answers of a search, and of a look while the path changes. */
const MAX_FOUR_BARS = 5;
export const MAX_LIVE = 3;

/** The search for four-bars of a kernel in a worker. One search is made at a time: its index does not grow meanwhile. */
export class FourBarFinder {
  /** @type {Promise<unknown>} */ running = Promise.resolve();

  /** The curves of the index. */ count = 0;

  constructor(/** @type {SearchKernel} */ kernel) {
    this.kernel = kernel;
  }

  /**
   * Searches for a path, and calls `report(found, isDone)` with what there is after two
   * seconds and at the end. In an index that is not complete by then, it searches again when it is.
   * @param {NamedPath} path @param {object} options @param {AbortSignal} signal @param {(found: FoundFourBars, isDone: boolean) => void} report
   */
  find(path, options, signal, report) {
    return this.#after(async () => {
      if (signal.aborted) return;
      const began = performance.now();
      const refined = { ...options, refine: true, start: null, most: MAX_FOUR_BARS };
      const isComplete = await this.#grow(signal, began + GROW_MS);
      const first = { report: began + REPORT_MS, end: Infinity };
      const early = (/** @type {FoundFourBars} */ found, isDone = false) =>
        report(found, isDone && isComplete);
      await this.#search(path, refined, signal, first, early);
      if (isComplete || !(await this.#grow(signal, Infinity))) return;
      await this.#search(path, refined, signal, { report: Infinity, end: Infinity }, report);
    });
  }

  /** Looks a path that is being drawn up in what there is of the index. Resolves to the answers. @param {NamedPath} path @param {object} options @param {AbortSignal} signal */
  lookUp(path, options, signal) {
    return this.#after(async () => {
      if (this.count === 0) await this.#grow(signal, performance.now() + FIRST_MS);
      const quick = { ...options, refine: false, start: null, most: MAX_LIVE };
      return this.#answers(path, quick, signal, Infinity);
    });
  }

  /** Refines four-bars, by their poses, to a path that has changed since. Resolves to the answers. @param {NamedPath} path @param {object} options @param {Float64Array[]} poses @param {AbortSignal} signal */
  follow(path, options, poses, signal) {
    return this.#after(async () => {
      const answers = [];
      for (const start of poses) {
        const end = performance.now() + FOLLOW_MS;
        const near = { ...options, refine: true, start, most: 1 };
        answers.push(...(await this.#answers(path, near, signal, end)));
      }
      return answers.sort((a, b) => a.record.rms_relative - b.record.rms_relative);
    });
  }

  /** Completes the index while nothing is searched. */
  prepare(/** @type {AbortSignal} */ signal) {
    return this.#after(() => this.#grow(signal, Infinity));
  }

  /** @template T @param {() => Promise<T>} work @returns {Promise<T>} */
  #after(work) {
    const next = this.running.catch(() => {}).then(work);
    this.running = next;
    return next;
  }

  /** Grows the index until it is complete, or a time; whether it is complete. */
  async #grow(/** @type {AbortSignal} */ signal, /** @type {number} */ until) {
    for (;;) {
      if (signal.aborted || performance.now() > until) return false;
      const { count, full_count: full } = await this.kernel.call({ method: "grow_index" });
      this.count = count;
      if (count === full) return true;
    }
  }

  /** @returns {Promise<FourBarAnswer[]>} @param {object} options @param {AbortSignal} signal @param {number} end */
  async #answers(/** @type {NamedPath} */ path, options, signal, end) {
    /** @type {FourBarAnswer[]} */ let answers = [];
    if (signal.aborted) return answers;
    await this.#search(path, options, signal, { report: Infinity, end }, (found) => ({ answers } = found));
    return answers;
  }

  /**
   * Searches until the time `end`, and reports what there is at the time `report` and at the end.
   * @param {object} options @param {AbortSignal} signal @param {{ report: number, end: number }} times @param {(found: FoundFourBars, isDone: boolean) => void} report
   */
  async #search(/** @type {NamedPath} */ { shape, isPart, name }, options, signal, times, report) {
    const { kernel } = this;
    const { points, kind } = await drawnPath(kernel, shape, isPart);
    const { instance } = kernel;
    const { search, hindrances } = await kernel.call({ method: "open_search", points, kind, ...options });
    try {
      const reported = async (/** @type {boolean} */ isDone) => {
        let found = null;
        do {
          if (signal.aborted) return;
          found = await kernel.call({ method: "answers", search, name });
        } while (!found.is_complete);
        report({ ...found, hindrances, index_count: this.count }, isDone);
      };
      let at = times.report;
      while (!(await kernel.call({ method: "step_search", search })).is_done) {
        if (signal.aborted) return;
        if (performance.now() > times.end) break;
        if (performance.now() > at) {
          at = Infinity;
          await reported(false);
        }
      }
      await reported(true);
    } finally {
      // A kernel that has failed is replaced, and has no searches.
      if (kernel.instance === instance) await kernel.call({ method: "close_search", search });
    }
  }
}
