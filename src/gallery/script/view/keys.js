// Commands by keys: one table each of what handles them and what the dialog of all keys lists; and the gestures that can be undone.

import { h, isShortcut, openDialog, termList } from "./dom.js";

// A step of a handle by a key, in pixels, and with Shift.
const SHORT_STEP = 2;
const LONG_STEP = 20;

/** The commands of elements, which say in `data-keys` where the keys work. @type {WeakMap<Element, KeyCommand[]>} */
const commandsOf = new WeakMap();

/**
 * Handles keys on an element, or on `target`, and lists them while the element is in the document. The function of a command is
 * false if the key was not for it; without one, something else handles the keys. The signal ends it.
 * @param {Element} element @param {string} where @param {KeyCommand[]} commands @param {Element | Window} target @param {AbortSignal} [signal]
 */
export function onKeys(element, where, commands, target = element, signal = undefined) {
  element.setAttribute("data-keys", where);
  commandsOf.set(element, [...(commandsOf.get(element) ?? []), ...commands]);
  const listener = (/** @type {Event} */ event) => {
    if (!(event instanceof KeyboardEvent) || event.defaultPrevented) return;
    if (isShortcut(event) || isTyped(event.target)) return;
    const key = event.key === " " ? "Space" : event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = commands.find(([keys]) => keys.split(" ").includes(key))?.[2];
    if (act && act(event) !== false) event.preventDefault();
  };
  target.addEventListener("keydown", listener, { signal });
}

/** The steps of a slider by a key, `page` of them by Page Up; undefined for other keys. @returns {number | undefined} */
export function stepsOfKey(/** @type {KeyboardEvent} */ { key }, /** @type {number} */ page) {
  return { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -page, PageUp: page }[key];
}

/** @type {Record<string, Point>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The direction of an arrow key, [right, up]; undefined for other keys. @returns {Point | undefined} */
export function directionOfKey(/** @type {KeyboardEvent} */ { key }) {
  return ARROWS[key];
}

/** Gives the focus to one of some elements, counted round; Tab comes back to that which had it last. @param {(HTMLElement | SVGElement)[]} all @param {number} number */
export function focusOne(all, number) {
  const one = all.at(number % all.length);
  for (const other of all) other.setAttribute("tabindex", other === one ? "0" : "-1");
  one?.focus({ preventScroll: true });
}

/**
 * Handles a key at one of the handles of a drawing: an arrow moves it, by pixels [right, up], Page Up and Page Down go to another one.
 * @param {KeyboardEvent} event @param {(HTMLElement | SVGElement)[]} all @param {number} at @param {(by: Point) => void} move
 */
export function handleKey(event, all, at, move) {
  const way = directionOfKey(event);
  const next = { PageDown: 1, PageUp: -1 }[event.key];
  if ((!way && !next) || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  event.stopPropagation();
  const step = event.shiftKey ? LONG_STEP : SHORT_STEP;
  if (way) move([step * way[0], step * way[1]]);
  else focusOne(all, at + (next ?? 0));
}

/** Whether keys at an element are text, or a choice of its own. */
export function isTyped(/** @type {EventTarget | null} */ target, others = ", select") {
  const fields = `input:not([type=range], [type=checkbox], [type=radio]), textarea${others}`;
  return target instanceof Element && target.matches(fields);
}

/** @type {Record<string, string>} */
const KEY_NAMES = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };

/** Opens the dialog of the keys that work in the document, and more, by where they work. @param {KeyCommand[]} more */
export function showKeys(more) {
  /** @type {Map<string | null, KeyCommand[]>} */ const groups = new Map();
  for (const element of document.querySelectorAll("[data-keys]")) {
    const where = element.getAttribute("data-keys");
    groups.set(where, [...(groups.get(where) ?? []), ...(commandsOf.get(element) ?? [])]);
  }
  [...groups.values()].at(-1)?.push(...more);
  const name = (/** @type {string} */ key) => h("kbd", KEY_NAMES[key] ?? key.replace(/^Page/, "Page "));
  const row = (/** @type {KeyCommand} */ [keys, words]) => [
    keys.split(" ").map((key) => [name(key), " "]),
    words,
  ];
  const lists = [...groups].map(([where, all]) => [h("h3", where), termList("dl.facts", all.map(row))]);
  const title = h("h2", { id: "keys-title" }, "Keys");
  openDialog("keys", { "aria-labelledby": title.id }, title, lists);
}

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
