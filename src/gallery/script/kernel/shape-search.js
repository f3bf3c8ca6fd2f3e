// How curves fit a path, in the kernel.

/** The least part of an open curve that a whole curve is. */
export const WHOLE = 0.85;

/** A path to which curves are compared. Closed ones are compared with whole curves, open ones with portions. */
export class ShapeSearch {
  /** @param {Kernel} kernel @param {Outline} path @param {{ mirror: boolean, least: number, wanted?: number }} options */
  constructor(kernel, { points, closed }, { mirror, least, wanted = 1 }) {
    this.kernel = kernel;
    this.instance = kernel.instance;
    const kind = closed ? "closed" : "part";
    const opened = kernel.call({ method: "open_shape", points, kind, mirror, least, wanted });
    this.shape = opened.shape;
    /** The most candidates; if these are more than are wanted, they are to be compared closely. */
    this.most = opened.most;
  }

  /**
   * The curves of an index that are most like the path, the likeliest first; null if stopped.
   * @param {ShapeIndex} index @param {Slices} slices @returns {Promise<Candidate[] | null>}
   */
  async candidates({ family, first, curves }, slices) {
    for (let from = 0; ;) {
      const found = this.kernel.call({ method: "compare_shape", shape: this.shape, curves, from });
      if (found.next === null) {
        const { numbers, likenesses } = found;
        return Array.from(numbers, (number, k) => ({
          family,
          curve: first + number,
          likeness: likenesses[k],
        }));
      }
      if (!(await slices.goOn())) return null;
      from = found.next;
    }
  }

  /** How much a curve is like the path, compared closely; null if it is not. @param {Outline} curve @returns {number | null} */
  likeness({ points, closed }) {
    return this.kernel.call({ method: "compare_closely", shape: this.shape, points, closed }).likeness;
  }

  /** How a curve fits the path; null if it does not. @param {Outline} curve @returns {Fit | null} */
  fit({ points, closed }) {
    return fitOf(this.kernel.call({ method: "fit_shape", shape: this.shape, points, closed }));
  }

  /** Releases it. */
  close() {
    if (this.kernel.instance === this.instance)
      this.kernel.call({ method: "close_shape", shape: this.shape });
  }
}

/** The best fit of a curve to another one; null if there is none. @param {Outline} to @param {Outline} curve */
export function bestFit(/** @type {Kernel} */ kernel, to, curve, mirror) {
  const search = new ShapeSearch(kernel, to, { mirror, least: WHOLE });
  try {
    return search.fit(curve);
  } finally {
    search.close();
  }
}

/** The deviation of a curve from another one where both are. @param {Outline} from @param {Outline} curve */
export function deviationInPlace(/** @type {Kernel} */ kernel, from, curve) {
  const { points, closed } = curve;
  return fitOf(kernel.call({ method: "deviation", from: from.points, points, closed }));
}

/** @returns {Fit | null} */
function fitOf(answer) {
  return answer.fit;
}
