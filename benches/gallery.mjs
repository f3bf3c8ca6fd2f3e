// Compares the galleries of two renderings in Chromium, in turns: node benches/gallery.mjs BEFORE AFTER
//
// BEFORE and AFTER are folders with the atlas of this repository, written by two versions of the program. Prints for each,
// the best of ROUNDS: the milliseconds until the first view is drawn; until a plate is drawn that is opened first; the
// frames a second of a plate in motion; the milliseconds and the frames from a slider's event to the redrawn linkage, of
// several linkages; and the memory of a plate. The environment is that of tests/gallery/browser.mjs.

import { launchBrowser, openGallery } from "../tests/gallery/browser.mjs";

const ROUNDS = 5;
const STILL = { reducedMotion: "reduce" };
// Of the linkages of the catalogue, those with the most joints, and those that take longest to solve.
const PLATES = {
  evans: "/evans/curve/1.1.1",
  jansen: "/jansen/curve/1.1.1",
  klann: "/klann/curve/1.1.1",
  "peaucellier-lipkin": "/peaucellier-lipkin/curve/1.1.1",
  "hart-inversor": "/hart-inversor/curve/1.1.1",
};

const folders = process.argv.slice(2, 4);
const results = folders.map(() => new Map());

/** Notes a figure of a folder; `better` chooses the better of two. */
function note(k, name, value, better = Math.min) {
  results[k].set(name, better(results[k].get(name) ?? value, value));
}

/** Milliseconds from the start of loading until something is drawn. */
async function timeUntil(page, selector) {
  await page.waitForSelector(selector, { timeout: 30000 });
  return page.evaluate(() => performance.now());
}

/** The frames a second in which the linkage moved, of two seconds. */
const frameRate = (page) =>
  page.evaluate(async () => {
    const tracer = document.querySelector(".tracer");
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const start = performance.now();
    let [moved, last] = [0, ""];
    while (performance.now() - start < 2000) {
      await frame();
      const now = tracer.getAttribute("cx") + tracer.getAttribute("cy");
      if (now !== last) moved += 1;
      last = now;
    }
    return (1000 * moved) / (performance.now() - start);
  });

/** The milliseconds and the frames from a slider's event to the redrawn linkage, the median of several events. */
const sliderResponse = (page) =>
  page.evaluate(async () => {
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const rest = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
    const slider = document.querySelector(".parameters input[type=range]");
    const joints = () =>
      [...document.querySelectorAll(".moving path.link")].map((path) => path.getAttribute("d")).join();
    const found = [];
    for (let k = 0; k < 15; k += 1) {
      await frame();
      const before = joints();
      const start = performance.now();
      slider.value = Number(slider.value) + (slider.max - slider.min) * (k % 2 ? -0.01 : 0.01);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      let frames = 0;
      while (joints() === before && frames < 100) {
        await frame();
        frames += 1;
      }
      // The frame is shown after its callbacks have run.
      const channel = new MessageChannel();
      await new Promise((done) => {
        channel.port1.onmessage = done;
        channel.port2.postMessage(null);
      });
      found.push([performance.now() - start, frames]);
      await rest(20);
    }
    const median = (part) => found.map((one) => one[part]).sort((a, b) => a - b)[7];
    return [median(0), median(1)];
  });

/** The memory of a page in MB after garbage collection. */
async function memoryOf(page) {
  const client = await page.context().newCDPSession(page);
  await client.send("HeapProfiler.collectGarbage");
  const {
    usedSize,
    embedderHeapUsedSize = 0,
    backingStorageSize = 0,
  } = await client.send("Runtime.getHeapUsage");
  await client.detach();
  return (usedSize + embedderHeapUsedSize + backingStorageSize) / 1e6;
}

async function measure(browser, folder, k) {
  const first = await openGallery(browser, folder, "/");
  note(k, "first view, ms", await timeUntil(first.page, ".families .tile-picture :is(path, img)"));
  await first.close();
  const opened = await openGallery(browser, folder, PLATES.evans);
  note(k, "plate opened first, ms", await timeUntil(opened.page, ".moving path.link[d]"));
  note(k, "memory of a plate, MB", await memoryOf(opened.page));
  note(k, "evans in motion, frames/s", await frameRate(opened.page), Math.max);
  await opened.go(PLATES.jansen);
  note(k, "jansen in motion, frames/s", await frameRate(opened.page), Math.max);
  await opened.close();
  for (const [name, address] of Object.entries(PLATES)) {
    const still = await openGallery(browser, folder, address, STILL);
    await still.page.waitForSelector(".moving path.link[d]");
    const [milliseconds, frames] = await sliderResponse(still.page);
    note(k, `slider of ${name}, ms`, milliseconds);
    note(k, `slider of ${name}, frames`, frames);
    await still.close();
  }
}

const browser = await launchBrowser();
for (let round = 0; round < ROUNDS; round += 1)
  for (const [k, folder] of folders.entries()) await measure(browser, folder, k);
await browser.close();
console.log(["", ...folders].join("\t"));
for (const name of results[0].keys())
  console.log([name, ...results.map((found) => found.get(name).toFixed(1))].join("\t"));
