// Commands by keys: one table each of what handles them and what the dialog of all keys lists.

import { buttonOf, h, isShortcut, termList } from "./dom.js";

/** The commands of elements, which say in `data-keys` where the keys work. @type {WeakMap<Element, KeyCommand[]>} */
const commandsOf = new WeakMap();

/**
 * Handles keys on an element, or on `target`, and lists them while the element is in the document. The function of a command is
 * false if the key was not for it; without one, something else handles the keys. Returns a function that ends it.
 * @param {Element} element @param {string} where @param {KeyCommand[]} commands @param {Element | Window} target
 */
export function onKeys(element, where, commands, target = element) {
  element.setAttribute("data-keys", where);
  commandsOf.set(element, [...(commandsOf.get(element) ?? []), ...commands]);
  const listener = (/** @type {Event} */ event) => {
    if (
      !(event instanceof KeyboardEvent) ||
      event.defaultPrevented ||
      isShortcut(event) ||
      isTyped(event.target)
    )
      return;
    const key = event.key === " " ? "Space" : event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = commands.find(([keys]) => keys.split(" ").includes(key))?.[2];
    if (act && act(event) !== false) event.preventDefault();
  };
  target.addEventListener("keydown", listener);
  return () => target.removeEventListener("keydown", listener);
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

/** Whether keys at an element are text or a choice of its own. */
function isTyped(/** @type {EventTarget | null} */ target) {
  return (
    target instanceof Element &&
    target.matches("input:not([type=range], [type=checkbox], [type=radio]), select, textarea")
  );
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
  const dialog = h("dialog.keys", { "aria-labelledby": title.id }, title, lists);
  dialog.append(buttonOf("Close", () => dialog.close()));
  dialog.onclose = () => dialog.remove();
  // Keys of the view do not apply while it is open.
  dialog.onkeydown = (event) => event.stopPropagation();
  document.body.append(dialog);
  dialog.showModal();
}
