// Rasterizes a plate with the browser.

import { svgOfCurve, PLATE_SIZE } from "./svg.js";

/** The resolution of PNG plates, in pixels per inch. */
const PLATE_DPI = 300;

/** An exported curve as the bytes of a PNG image. */
export async function pngOfCurve(exported) {
  const image = new Image();
  // A data URL does not taint the canvas.
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOfCurve(exported))}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round((PLATE_SIZE.width / 25.4) * PLATE_DPI);
  canvas.height = Math.round((PLATE_SIZE.height / 25.4) * PLATE_DPI);
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  const blob = await new Promise((done) => {
    canvas.toBlob(done, "image/png");
  });
  if (!blob) throw new Error("the browser cannot create an image of this size");
  return new Uint8Array(await blob.arrayBuffer());
}
