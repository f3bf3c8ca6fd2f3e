// Tests in a browser what a plate is saved as by its export menu beside drawings, a GIF:
// node tests/gallery/export-plate.mjs ATLAS
//
// ATLAS is the folder of a rendered atlas with the families `evans` and `excavator`. See browser.mjs for the environment.

import assert from "node:assert/strict";

import { openGallery, runTests, saved } from "./browser.mjs";

const [atlas] = process.argv.slice(2);

const tests = [
  [
    "6.11",
    "a GIF has the motion of the animated SVG",
    async ({ browser }) => {
      // Of that many states of an excavator every other one is a frame.
      for (const [fragment, stride] of [
        ["/evans/curve/1.1.1?p=2.5", 1],
        ["/excavator/curve/1.1.1", 2],
      ]) {
        const view = await openGallery(browser, atlas, fragment, { acceptDownloads: true });
        await view.page.waitForSelector(".export-button");
        const svg = await saved(view.page, "Animated SVG .svg");
        const seconds = Number(/dur="([0-9.]+)s"/.exec(svg.text)[1]);
        const states = /<animate [^>]*values="([^"]*)"/.exec(svg.text)[1].split(";").length;
        const gif = await saved(view.page, "GIF animated");
        assert.equal(gif.name, svg.name.replace(".svg", ".gif"));
        assert.ok(gif.bytes.length < 3e6, `${gif.bytes.length} bytes`);
        // Forever, says the extension of Netscape.
        assert.ok(gif.bytes.includes(Buffer.from("NETSCAPE2.0\x03\x01\0\0\0", "latin1")));
        const { width, height, frames, time, changes, paper } = await decoded(view.page, gif.bytes);
        assert.deepEqual([width, height, frames], [800, 600, (states - 1) / stride]);
        assert.ok(Math.abs(time - 1e6 * seconds) < 1, `${time} µs instead of ${seconds} s`);
        // Where the motion turns round, two frames are the same.
        const least = changes.sort((a, b) => a - b)[Math.ceil(frames / 20)];
        assert.ok(least > 20 && changes.at(-1) < 60000, `${changes}`);
        assert.deepEqual(paper, [255, 253, 248, 255]);
        await view.close();
      }
    },
  ],
];

/** What the browser's own decoder sees in a GIF. */
function decoded(page, bytes) {
  return page.evaluate(
    async (data) => {
      const decoder = new ImageDecoder({ type: "image/gif", data: Uint8Array.from(data) });
      await decoder.tracks.ready;
      await decoder.completed;
      const { frameCount: frames } = decoder.tracks.selectedTrack;
      const canvas = document.createElement("canvas");
      const context = canvas.getContext("2d", { willReadFrequently: true });
      let [time, before] = [0, null];
      const changes = [];
      for (let frameIndex = 0; frameIndex < frames; frameIndex += 1) {
        const { image } = await decoder.decode({ frameIndex });
        [canvas.width, canvas.height] = [image.displayWidth, image.displayHeight];
        context.drawImage(image, 0, 0);
        time += image.duration;
        image.close();
        const pixels = new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
        if (before) changes.push(pixels.reduce((sum, pixel, k) => sum + (pixel === before[k] ? 0 : 1), 0));
        before = pixels;
      }
      const { width, height } = canvas;
      return { width, height, frames, time, changes, paper: [...context.getImageData(2, 2, 1, 1).data] };
    },
    [...bytes],
  );
}

await runTests(tests);
