// Numbers as the program packs them: the bytes of a typed array, least first, in base64.

const ARRAYS = { f64: Float64Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array };

/** The typed array that `{ type, data }` stands for. */
export function unpacked({ type, data }) {
  const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  return new ARRAYS[type](bytes.buffer);
}

/** Typed arrays of one kind in one, one after another. */
export function concatenated(arrays) {
  const whole = new arrays[0].constructor(arrays.reduce((sum, array) => sum + array.length, 0));
  let at = 0;
  for (const array of arrays) {
    whole.set(array, at);
    at += array.length;
  }
  return whole;
}
