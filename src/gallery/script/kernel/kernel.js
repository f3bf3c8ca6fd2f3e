// The kernel, which computes everything about linkages: families and their studies, by the page's own objects.
//
// After a failure of the kernel, a new instance replaces it, in which families and studies are opened again when
// they are used.

import { freeArray } from "../data/packed.js";
import { FourBarFinder } from "./finder.js";
import { KernelFailure, KernelInstance } from "./instance.js";
import { KernelStudy } from "./study.js";
import { KernelWorker } from "./worker.js";

// What does not work without the kernel.
const WITHOUT_KERNEL = "linkages are not moved, changed, compared in detail, found by shape or exported";

/** The kernel of an atlas, loaded when it is first needed. */
export class KernelLoader {
  constructor(/** @type {Pick<Atlas, "kernelModule">} */ atlas) {
    this.atlas = atlas;
    /** @type {Kernel | null} */ this.kernel = null;
    /** @type {Promise<Kernel> | null} */ this.loading = null;
  }

  /** Resolves to the kernel. */
  load() {
    return (this.loading ??= this.#load());
  }

  async #load() {
    const noWebAssembly = `This browser does not run WebAssembly: ${WITHOUT_KERNEL}.`;
    if (typeof WebAssembly !== "object" || typeof DecompressionStream !== "function")
      throw new Error(noWebAssembly);
    const code = await this.atlas.kernelModule().catch((error) => {
      throw new Error(`${error.message}. Without it, ${WITHOUT_KERNEL}.`, { cause: error });
    });
    try {
      this.kernel = new Kernel(await WebAssembly.compile(code));
      freeArray(new Uint8Array(code));
    } catch (error) {
      throw new Error(`${noWebAssembly} (${error.message})`, { cause: error });
    }
    return this.kernel;
  }
}

/** A kernel with its open families. */
export class Kernel {
  constructor(/** @type {WebAssembly.Module} */ module) {
    this.module = module;
    this.instance = new KernelInstance(module);
    /** @type {Map<string, KernelFamily>} */ this.families = new Map();
    // The two searches have kernels of their own, in workers: studies need this one sixty times a second.
    this.curveSearch = new KernelWorker(module);
    this.fourBars = new FourBarFinder(new KernelWorker(module));
  }

  /** Calls `work` with the current instance, and replaces it if it fails. @template T @param {(instance: KernelInstance) => T} work */
  use(work) {
    try {
      return work(this.instance);
    } catch (error) {
      if (error instanceof KernelFailure) this.instance = new KernelInstance(this.module);
      throw error;
    }
  }

  /** The answer to a request. */
  call(/** @type {object} */ request) {
    return this.use((instance) => instance.call(request));
  }

  /** A family of the atlas (data/reader.js), opened. @param {Pick<Family, "id" | "manifest">} _ */
  family({ id, manifest }) {
    const family = this.families.get(id) ?? new KernelFamily(this, manifest);
    this.families.set(id, family);
    return family;
  }

  /** The data of a curve, as an atlas of it alone has them. @param {KernelCurve} requested */
  curveData(requested) {
    return this.call({ method: "curve_data", curve: withHandle(requested) });
  }

  /**
   * A curve of a family with changes: the values that its cell assigns; the others are derived from them.
   * @param {Family} family @param {number} curve @param {Iterable<[string, number]>} changes @returns {KernelCurve}
   */
  curve(family, curve, changes = []) {
    const { cells, curves, names, assignments } = family;
    const cell = curves.cell[curve];
    const value = (/** @type {number} */ slot) => cells.values[cell * names.length + slot];
    /** @type {CurveRequest} */ const request = {
      cell: cells.number[cell],
      curve: [curves.trace[curve], curves.circuit[curve]],
      values: assignments[cells.assignment[cell]].map((slot) => [names[slot], value(slot)]),
      changes: [...changes],
    };
    return { family: this.family(family), curve: request };
  }

  /**
   * Opens the study of a curve, as `curve()` gives it, on the circuit with the index `shown` among all; by default on its own.
   * @param {KernelCurve} requested @param {{ shown?: number | null, isRough?: boolean }} options
   */
  study(requested, { shown = null, isRough = false } = {}) {
    return new KernelStudy(this, () => ({
      method: "open_study",
      curve: withHandle(requested),
      shown,
      is_rough: isRough,
    }));
  }

  /** A curve as a file in a text format: { name, text }. @param {KernelCurve} requested */
  export(requested, /** @type {string} */ format) {
    return this.call({ method: "export", curve: withHandle(requested), format });
  }

  /** A manifest fragment with the cells of curves. @param {KernelCurve[]} curves */
  fragment(curves) {
    return this.call({ method: "fragment", curves: curves.map(withHandle) }).text;
  }
}

function withHandle(/** @type {KernelCurve} */ { family, curve }) {
  return { ...curve, family: family.handle };
}

/** An open family of a kernel. */
class KernelFamily {
  /** @type {FamilyDescription} */ opened;

  constructor(/** @type {Kernel} */ kernel, /** @type {string} */ manifest) {
    this.kernel = kernel;
    this.manifest = manifest;
    /** @type {KernelInstance | null} */ this.instance = null;
  }

  /** What the kernel says of the family. */
  get description() {
    if (this.instance !== this.kernel.instance) {
      this.opened = this.kernel.call({ method: "open_family", manifest: this.manifest });
      this.instance = this.kernel.instance;
    }
    return this.opened;
  }

  get handle() {
    return this.description.family;
  }
}
