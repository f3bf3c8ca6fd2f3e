// Creates DOM elements from values, never from markup: text in a title is always shown as text.

const SVG = "http://www.w3.org/2000/svg";

/**
 * Creates an HTML element: `h("button", { class: "quiet", type: "button", onclick: f, "aria-label": "Next" },
 * "→")`.
 *
 * Attributes that are null, undefined or false are omitted; true gives an empty attribute; a function is a
 * listener for the event named after "on". Children may be nodes, strings, numbers, arrays, or nothing.
 */
export function h(name, attributes = {}, ...children) {
  return buildElement(document.createElement(name), attributes, children);
}

/** Creates an SVG element in the same way. */
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

/** Replaces the content of an element. */
export function fill(element, ...children) {
  const some = children
    .flat(Infinity)
    .filter((child) => child !== null && child !== undefined && child !== false);
  element.replaceChildren(...some.map((child) => (child instanceof Node ? child : String(child))));
  return element;
}
