// The pinned curves, which are compared and exported together.

/** The names of pinned curves, "family:cell.trace.circuit", in the order in which they were pinned. */
export class Pins {
  constructor() {
    this.names = [];
    this.listeners = new Set();
  }

  has(name) {
    return this.names.includes(name);
  }

  /** Pins a curve, or unpins it if it is pinned. */
  toggle(name) {
    this.set(this.has(name) ? this.names.filter((known) => known !== name) : [...this.names, name]);
  }

  /** Replaces all pins. */
  set(names) {
    this.names = [...new Set(names)];
    this.listeners.forEach((listener) => listener(this.names));
  }

  /** Calls `listener` with the names whenever they change; returns a function that stops it. */
  watch(listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}

/** The pins of a browser tab. They survive a reload if the browser allows storage for pages on disk. */
export function tabPins(window) {
  const pins = new Pins();
  const key = `coupler-atlas-pins ${window.location.pathname}`;
  try {
    const stored = JSON.parse(window.sessionStorage.getItem(key) ?? "[]");
    pins.set(stored.filter((name) => typeof name === "string"));
  } catch {
    // Unreadable pins are dropped.
  }
  pins.watch((names) => {
    try {
      window.sessionStorage.setItem(key, JSON.stringify(names));
    } catch {
      // Without storage, pins last until the page is closed.
    }
  });
  return pins;
}
