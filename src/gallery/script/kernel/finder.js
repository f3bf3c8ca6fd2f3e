// Searches for four-bars whose coupler curves are nearest to a path, in the kernel.

// The time, in milliseconds, after which the index does not grow before a search, and after which the search says what it
// has found so far.
const GROW_MS = 1000;
const REPORT_MS = 2000;

/** The most answers of a search. */
export const MAX_FOUR_BARS = 5;

/** The search for four-bars of a kernel in a worker. One search is made at a time: its index does not grow meanwhile. */
export class FourBarFinder {
  /** @type {Promise<unknown>} */ running = Promise.resolve();

  /** The curves of the index. */
  count = 0;

  constructor(/** @type {SearchKernel} */ kernel) {
    this.kernel = kernel;
  }

  /**
   * Searches for a path in slices (view/slices.js), and calls `report(found, isDone)` with what there is after two
   * seconds and at the end. In an index that is not complete by then, it searches again when it is.
   * @param {{ points: Float64Array, closed: boolean, name: string }} path
   * @param {{ fullTurn: boolean, maxLink: number }} options
   * @param {Slices} slices @param {(found: FoundFourBars, isDone: boolean) => void} report
   */
  find(path, options, slices, report) {
    return this.#after(async () => {
      if (slices.stopped()) return;
      const began = performance.now();
      const isComplete = await this.#grow(slices, began + GROW_MS);
      await this.#search(path, options, slices, began + REPORT_MS, (found, isDone) =>
        report(found, isDone && isComplete),
      );
      if (isComplete || !(await this.#grow(slices, Infinity))) return;
      await this.#search(path, options, slices, Infinity, report);
    });
  }

  /** Completes the index while nothing is searched. */
  prepare(/** @type {Slices} */ slices) {
    return this.#after(() => this.#grow(slices, Infinity));
  }

  #after(work) {
    this.running = this.running.catch(() => {}).then(work);
    return this.running;
  }

  /** Grows the index until it is complete, or a time; whether it is complete. */
  async #grow(slices, until) {
    for (;;) {
      if (!(await slices.goOn()) || performance.now() > until) return false;
      const { count, full_count: full } = await this.kernel.call({ method: "grow_index" });
      this.count = count;
      if (count === full) return true;
    }
  }

  async #search({ points, closed, name }, { fullTurn, maxLink }, slices, reportAt, report) {
    const { kernel } = this;
    const { instance } = kernel;
    const { search } = await kernel.call({
      method: "open_search",
      points,
      kind: closed ? "closed" : "part",
      full_turn: fullTurn,
      max_link: maxLink,
      most: MAX_FOUR_BARS,
    });
    try {
      const reported = async (isDone) => {
        let found = null;
        do {
          if (!(await slices.goOn())) return;
          found = await kernel.call({ method: "answers", search, name });
        } while (!found.is_complete);
        report({ ...found, index_count: this.count }, isDone);
      };
      let at = reportAt;
      while (!(await kernel.call({ method: "step_search", search })).is_done) {
        if (!(await slices.goOn())) return;
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
