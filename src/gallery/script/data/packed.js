// Columns of numbers as the program encodes them: a single number if all are equal, null if all are missing,
// otherwise the bytes of a typed array, little-endian, in base64; as the kernel returns them, an array.

/** Decodes a column of `count` numbers into a typed array of its kind, from index `at` on. @param {number} at @param {number} count */
export function unpackInto(/** @type {TypedArray} */ array, at, count, /** @type {PackedColumn} */ column) {
  if (typeof column === "number" || column === null) array.fill(column ?? NaN, at, at + count);
  else {
    const unpacked = unpackColumn(/** @type {TypedArrayKind} */ (array.constructor), count, column);
    array.set(unpacked, at);
    freeArray(unpacked);
  }
}

/** Frees the memory of an array that is not used again: garbage is collected only when there are a hundred megabytes of them. */
export function freeArray(/** @type {TypedArray} */ { buffer }) {
  if (buffer instanceof ArrayBuffer) buffer.transfer?.(0);
}

/** Has the browser collect its garbage soon, as it does where much is allocated for arrays: it keeps what several searches left otherwise. */
export const requestCollection = () => new ArrayBuffer(64 << 20).transfer?.(0);

/**
 * Decodes a column of `count` numbers into a new array of a kind.
 * @template {TypedArray} T @param {{ new (of: number | ArrayBuffer): T }} kind @param {number} count @param {PackedColumn} column
 */
export function unpackColumn(kind, count, column) {
  if (typeof column === "string") return new kind(decodeBase64(column).buffer);
  const array = new kind(count);
  if (column instanceof Float64Array) array.set(column);
  else array.fill(column ?? NaN);
  return array;
}

/** The bytes in base64 in the comment that a function consists of. */
export function bytesOfComment(/** @type {() => void} */ comment) {
  return decodeBase64(String(comment).slice("()=>{/*".length, -"*/}".length));
}

/** Where the numbers of each curve begin among third differences. @param {Uint8Array} bytes @param {number[]} counts */
export function placesOfCurves(bytes, counts) {
  let at = 0;
  return Uint32Array.from(counts, (count) => {
    const from = at;
    for (let rest = 2 * count; rest > 0; at += 1) if (bytes[at] < 128) rest -= 1;
    return from;
  });
}

let unpackedPoints = new Uint16Array();

/** The points of a curve, x and y in turn from 0 to 65535, of third differences (typed_array.rs), until the next call. @param {Uint8Array} bytes @param {number} at @param {number} count */
export function unpackPoints(bytes, at, count) {
  if (unpackedPoints.length < 2 * count) unpackedPoints = new Uint16Array(4 * count);
  const points = unpackedPoints;
  // Without destructuring: it would make hundreds of megabytes of arrays before the browser compiles this for many curves.
  for (let axis = 0; axis < 2; axis += 1) {
    let a = 0;
    let b = 0;
    let c = 0;
    for (let k = 0; k < count; k += 1) {
      let code = bytes[at] & 127;
      for (let shift = 7; bytes[at++] > 127; shift += 7) code |= (bytes[at] & 127) << shift;
      const value = 3 * (a - b) + c + ((code >> 1) ^ -(code & 1));
      points[2 * k + axis] = value;
      c = k ? b : value;
      b = k ? a : value;
      a = value;
    }
  }
  return points;
}

/** Uses the browser's own decoder if there is one: it takes a tenth of the time, and an atlas has megabytes. @returns {Uint8Array<ArrayBuffer>} */
function decodeBase64(/** @type {string} */ data) {
  if ("fromBase64" in Uint8Array) return /** @type {Base64Decoder} */ (Uint8Array).fromBase64(data);
  const text = atob(data);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; k += 1) bytes[k] = text.charCodeAt(k);
  return bytes;
}

/** Unpacks what gzip packed, which has a checksum, from base64. */
export async function unpackGzip(/** @type {string} */ packed) {
  const unpacked = new Blob([decodeBase64(packed)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(unpacked).arrayBuffer();
}

/** Concatenates typed arrays of one kind. @template {TypedArray} T @param {T[]} arrays @param {new (count: number) => T} kind */
export function concatenateArrays(arrays, kind) {
  if (arrays.length === 1) return arrays[0];
  const whole = new kind(arrays.reduce((sum, array) => sum + array.length, 0));
  let at = 0;
  for (const array of arrays) {
    whole.set(array, at);
    at += array.length;
  }
  return whole;
}
