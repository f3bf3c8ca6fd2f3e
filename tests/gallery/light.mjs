// Light: the first view, and memory.

import assert from "node:assert/strict";

import { opened } from "./browser.mjs";
import { check, large, on } from "./desk.mjs";

check(
  "8.1",
  "the first view within a second, and little memory for 7,800 curves",
  null,
  async ({ browser }) => {
    // The best of three, for the machine may be busy with something else.
    const paints = [];
    for (let k = 0; k < 3; k += 1) {
      const first = await opened(browser, large, "/");
      paints.push(await firstView(first.page));
      await first.close();
    }
    const painted = Math.min(...paints);
    assert.ok(painted < 1000, `drawn after ${painted.toFixed(0)} ms`);
    const g = await opened(browser, large, "/");
    const { page } = g;
    await firstView(page);
    const memory = await memoryOf(page);
    console.log(`     first view drawn after ${painted.toFixed(0)} ms; ${memory.told}`);
    assert.ok(memory.bytes < 60e6, memory.told);
    await g.close();
  },
);

check(
  "8.2",
  "scrolled from end to end, memory and nodes stay flat",
  on(large, "/hrones-nelson?show=curves"),
  async (g, page) => {
    await page.waitForSelector(".window svg path");
    const before = await memoryOf(page);
    const frames = await page.evaluate(async () => {
      const end = document.documentElement.scrollHeight;
      const times = [];
      let last = performance.now();
      for (let y = 0; y < end; y += 400) {
        window.scrollTo(0, y);
        await new Promise((done) => {
          requestAnimationFrame(done);
        });
        times.push(performance.now() - last);
        last = performance.now();
      }
      return times.sort((a, b) => a - b);
    });
    const after = await memoryOf(page);
    const at = (part) => frames[Math.floor(part * (frames.length - 1))].toFixed(0);
    console.log(
      `     frames ${at(0.5)} ms in the middle, ${at(0.95)} of 95 in 100; before ${before.told}; after ${after.told}`,
    );
    assert.ok(after.nodes < before.nodes + 3000, `${after.nodes} nodes, of ${before.nodes}`);
    assert.ok(after.bytes < before.bytes + 10e6, after.told);
    assert.ok(after.bytes < 60e6, after.told);
  },
);

check("8.3", "the size of the data is said", on(large, "/"), async (g, page) => {
  assert.match(
    await page.getByRole("contentinfo").innerText(),
    /1 family · 780 pages · 7,800 curves · 6\.\d MB of data/,
  );
});

/**
 * What a page holds after its litter is gone: { bytes, nodes, told }, the heap with the arrays that lie
 * outside of it.
 */
async function memoryOf(page) {
  const client = await page.context().newCDPSession(page);
  await client.send("Performance.enable");
  await client.send("HeapProfiler.collectGarbage");
  const { metrics } = await client.send("Performance.getMetrics");
  const { embedderHeapUsedSize = 0, backingStorageSize = 0 } = await client.send("Runtime.getHeapUsage");
  const metric = (name) => metrics.find((candidate) => candidate.name === name).value;
  await client.detach();
  const [heap, nodes] = [metric("JSHeapUsedSize"), metric("Nodes")];
  const bytes = heap + embedderHeapUsedSize + backingStorageSize;
  const mega = (size) => (size / 1e6).toFixed(1);
  return {
    bytes,
    nodes,
    told: `${mega(bytes)} MB (heap ${mega(heap)}, arrays ${mega(backingStorageSize)}, DOM ${mega(embedderHeapUsedSize)}), ${nodes} nodes`,
  };
}

/** Milliseconds from the beginning until the first pages are drawn from their data. */
async function firstView(page) {
  await page.waitForSelector(".families .tile-picture path", { timeout: 20000 });
  return page.evaluate(() => performance.now());
}
