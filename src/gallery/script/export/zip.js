// Writes a ZIP archive without compression (PKWARE, APPNOTE 6.3, sections 4.3 and 4.4).

import { concatenateArrays } from "../data/packed.js";

/** An archive of files [{ name, bytes }] as bytes. The same files give the same archive. */
export function zipOfFiles(/** @type {{ name: string; bytes: Uint8Array<ArrayBuffer> }[]} */ files) {
  const entries = files.map(({ name, bytes }) => ({
    name: new TextEncoder().encode(name),
    bytes,
    crc: crc32OfBytes(bytes),
  }));
  /** @type {Uint8Array<ArrayBuffer>[]} */ const parts = [];
  const directory = [];
  let offset = 0;
  for (const entry of entries) {
    directory.push(
      zipRecord(0x02014b50, [[2, 20], ...zipFacts(entry), [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]),
      entry.name,
    );
    const head = zipRecord(0x04034b50, zipFacts(entry));
    parts.push(head, entry.name, entry.bytes);
    offset += head.length + entry.name.length + entry.bytes.length;
  }
  const size = directory.reduce((sum, { length }) => sum + length, 0);
  const count = entries.length;
  const counts = [count, count].map((value) => [2, value]);
  const end = zipRecord(0x06054b50, [[2, 0], [2, 0], ...counts, [4, size], [4, offset], [2, 0]]);
  return concatenateArrays([...parts, ...directory, end], Uint8Array);
}

// The fields of both headers of a file: version needed, UTF-8 names, stored, 1 January 1980.
function zipFacts(/** @type {{ name: Uint8Array, bytes: Uint8Array, crc: number }} */ { name, bytes, crc }) {
  const start = [20, 0x0800, 0, 0, 0x21].map((value) => [2, value]);
  return [...start, [4, crc], [4, bytes.length], [4, bytes.length], [2, name.length], [2, 0]];
}

// A signature and fields [bytes, value], little-endian.
function zipRecord(/** @type {number} */ signature, /** @type {number[][]} */ fields) {
  const all = [[4, signature], ...fields];
  const out = new DataView(new ArrayBuffer(all.reduce((sum, [size]) => sum + size, 0)));
  let at = 0;
  for (const [size, value] of all) {
    if (size === 2) out.setUint16(at, value, true);
    else out.setUint32(at, value, true);
    at += size;
  }
  return new Uint8Array(out.buffer);
}

/** The CRC-32 checksum of bytes, as ZIP and PNG define it. */
export function crc32OfBytes(/** @type {Uint8Array} */ bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (crc ^ 0xffffffff) >>> 0;
}
