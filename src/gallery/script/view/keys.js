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
  const listener = (event) => {
    if (event.defaultPrevented || isShortcut(event) || isTyped(event.target)) return;
    const key = event.key === " " ? "Space" : event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = commands.find(([keys]) => keys.split(" ").includes(key))?.[2];
    if (act && act(event) !== false) event.preventDefault();
  };
  target.addEventListener("keydown", listener);
  return () => target.removeEventListener("keydown", listener);
}

/** Whether keys at an element are text or a choice of its own. */
function isTyped(/** @type {EventTarget | null} */ target) {
  return (
    target instanceof Element &&
    target.matches("input:not([type=range], [type=checkbox], [type=radio]), select, textarea")
  );
}

const KEY_NAMES = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };

/** Opens the dialog of the keys that work in the document, and more, by where they work. @param {KeyCommand[]} more */
export function showKeys(more) {
  /** @type {Map<string | null, KeyCommand[]>} */ const groups = new Map();
  for (const element of document.querySelectorAll("[data-keys]")) {
    const where = element.getAttribute("data-keys");
    groups.set(where, [...(groups.get(where) ?? []), ...(commandsOf.get(element) ?? [])]);
  }
  [...groups.values()].at(-1)?.push(...more);
  const name = (key) => h("kbd", KEY_NAMES[key] ?? key.replace(/^Page/, "Page "));
  const row = (/** @type {KeyCommand} */ [keys, words]) => [
    keys.split(" ").map((key) => [name(key), " "]),
    words,
  ];
  const lists = [...groups].map(([where, all]) => [h("h3", where), termList("dl.facts", all.map(row))]);
  const title = h("h2", { id: "keys-title" }, "Keys");
  const close = buttonOf("Close", () => dialog.close());
  // Keys of the view do not apply while it is open.
  const on = { onclose: () => dialog.remove(), onkeydown: (event) => event.stopPropagation() };
  const dialog = h("dialog.keys", { "aria-labelledby": title.id, ...on }, title, lists, close);
  document.body.append(dialog);
  dialog.showModal();
}
