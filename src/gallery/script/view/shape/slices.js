// Long work in short slices, so that the page stays awake.

// A slice's time, in milliseconds, before the page has its turn.
const SLICE_MS = 12;

/**
 * Runs a generator to its end in slices and gives its value; null as soon as `stopped()` is true. Between
 * slices whatever has been pressed goes first.
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
