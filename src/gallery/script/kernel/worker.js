// A kernel in a worker of its own, so that a long search blocks neither the page nor another search.

import { exactNumbers, KernelError, KernelFailure, KernelInstance } from "./instance.js";

/** A kernel whose answers are promises. After a failure a new worker replaces its worker, `instance`. */
export class KernelWorker {
  /** @type {Worker | null} */ worker = null;
  /** The requests without an answer: they are answered in their order. @type {Waiting[]} */ waiting = [];

  constructor(/** @type {WebAssembly.Module} */ module) {
    this.module = module;
  }

  get instance() {
    this.worker ??= this.#start();
    return this.worker;
  }

  /** Resolves to the answer to a request. @returns {Promise<any>} */
  call(/** @type {object} */ request) {
    return new Promise((resolve, reject) => {
      this.instance.postMessage(request);
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
    };
    worker.onerror = ({ message }) => this.#fail(message || "this browser does not run its worker");
    worker.postMessage(this.module);
    return worker;
  }

  #fail(/** @type {string} */ message) {
    this.worker?.terminate();
    this.worker = null;
    for (const { reject } of this.waiting.splice(0)) reject(new KernelFailure(message));
  }
}

/** Answers requests in a worker, whose first message is the module. Its script is the text of this function and its imports. */
function serveKernel() {
  /** @type {KernelInstance} */ let kernel;
  self.onmessage = ({ data }) => {
    try {
      if (data instanceof WebAssembly.Module) kernel = new KernelInstance(data);
      else self.postMessage({ answer: kernel.call(data) });
    } catch (error) {
      self.postMessage({ error: error.message, isFailure: !(error instanceof KernelError) });
    }
  };
}
