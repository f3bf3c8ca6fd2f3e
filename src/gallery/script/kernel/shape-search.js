// How curves fit a path, in the kernel.

/** The least part of an open curve that a whole curve is. */
export const WHOLE = 0.85;

/** A path to which curves are compared. Closed ones are compared with whole curves, open ones with portions. */
export class ShapeSearch {
  /** @param {SearchKernel} kernel @param {SearchedPath} path @param {{ mirror: boolean, least: number, wanted?: number }} options */
  static async open(kernel, path, { mirror, least, wanted = 1 }) {
    const { instance } = kernel;
    return new ShapeSearch(kernel, instance, await kernel.call(openRequest(path, mirror, least, wanted)));
  }

  /** @param {SearchKernel} kernel @param {object} instance @param {{ shape: number, most: number }} opened */
  constructor(kernel, instance, { shape, most }) {
    this.kernel = kernel;
    this.instance = instance;
    this.shape = shape;
    /** The most candidates; if these are more than are wanted, they are to be compared closely. */
    this.most = most;
  }

  /**
   * Compares the curves of an index, whose numbers follow those of the indexes before: the numbers of those of all so far that are most like
   * the path; null if stopped. @param {ShapeIndex} index @param {AbortSignal} signal @returns {Promise<Float64Array | null>}
   */
  async compare({ curves }, signal) {
    for (let from = 0; ;) {
      const found = await this.kernel.call({ method: "compare_shape", shape: this.shape, curves, from });
      if (found.next === null) return found.numbers;
      if (signal.aborted) return null;
      from = found.next;
    }
  }

  /** How much curves are like the path, compared closely; NaN for those that are not. @param {GivenCurves} given @returns {Promise<GivenCurves & { likenesses: Float64Array }>} */
  compareClosely(given) {
    return this.kernel.call({ ...given, method: "compare_closely", shape: this.shape }, "points");
  }

  /** How a curve fits the path, `fit` or null, and what of it is the same for similar curves. @param {Outline} curve @returns {Promise<FittedCurve>} */
  fit({ points, closed }) {
    return this.kernel.call({ method: "fit_shape", shape: this.shape, points, closed });
  }

  /** Releases it. */
  async close() {
    if (this.kernel.instance === this.instance)
      await this.kernel.call({ method: "close_shape", shape: this.shape });
  }
}

/**
 * The path to search for of a shape, { points, kind }: without noise, and with points enough for its form to be seen.
 * @param {SearchKernel} kernel @param {Outline} shape @returns {Promise<SearchedPath>}
 */
export function drawnPath(kernel, { points, closed }, /** @type {boolean} */ isPart) {
  return kernel.call({ method: "drawn_path", points, closed, is_part: isPart });
}

/** The best fit of a curve to another one; null if there is none. @param {Outline} to @param {Outline} curve @returns {Fit | null} */
export function bestFit(/** @type {Kernel} */ kernel, to, curve, /** @type {boolean} */ mirror) {
  const path = { points: to.points, kind: to.closed ? "closed" : "part" };
  const { shape } = kernel.call(openRequest(path, mirror, WHOLE, 1));
  const { instance } = kernel;
  const { points, closed } = curve;
  try {
    return kernel.call({ method: "fit_shape", shape, points, closed }).fit;
  } finally {
    if (kernel.instance === instance) kernel.call({ method: "close_shape", shape });
  }
}

/** @param {boolean} mirror @param {number} least @param {number} wanted */
function openRequest(/** @type {SearchedPath} */ { points, kind }, mirror, least, wanted) {
  return { method: "open_shape", points, kind, mirror, least, wanted };
}

/** The deviation of a curve from another one where both are. @param {Outline} from @param {Outline} curve @returns {Fit | null} */
export function deviationInPlace(/** @type {Kernel} */ kernel, from, curve) {
  const { points, closed } = curve;
  return kernel.call({ method: "deviation", from: from.points, points, closed }).fit;
}
