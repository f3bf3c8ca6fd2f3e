// Runs long computations in slices without blocking the page.

// The length of a slice, in milliseconds.
const SLICE_MS = 12;

/**
 * Runs a generator to its end in slices and returns its value; null as soon as `stopped()` is true. The page
 * handles input between slices.
 */
export async function runInSlices(generator, stopped = () => false) {
  const channel = new MessageChannel();
  const turn = () =>
    new Promise((resume) => {
      channel.port1.onmessage = resume;
      channel.port2.postMessage(null);
    });
  try {
    for (;;) {
      const until = performance.now() + SLICE_MS;
      do {
        const { value, done } = generator.next();
        if (done) return value;
      } while (performance.now() < until);
      await turn();
      if (stopped()) return null;
    }
  } finally {
    channel.port1.close();
  }
}
