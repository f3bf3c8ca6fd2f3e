// Creates DOM elements from values, never from markup: text in a title is always shown as text.

const SVG = "http://www.w3.org/2000/svg";

/**
 * Creates an HTML element, perhaps with classes: `h("button.quiet", { onclick: f }, "→")`, `h("p.note", "…")`. Attributes are those of
 * setAttributes; children may be nodes, strings, numbers, arrays, or nothing.
 * @template {string} N @param {N} name @param {...(Content | Attributes<HtmlElementOf<N>>)} content @returns {HtmlElementOf<N>}
 */
export function h(name, ...content) {
  return /** @type {HtmlElementOf<N>} */ (buildElement((tag) => document.createElement(tag), name, content));
}

/**
 * Creates an SVG element in the same way.
 * @template {string} N @param {N} name @param {...(Content | Attributes<SvgElementOf<N>>)} content @returns {SvgElementOf<N>}
 */
export function s(name, ...content) {
  const created = buildElement((tag) => document.createElementNS(SVG, tag), name, content);
  return /** @type {SvgElementOf<N>} */ (created);
}

/** @param {(tag: string) => Element} create @param {string} name @param {unknown[]} content */
function buildElement(create, name, content) {
  const [tag, ...classes] = name.split(".");
  const element = create(tag);
  if (classes.length) element.setAttribute("class", classes.join(" "));
  const [attributes, ...children] = content;
  if (attributes?.constructor !== Object) return fill(element, content);
  setAttributes(element, /** @type {Record<string, unknown>} */ (attributes));
  return fill(element, children);
}

/**
 * Sets attributes from an object: those that are null, undefined or false are removed; true gives an empty
 * attribute; a function is a listener for the event named after "on".
 * @param {Element} element @param {Record<string, unknown>} attributes
 */
export function setAttributes(element, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function")
      element.addEventListener(key.slice(2), /** @type {EventListener} */ (value));
    else if (value === null || value === undefined || value === false) element.removeAttribute(key);
    else element.setAttribute(key, value === true ? "" : String(value));
  }
}

/** Replaces the content of an element. @template {Element} E @param {E} element @param {...unknown} children */
export function fill(element, ...children) {
  const all = children.flat(Infinity);
  const some = all.filter((child) => child !== null && child !== undefined && child !== false);
  element.replaceChildren(...some.map((child) => (child instanceof Node ? child : String(child))));
  return element;
}

/** The first element in another one that matches a selector, which there must be. @returns {HTMLElement} */
export function elementIn(/** @type {ParentNode} */ parent, /** @type {string} */ selector) {
  const found = parent.querySelector(selector);
  if (!(found instanceof HTMLElement)) throw new Error(`there is no ${selector}`);
  return found;
}

/** An SVG drawing that screen readers skip, because adjacent text describes it. @param {string} name @param {Size} size @param {...Content} content */
export function thumbnailFrame(name, size, ...content) {
  const { width, height } = size;
  const attributes = { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true", focusable: "false" };
  return s(`svg.thumbnail${name}`, attributes, ...content);
}

/** The same of a size in pixels. @param {string} name @param {Size} size @param {...Content} content */
export function sizedThumbnail(name, size, ...content) {
  const frame = thumbnailFrame(name, size, ...content);
  setAttributes(frame, size);
  return frame;
}

/** A button. @param {Content} label @param {(event: MouseEvent) => unknown} onclick @param {Attributes<HTMLButtonElement>} attributes */
export function buttonOf(label, onclick, attributes = {}) {
  return h("button", { onclick, ...attributes }, label);
}

/**
 * A checkbox or a radio button with its label: { input, element }.
 * @param {"checkbox" | "radio"} type @param {Attributes<HTMLInputElement>} attributes @param {...Content} label
 */
export function choiceBox(type, attributes, ...label) {
  const input = h("input", { type, ...attributes });
  return { input, element: h("label.check", input, ...label) };
}

/**
 * A select element with options [[value, label], …].
 * @param {Attributes<HTMLSelectElement>} attributes @param {Iterable<(string | number)[]>} options @param {string | number | null} chosen
 */
export function selectOf(attributes, options, chosen) {
  const list = [...options].map(([value, label]) =>
    h("option", { value, selected: value === chosen }, label),
  );
  return h("select", attributes, list);
}

/** A list of terms with their descriptions, [[term, description], …]. @param {string} name @param {Iterable<Content[]>} rows */
export function termList(name, rows) {
  const terms = Array.from(rows, ([term, text]) => [h("dt", term), h("dd", text)]);
  return h(name, terms);
}

/**
 * A table with a caption for screen readers, its headings as cells, and its body.
 * @param {string} name @param {string} caption @param {Content} headings @param {...Content} body
 */
export function figures(name, caption, headings, ...body) {
  const head = h("thead", h("tr", headings));
  return h(`table.figures${name}`, h("caption.visually-hidden", caption), head, ...body);
}

/** A modal dialog, which is open until it is closed; then the browser gives the focus back. @param {string} name @param {object} attributes @param {...Content} content */
export function openDialog(name, attributes, ...content) {
  const close = h("form", { method: "dialog" }, h("button", "Close"));
  /** @type {HTMLDialogElement} */ const dialog = h(
    "dialog",
    { class: name, ...attributes },
    ...content,
    close,
  );
  dialog.onclose = () => dialog.remove();
  // Keys of the view do not apply while it is open.
  dialog.onkeydown = (event) => event.stopPropagation();
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

/** Whether a key is pressed with another one that makes it a command of the browser. */
export function isShortcut(/** @type {KeyboardEvent} */ { ctrlKey, metaKey, altKey }) {
  return ctrlKey || metaKey || altKey;
}

/** Resolves in the next turn of the event loop: the page handles input before. */
export function nextTurn() {
  return new Promise((resume) => setTimeout(resume));
}

/** The element that has the focus. */
export function focusedElement() {
  const element = document.activeElement;
  return element instanceof HTMLElement || element instanceof SVGElement ? element : null;
}

/** Returns a function that restores the focus to the control with the same name after an element's content has been replaced. */
export function keepFocus(/** @type {Element} */ element) {
  const nameOf = (/** @type {Element} */ control) =>
    control.id || control.getAttribute("aria-label") || control.textContent;
  const { activeElement: active } = document;
  const focused = active && element.contains(active) ? nameOf(active) : null;
  return () => {
    if (focused === null || element.contains(document.activeElement)) return;
    const found = element.querySelectorAll("button, select, a, input, [role=slider]");
    const controls = /** @type {HTMLInputElement[]} */ ([...found]);
    (controls.find((one) => nameOf(one) === focused && !one.disabled) ?? controls[0])?.focus();
  };
}
