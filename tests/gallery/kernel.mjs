// The kernel of a rendered atlas under node.

import { readFileSync } from "node:fs";
import { join } from "node:path";

import { unpackGzip } from "../../src/gallery/script/data/packed.js";
import { KernelLoader } from "../../src/gallery/script/kernel/kernel.js";

/** The kernel of an atlas, from its script. */
export function kernelOf(folder) {
  let module = "";
  const couplerAtlas = {
    kernel: (file) => {
      ({ module } = file);
    },
  };
  new Function("couplerAtlas", readFileSync(join(folder, "kernel.js"), "utf8"))(couplerAtlas);
  return new KernelLoader({ kernelModule: () => unpackGzip(module) }).load();
}
