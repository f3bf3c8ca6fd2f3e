// Tests that a module of the kernel answers bit for bit as the kernel does in the program, whose transcript it is given: node
// tests/gallery/module.mjs MODULE TRANSCRIPT (crates/coupler-kernel/examples/transcript.rs says what its lines are).

import assert from "node:assert/strict";
import { createReadStream, readFileSync } from "node:fs";
import { createInterface } from "node:readline";

import { KernelInstance } from "../../src/gallery/script/kernel/instance.js";

const [moduleFile, transcript] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(moduleFile));
assert.deepEqual(WebAssembly.Module.imports(module), [], "the page gives the module nothing");

/** The bytes of numbers, in hexadecimal digits; of a NaN, whose sign depends on the processor, those of one and the same. */
function hex(/** @type {Float64Array} */ numbers) {
  // Bits, and not the NaN that the engine keeps, for the engine may keep any.
  const bits = new BigUint64Array(Float64Array.from(numbers).buffer);
  numbers.forEach((number, k) => {
    if (Number.isNaN(number)) bits[k] = 0x7ff8000000000000n;
  });
  return Buffer.from(bits.buffer).toString("hex");
}

function numbersOf(digits) {
  return new Float64Array(Uint8Array.from(Buffer.from(digits, "hex")).buffer);
}

let [calls, numbers] = [0, 0];
/** @type {KernelInstance} */ let kernel;
for await (const line of createInterface({ input: createReadStream(transcript) })) {
  const expected = JSON.parse(line);
  if (expected.new) {
    kernel = new KernelInstance(module);
    continue;
  }
  let found;
  if (expected.pose) found = kernel.pose(...expected.pose);
  else if (expected.joint) found = kernel.jointPosition(...expected.joint);
  else {
    const answer = kernel.exchange(expected.request, [numbersOf(expected.given)]);
    assert.equal(answer.json, expected.json, expected.request);
    found = answer.numbers;
  }
  assert.equal(hex(found), expected.numbers, line.slice(0, 1000));
  calls += 1;
  numbers += found.length;
}
assert.ok(calls > 1000 && numbers > 10000, `${calls} calls, ${numbers} numbers`);
console.log(`the module answers as the kernel: ${calls} calls, ${numbers} numbers`);
