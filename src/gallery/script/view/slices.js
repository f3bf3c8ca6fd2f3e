// Long work in slices, so that the page handles input meanwhile.

// The length of a slice, in milliseconds; a step of the work that begins at its end takes as long at most.
const SLICE_MS = 4;

/** The slices of some work: `if (!(await slices.goOn())) return;` between its steps. */
export class Slices {
  until = performance.now() + SLICE_MS;

  /** @param {() => boolean} stopped whether the work is not needed any more */
  constructor(stopped) {
    this.stopped = stopped;
  }

  /** Lets the page handle input if the slice is over; whether to go on. */
  async goOn() {
    if (performance.now() < this.until) return true;
    await nextTurn();
    this.until = performance.now() + SLICE_MS;
    return !this.stopped();
  }
}

/** Resolves in a later turn of the page's loop of events, without the pauses of timers. */
function nextTurn() {
  const { port1, port2 } = new MessageChannel();
  return new Promise((resume) => {
    port1.onmessage = () => {
      port1.close();
      resume(null);
    };
    port2.postMessage(null);
  });
}
