// A kernel in a worker of its own, so that a long search blocks neither the page nor another search.

import { exactNumbers, KernelError, KernelFailure, KernelInstance } from "./instance.js";

// A worker without requests is ended after this time in milliseconds, and with it the memory of its indexes.
const IDLE_MILLISECONDS = 120_000;

/** A kernel whose answers are promises. After a failure, or a pause, a new worker replaces its worker, `instance`. */
export class KernelWorker {
  idle = 0;
  /** @type {Worker | null} */ worker = null;
  /** The requests without an answer: they are answered in their order. @type {Waiting[]} */ waiting = [];

  constructor(/** @type {WebAssembly.Module} */ module) {
    this.module = module;
  }

  get instance() {
    this.worker ??= this.#start();
    return this.worker;
  }

  /**
   * Resolves to the answer to a request. The memory of the array `lent` of it comes back as that of the answer: copies would be kept until
   * garbage is collected, which may be after a hundred megabytes of them.
   * @param {Record<string, any>} request @returns {Promise<any>}
   */
  call(request, lent = "") {
    clearTimeout(this.idle);
    return new Promise((resolve, reject) => {
      this.instance.postMessage({ request, lent }, lent ? [request[lent].buffer] : []);
      this.waiting.push({ resolve, reject });
    });
  }

  #start() {
    const parts = [KernelError, KernelFailure, KernelInstance, exactNumbers, serveKernel];
    const source = [...parts, "serveKernel();"].join("\n");
    const place = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    const worker = new Worker(place);
    worker.onmessage = ({ data }) => {
      if (data.isFailure) this.#fail(data.error);
      else if (data.error !== undefined) this.waiting.shift()?.reject(new KernelError(data.error));
      else this.waiting.shift()?.resolve(data.answer);
      URL.revokeObjectURL(place);
      clearTimeout(this.idle);
      if (!this.waiting.length) this.idle = setTimeout(() => this.end(), IDLE_MILLISECONDS);
    };
    worker.onerror = ({ message }) => this.#fail(message || "this browser does not run its worker");
    worker.postMessage({ module: this.module });
    return worker;
  }

  /** Ends the worker; a further request starts another. */
  end() {
    clearTimeout(this.idle);
    this.worker?.terminate();
    this.worker = null;
  }

  #fail(/** @type {string} */ message) {
    this.end();
    for (const { reject } of this.waiting.splice(0)) reject(new KernelFailure(message));
  }
}

/** Answers requests in a worker, whose first message is the module. Its script is the text of this function and its imports. */
function serveKernel() {
  /** @type {KernelInstance} */ let kernel;
  const hasMore = (/** @type {Record<string, any>} */ { next, is_done, is_complete, count, full_count }) =>
    next || is_done === false || is_complete === false || count < full_count;
  self.onmessage = ({ data: { module, request, lent } }) => {
    try {
      if (module) {
        kernel = new KernelInstance(module);
        return;
      }
      // After a step of several: a message of each would be kept until garbage is collected, a kilobyte each on both sides.
      const end = performance.now() + 20;
      let answer = kernel.call(request);
      while (hasMore(answer) && performance.now() < end) {
        if (answer.next) request.from = answer.next;
        answer = kernel.call(request);
      }
      if (!lent) self.postMessage({ answer });
      else
        self.postMessage(
          { answer: { ...answer, [lent]: request[lent] } },
          { transfer: [request[lent].buffer] },
        );
    } catch (error) {
      self.postMessage({ error: error.message, isFailure: !(error instanceof KernelError) });
    }
  };
}
