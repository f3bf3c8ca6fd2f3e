// The pinned curves, which are compared and taken away together.

/** A board of pins: names of curves, "family:cell.trace.circuit", in the order in which they were pinned. */
export class Pins {
  constructor() {
    this.names = [];
    this.listeners = new Set();
  }

  has(name) {
    return this.names.includes(name);
  }

  /** Pins a curve that is not pinned, and takes down one that is. */
  toggle(name) {
    this.put(this.has(name) ? this.names.filter((known) => known !== name) : [...this.names, name]);
  }

  /** Replaces all of them. */
  put(names) {
    this.names = [...new Set(names)];
    this.listeners.forEach((listener) => listener(this.names));
  }

  /** Calls `listener` with the names whenever they change, until the function it returns is called. */
  watch(listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}
