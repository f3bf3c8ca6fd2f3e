// A study of the kernel: the linkage of a curve in motion.

/** The study of a curve that may not exist; all methods but `close` need one that exists. */
export class KernelStudy {
  /** What the kernel says of it. @type {StudyAnswer | MissingCurve} */ answer;
  /** @type {object | null} */ instance = null;

  /** `request()` gives the request that opens the study. @param {Kernel} kernel @param {() => object} request */
  constructor(kernel, request) {
    this.kernel = kernel;
    this.request = request;
    this.#open();
  }

  /** Whether the curve exists; otherwise `answer.reason` says why not. */
  get exists() {
    return this.answer.study !== undefined;
  }

  /** Releases the study. */
  close() {
    if (this.exists && this.instance === this.kernel.instance) this.#ask("close_study");
    this.instance = null;
  }

  /** The curve to a tolerance. @returns {CurvePath} */
  path(/** @type {number} */ tolerance) {
    return this.#ask("path", { tolerance });
  }

  /** The measures; those that do not apply are absent. @returns {ComputedMeasures} */
  measures() {
    const { values, straight } = this.#ask("measures");
    /** @type {Record<string, number>} */ const infinities = { inf: Infinity, "-inf": -Infinity };
    const there = Object.entries(values).filter(([, value]) => value !== null);
    return {
      straight,
      values: Object.fromEntries(there.map(([name, value]) => [name, infinities[value] ?? value])),
    };
  }

  /** @returns {Cognates | null} */
  cognates() {
    return this.#ask("cognates");
  }

  /** @returns {Centrodes | null} */
  centrodes(/** @type {number} */ samples) {
    return this.#ask("centrodes", { samples });
  }

  /**
   * The motion of a joint at a place, or about so many places of the circuit, perhaps against a load.
   * @param {{ joint: number, count: number, place: Place | null, load: string | null }} of @returns {JointMotion}
   */
  motion({ joint, count, place, load }) {
    const at = place && { pass: place.pass, input: place.input };
    return this.#ask("joint_motion", { joint, count, place: at, load });
  }

  /** The joints that dimensions move. @returns {HandleAnswer[]} */
  handles() {
    return this.#ask("handles").handles;
  }

  /**
   * Moves a joint to a place, the input held, by the names that are unlocked.
   * @param {{ joint: number, to: Point, pass: number, input: number, unlocked: string[] }} drag @returns {DragAnswer}
   */
  drag({ joint, to, pass, input, unlocked }) {
    return this.#ask("drag", { joint, to, pass, input, unlocked });
  }

  /** The reading at the nearest point of the curve. */
  nearest(/** @type {number} */ x, /** @type {number} */ y) {
    return readingOf(this.#ask("nearest", { point: [x, y] }));
  }

  /** The reading at an input of a pass. */
  reading(/** @type {number} */ pass, /** @type {number} */ input) {
    return readingOf(this.#ask("reading", { pass, input }));
  }

  /** The numbers of the pose at an input of a pass (instance.js), valid until the next call. */
  pose(/** @type {number} */ pass, /** @type {number} */ input) {
    const study = this.#handle();
    return this.kernel.use((instance) => instance.pose(study, pass, input));
  }

  /** The position of a joint at an input of a pass, [x, y], valid until the next call. */
  jointPosition(/** @type {number} */ joint, /** @type {number} */ pass, /** @type {number} */ input) {
    const study = this.#handle();
    return this.kernel.use((instance) => instance.jointPosition(study, joint, pass, input));
  }

  #ask(/** @type {string} */ method, more = {}) {
    return this.kernel.call({ method, study: this.#handle(), ...more });
  }

  #open() {
    if (this.instance === this.kernel.instance) return;
    this.answer = this.kernel.call(this.request());
    this.instance = this.kernel.instance;
  }

  #handle() {
    this.#open();
    if (this.answer.study === undefined) throw new Error(this.answer.reason);
    return this.answer.study;
  }
}

/** At limits the speed is infinite, which JSON cannot say. @returns {Reading | null} */
function readingOf(/** @type {(Omit<Reading, "speed"> & { speed: number | null }) | null} */ answer) {
  return answer && { ...answer, speed: answer.speed ?? Infinity };
}
