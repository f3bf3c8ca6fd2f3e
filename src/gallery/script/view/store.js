// The state of a view: its address says all of it, so that a change is a new address, and undoing it the one before.

/** The state of a view. Listeners show it; a gesture changes it, and its address at the end of the gesture. @template {object} S */
export class Store {
  /** @type {Set<(state: S, before: S | null) => void>} */ listeners = new Set();
  writing = 0;
  /** Whether a gesture has not ended. */ isOpen = false;

  /** `address` gives the address of a state. @param {Pick<App, "commit" | "replace">} app @param {S} state @param {(state: S) => string} address */
  constructor(app, state, address) {
    this.app = app;
    this.state = state;
    this.address = address;
  }

  /** Calls `listener` with the state, and after each change with the new state and the one before. */
  watch(/** @type {(state: S, before: S | null) => void} */ listener) {
    this.listeners.add(listener);
    listener(this.state, null);
  }

  /** Changes a part of the state; the address stays until the end of the gesture, `commit()`. @param {Partial<S>} changes */
  preview(changes) {
    this.isOpen = true;
    this.#set(Object.assign({}, this.state, changes));
  }

  /** Changes a part of the state, as a gesture of its own. @param {Partial<S>} changes */
  change(changes) {
    this.preview(changes);
    this.commit();
  }

  /** Shows the state of another address, which is written already. */
  show(/** @type {S} */ state) {
    this.leave();
    this.#set(state);
  }

  /** Changes what is no gesture, and is not undone. @param {Partial<S>} changes */
  note(changes) {
    this.#set(Object.assign({}, this.state, changes));
    if (!this.isOpen) this.app.replace(this.address(this.state));
  }

  #set(/** @type {S} */ state) {
    const before = this.state;
    this.state = state;
    this.listeners.forEach((listener) => listener(state, before));
  }

  /** Ends a gesture. */
  commit() {
    if (!this.isOpen) return;
    this.leave();
    this.app.commit(this.address(this.state));
  }

  /** Ends a gesture when nothing has followed for a time in milliseconds. */
  commitSoon(/** @type {number} */ after) {
    window.clearTimeout(this.writing);
    this.writing = window.setTimeout(() => this.commit(), after);
  }

  /** Ends a gesture without its address, as when the view is left. */
  leave() {
    window.clearTimeout(this.writing);
    this.isOpen = false;
  }
}
