// A plate as an image, drawn by the browser.

import { svgOfCurve, PLATE_SIZE } from "./svg.js";

/** The resolution of plates as images, in pixels to the inch. */
const PLATE_DPI = 300;

/** A exported curve as the bytes of a PNG image, in a while. */
export async function pngOfCurve(exported) {
  const image = new Image();
  // The picture is the page's own as data, which no canvas holds against it.
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOfCurve(exported))}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round((PLATE_SIZE.width / 25.4) * PLATE_DPI);
  canvas.height = Math.round((PLATE_SIZE.height / 25.4) * PLATE_DPI);
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  const blob = await new Promise((done) => {
    canvas.toBlob(done, "image/png");
  });
  if (!blob) throw new Error("the browser cannot make an image of this size");
  return new Uint8Array(await blob.arrayBuffer());
}
