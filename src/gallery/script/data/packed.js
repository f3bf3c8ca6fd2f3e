// Typed arrays as the program encodes them: their bytes, little-endian, in base64.

const ARRAYS = { f64: Float64Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array };

/** Decodes `{ type, data }` into a typed array. */
export function unpackArray({ type, data }) {
  return new ARRAYS[type](decodeBase64(data).buffer);
}

/**
 * Uses the browser's own decoder if there is one: it takes a tenth of the time, and an atlas has megabytes.
 */
function decodeBase64(data) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(data);
  const text = atob(data);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; k += 1) bytes[k] = text.charCodeAt(k);
  return bytes;
}

/** Concatenates typed arrays of one kind. */
export function concatenateArrays(arrays) {
  const whole = new arrays[0].constructor(arrays.reduce((sum, array) => sum + array.length, 0));
  let at = 0;
  for (const array of arrays) {
    whole.set(array, at);
    at += array.length;
  }
  return whole;
}
