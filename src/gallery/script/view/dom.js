// Elements, made from words and never from markup: whatever a title says is shown as text.

const SVG = "http://www.w3.org/2000/svg";

/**
 * An HTML element: `h("button", { class: "quiet", type: "button", onclick: f, "aria-label": "Next" }, "→")`.
 *
 * Attributes that are null, undefined or false are left out, true ones are empty; functions are listeners, by
 * the name of their event after "on". Children may be nodes, texts, numbers, arrays, or nothing.
 */
export function h(name, attributes = {}, ...children) {
  return buildElement(document.createElement(name), attributes, children);
}

/** An SVG element, likewise. */
export function s(name, attributes = {}, ...children) {
  return buildElement(document.createElementNS(SVG, name), attributes, children);
}

function buildElement(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  const some = children
    .flat(Infinity)
    .filter((child) => child !== null && child !== undefined && child !== false);
  element.append(...some.map((child) => (child instanceof Node ? child : String(child))));
  return element;
}

/** Replaces what is in an element. */
export function fill(element, ...children) {
  const some = children
    .flat(Infinity)
    .filter((child) => child !== null && child !== undefined && child !== false);
  element.replaceChildren(...some.map((child) => (child instanceof Node ? child : String(child))));
  return element;
}
