// The kernel of a rendered atlas under node.

import { readFileSync } from "node:fs";
import { join } from "node:path";

import { KernelLoader } from "../../src/gallery/script/kernel/kernel.js";

/** The kernel in the page of an atlas. */
export function kernelOf(folder) {
  const page = readFileSync(join(folder, "index.html"), "utf8");
  const [, textContent] = page.match(
    /<script type="application\/octet-stream" id="kernel">([^<]*)<\/script>/,
  );
  return new KernelLoader({ getElementById: () => ({ textContent }) }).load();
}
