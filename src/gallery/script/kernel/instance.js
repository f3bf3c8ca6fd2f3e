// An instance of the kernel: passes requests and answers through its linear memory. The requests are those of
// crates/coupler-kernel/src/request.rs.

/** A request that the kernel cannot answer, with a sentence that says why. */
export class KernelError extends Error {}

/** A failure of the kernel itself, after which its instance is not used again. */
export class KernelFailure extends Error {}

/** The numbers of a pose before the positions of the joints, as Kernel::POSE_HEADER. */
export const POSE_HEADER = 15;

/** A running kernel. */
export class KernelInstance {
  constructor(/** @type {WebAssembly.Module} */ module) {
    this.exports = /** @type {KernelExports} */ (new WebAssembly.Instance(module, {}).exports);
    this.exports.kernel_start();
    // Made once: a step of a search takes a fraction of a millisecond, and what it leaves is collected after many megabytes.
    this.view = this.none = new Float64Array();
    this.encoder = new TextEncoder();
    this.decoder = new TextDecoder();
  }

  /**
   * The answer to a request, both as objects. Arrays of numbers are Float64Arrays, those of the answer of their own.
   * A list of requests has a list of answers.
   * @throws {KernelError} if the kernel cannot answer it @throws {KernelFailure} if the kernel fails @returns {any}
   */
  call(/** @type {object} */ request) {
    if (Array.isArray(request)) return request.map((/** @type {object} */ one) => this.call(one));
    /** @type {Float64Array[]} */ const arrays = [];
    let total = 0;
    const packed = (/** @type {string} */ key, /** @type {unknown} */ value) => {
      if (!(value instanceof Float64Array)) return exactNumbers(key, value);
      arrays.push(value);
      total += value.length;
      return { $: [total - value.length, value.length] };
    };
    const { json, numbers } = this.exchange(JSON.stringify(request, packed), arrays);
    const answer = JSON.parse(json, (_, value) => {
      if (!value?.$) return value;
      const [start, length] = value.$;
      return numbers.slice(start, start + length);
    });
    if (answer?.error !== undefined) throw new KernelError(answer.error);
    return answer;
  }

  /**
   * The answer to a request in JSON with arrays of numbers, one after another, to which it refers.
   * @param {string} request @param {Float64Array[]} arrays @returns {{ json: string, numbers: Float64Array }}
   * @throws {KernelFailure} if the kernel fails
   */
  exchange(request, arrays) {
    return this.#guarded((kernel) => {
      const total = arrays.reduce((sum, array) => sum + array.length, 0);
      if (total > 0) {
        const first = kernel.kernel_numbers(total);
        const input = new Float64Array(kernel.memory.buffer, first, total);
        let at = 0;
        for (const array of arrays) {
          input.set(array, at);
          at += array.length;
        }
      }
      // What is left of the room for characters of three bytes are blanks.
      const room = 3 * request.length;
      const place = kernel.kernel_allocate(room);
      const text = new Uint8Array(kernel.memory.buffer, place, room);
      text.fill(32, this.encoder.encodeInto(request, text).written);
      const parts = kernel.kernel_call(place, room);
      // The call may have moved the memory.
      const { buffer } = kernel.memory;
      const [start, length, first, count] = new Uint32Array(buffer, parts, 4);
      return {
        json: this.decoder.decode(new Uint8Array(buffer, start, length)),
        numbers: count ? new Float64Array(buffer, first, count) : this.none,
      };
    });
  }

  /**
   * The numbers of a study's pose at an input of a pass (Kernel::pose), valid until the next call; empty if there is none.
   * @throws {KernelFailure} if the kernel fails
   */
  pose(/** @type {number} */ study, /** @type {number} */ pass, /** @type {number} */ input) {
    return this.#guarded((kernel) => {
      const place = kernel.kernel_pose(study, pass, input);
      return this.#numbers(place, kernel.kernel_pose_length());
    });
  }

  /**
   * The position of a joint at an input of a pass, [x, y], valid until the next call.
   * @throws {KernelFailure} if the kernel fails @param {number} study @param {number} joint @param {number} pass @param {number} input
   */
  jointPosition(study, joint, pass, input) {
    return this.#guarded((kernel) =>
      this.#numbers(kernel.kernel_joint_position(study, joint, pass, input), 2),
    );
  }

  // The same view as before if it is of the same memory: there are sixty poses in a second.
  #numbers(/** @type {number} */ place, /** @type {number} */ count) {
    const { buffer } = this.exports.memory;
    const { view } = this;
    if (count === 0) return this.none;
    if (view.buffer !== buffer || view.byteOffset !== place || view.length !== count)
      this.view = new Float64Array(buffer, place, count);
    return this.view;
  }

  /** @template T @param {(kernel: KernelExports) => T} work */
  #guarded(work) {
    try {
      return work(this.exports);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      throw new KernelFailure(`the kernel failed: ${this.#panicMessage() || error.message}`);
    }
  }

  #panicMessage() {
    const { memory, kernel_panic_message: message, kernel_panic_length: length } = this.exports;
    try {
      return new TextDecoder().decode(new Uint8Array(memory.buffer, message(), length()));
    } catch {
      return "";
    }
  }
}

/** The kernel reads numbers as strings to the last bit, which it does not do with those of JSON. */
export function exactNumbers(/** @type {unknown} */ _, /** @type {unknown} */ value) {
  return typeof value === "number" && !Number.isInteger(value) ? String(value) : value;
}
