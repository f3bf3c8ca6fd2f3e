// The theme: as the system has it, light, or dark; remembered from one visit to the next where the browser
// lets a page.

import { h } from "./dom.js";

const THEME_KEY = "coupler-atlas-theme";
const PAGES_KEY = "coupler-atlas-pages";

const THEME_CHOICES = [
  ["system", "Theme: system"],
  ["light", "Theme: light"],
  ["dark", "Theme: dark"],
];

/**
 * The choice of the theme, which takes effect at once. `data-theme` of <html> is always the one in effect,
 * light or dark; "themechange" is dispatched on document when it changes.
 */
export function themeSelect() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  let wish = storedTheme();
  const apply = () => {
    const theme = wish === "system" ? (dark.matches ? "dark" : "light") : wish;
    if (document.documentElement.dataset.theme === theme) return;
    document.documentElement.dataset.theme = theme;
    document.dispatchEvent(new CustomEvent("themechange", { detail: theme }));
  };
  dark.addEventListener("change", apply);
  apply();
  const choose = (event) => {
    wish = event.target.value;
    storeChoice(THEME_KEY, wish);
    apply();
  };
  const options = THEME_CHOICES.map(([value, label]) =>
    h("option", { value, selected: value === wish }, label),
  );
  return h("select", { class: "theme quiet", "aria-label": "Theme", onchange: choose }, options);
}

/**
 * A switch, of use in the dark alone: pages as they were printed, or turned to light ink on dark paper.
 * `data-pages` of <html> is "printed" or absent.
 */
export function printedColorsButton() {
  const root = document.documentElement;
  const apply = (isPrinted) => {
    if (isPrinted) root.dataset.pages = "printed";
    else delete root.dataset.pages;
    button.setAttribute("aria-pressed", String(isPrinted));
  };
  const act = () => {
    apply(root.dataset.pages !== "printed");
    storeChoice(PAGES_KEY, root.dataset.pages ?? "turned");
  };
  const button = h("button", { type: "button", class: "as-printed", onclick: act }, "As printed");
  apply(storedChoice(PAGES_KEY) === "printed");
  return button;
}

function storedTheme() {
  const theme = storedChoice(THEME_KEY);
  return THEME_CHOICES.some(([value]) => value === theme) ? theme : "system";
}

function storedChoice(name) {
  try {
    return window.localStorage.getItem(name);
  } catch {
    return null;
  }
}

/** Where the browser keeps nothing for pages from disk, a choice lasts as long as the page. */
function storeChoice(name, value) {
  try {
    window.localStorage.setItem(name, value);
  } catch {
    // There is nothing to be done about it, and nothing lost but a convenience.
  }
}
