// Plates in SVG as images of pixels, which the browser draws: PNG, and GIF, which the kernel encodes.

import { KernelWorker } from "../../kernel/worker.js";

/** The resolution of PNG plates, in pixels per inch. */
const PLATE_DPI = 300;
/** The width of GIF plates, in pixels. */
const GIF_WIDTH = 800;
/** The most frames of a GIF. */
const MAX_FRAMES = 240;
/** The shortest of them in hundredths of a second: browsers show those of one for ten. */
const LEAST_DELAY = 3;

/** A plate in SVG, whose size is in millimetres, as the bytes of a PNG image. */
export async function pngOfSvg(/** @type {string} */ svg) {
  const { canvas, draw } = canvasOfSvg(svg, (width) => (width / 25.4) * PLATE_DPI);
  await draw(svg);
  /** @type {Blob | null} */ const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  if (!blob) throw new Error("the browser cannot create an image of this size");
  return new Uint8Array(await blob.arrayBuffer());
}

/** A canvas of the width that is given for that of an SVG in millimetres. @param {(width: number) => number} widthOf */
function canvasOfSvg(/** @type {string} */ svg, widthOf) {
  const [width, height] = ["width", "height"].map((side) =>
    Number(new RegExp(`^<svg[^>]* ${side}="([0-9.]+)mm"`).exec(svg)?.[1]),
  );
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(widthOf(width));
  canvas.height = Math.round((widthOf(width) * height) / width);
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const draw = async (/** @type {string} */ text) => {
    const image = new Image();
    // A data URL does not taint the canvas.
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
    await image.decode();
    context?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return context?.getImageData(0, 0, canvas.width, canvas.height).data.buffer ?? new ArrayBuffer();
  };
  return { canvas, draw };
}

/**
 * An animated plate as the bytes of a GIF of the same frames, which takes the same time.
 * @param {string} svg @param {Kernel} kernel @param {ExportProgress} onProgress
 */
export async function gifOfSvg(svg, kernel, onProgress) {
  const { frames, seconds, frame } = framesOfSvg(svg);
  const { canvas, draw } = canvasOfSvg(svg, () => GIF_WIDTH);
  const most = Math.min(MAX_FRAMES, Math.floor((100 * seconds) / LEAST_DELAY));
  const stride = Math.ceil(frames / Math.max(1, most));
  const count = Math.ceil(frames / stride);
  // When frames begin, in hundredths of a second, so that their rounding does not add up.
  const begin = (/** @type {number} */ k) =>
    Math.round((100 * seconds * Math.min(k * stride, frames)) / frames);
  const worker = new KernelWorker(kernel.module);
  try {
    const { picture } = await worker.call({
      method: "open_picture",
      width: canvas.width,
      height: canvas.height,
    });
    // The next frame is drawn while one is added.
    let added = Promise.resolve();
    for (let k = 0; k < count; k += 1) {
      const pixels = Float64Array.from(new Uint32Array(await draw(frame(k * stride))));
      await added;
      added = worker.call({ method: "add_frame", picture, pixels, delay: begin(k + 1) - begin(k) });
      onProgress(k + 1, count);
    }
    await added;
    const { bytes } = await worker.call({ method: "close_picture", picture });
    return Uint8Array.from(bytes);
  } finally {
    worker.end();
  }
}

/** The number of frames of an animated SVG, which take some seconds, and each as the text of an SVG without motion. */
function framesOfSvg(/** @type {string} */ svg) {
  // The policy of this page has no attributes of style, also where a document is only read.
  const page = new DOMParser().parseFromString(svg.replace(" style=", " data-style="), "image/svg+xml");
  const animations = Array.from(page.querySelectorAll("animate"), (animate) => {
    const [name, values, duration] = ["attributeName", "values", "dur"].map(
      (word) => animate.getAttribute(word) ?? "",
    );
    return { animate, element: animate.parentElement, name, values: values.split(";"), duration };
  });
  for (const { animate } of animations) animate.remove();
  const frame = (/** @type {number} */ k) => {
    for (const { element, name, values } of animations) element?.setAttribute(name, values[k]);
    return new XMLSerializer().serializeToString(page).replace(" data-style=", " style=");
  };
  // The last state is the first of the next turn.
  const frames = Math.max(1, ...animations.map(({ values }) => values.length - 1));
  return { frames, seconds: parseFloat(animations[0]?.duration ?? "1"), frame };
}
