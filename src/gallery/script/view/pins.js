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
    this.set(this.has(name) ? this.names.filter((known) => known !== name) : [...this.names, name]);
  }

  /** Replaces all of them. */
  set(names) {
    this.names = [...new Set(names)];
    this.listeners.forEach((listener) => listener(this.names));
  }

  /** Calls `listener` with the names whenever they change, until the function it returns is called. */
  watch(listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}

/**
 * The pins of a window: a tab keeps them for its page when that is loaded again, where the browser lets a
 * page from disk.
 */
export function tabPins(window) {
  const pins = new Pins();
  const key = `coupler-atlas-pins ${window.location.pathname}`;
  try {
    const kept = JSON.parse(window.sessionStorage.getItem(key) ?? "[]");
    pins.set(kept.filter((name) => typeof name === "string"));
  } catch {
    // What was not kept is pinned again by hand.
  }
  pins.watch((names) => {
    try {
      window.sessionStorage.setItem(key, JSON.stringify(names));
    } catch {
      // Then pins last as long as the page.
    }
  });
  return pins;
}
