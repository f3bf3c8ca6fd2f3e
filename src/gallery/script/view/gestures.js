// The gestures that can be undone, as a stack of addresses.

import { isTyped } from "./keys.js";

/** The addresses of a view before each gesture, and after each that was undone. */
export class Gestures {
  /** @type {string[]} */ past = [];
  /** @type {string[]} */ future = [];

  /** Records a gesture that began at an address. */
  record(/** @type {string} */ before) {
    this.past.push(before);
    this.future = [];
  }

  /** The address before the last gesture; undefined if there is none. */
  undo(/** @type {string} */ now) {
    const before = this.past.pop();
    if (before !== undefined) this.future.push(now);
    return before;
  }

  /** The address after the gesture that was undone last; undefined if there is none. */
  redo(/** @type {string} */ now) {
    const after = this.future.pop();
    if (after !== undefined) this.past.push(now);
    return after;
  }
}

/** Whether a key event undoes (-1) or repeats (1) a gesture; 0 if neither, or where text is typed, which the browser undoes. */
export function gestureOfKey(/** @type {KeyboardEvent} */ event) {
  const { ctrlKey, metaKey, altKey, shiftKey, target } = event;
  const key = event.key.toLowerCase();
  if (!(ctrlKey || metaKey) || altKey || (key !== "z" && key !== "y")) return 0;
  if (isTyped(target, "")) return 0;
  if (key === "y") return shiftKey ? 0 : 1;
  return shiftKey ? 1 : -1;
}
