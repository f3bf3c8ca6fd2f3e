// The theme: system, light or dark, remembered between visits if the browser allows storage.

import { buttonOf, selectOf } from "./dom.js";

const THEME_KEY = "coupler-atlas-theme";
const PAGES_KEY = "coupler-atlas-pages";

const THEMES = ["system", "light", "dark"];

/** The theme selector, which takes effect immediately. `data-theme` of <html> is the effective theme, light or dark. */
export function themeSelect() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const stored = storedChoice(THEME_KEY) ?? "";
  let choice = THEMES.includes(stored) ? stored : "system";
  const apply = () => {
    document.documentElement.dataset.theme = choice === "system" ? (dark.matches ? "dark" : "light") : choice;
  };
  dark.addEventListener("change", apply);
  apply();
  const onchange = (/** @type {Heard<Event, HTMLSelectElement>} */ { target }) => {
    choice = target.value;
    storeChoice(THEME_KEY, choice);
    apply();
  };
  const labels = THEMES.map((theme) => [theme, `Theme: ${theme}`]);
  return selectOf({ class: "theme quiet", "aria-label": "Theme", onchange }, labels, choice);
}

/** A switch for the dark theme: pages with their printed colours, or inverted. `data-pages` of <html> is "printed" or absent. */
export function printedColorsButton() {
  const root = document.documentElement;
  const apply = (/** @type {boolean} */ isPrinted) => {
    if (isPrinted) root.dataset.pages = "printed";
    else delete root.dataset.pages;
    button.setAttribute("aria-pressed", String(isPrinted));
  };
  const act = () => {
    apply(root.dataset.pages !== "printed");
    storeChoice(PAGES_KEY, root.dataset.pages ?? "turned");
  };
  const button = buttonOf("Printed colours", act, { class: "as-printed" });
  apply(storedChoice(PAGES_KEY) === "printed");
  return button;
}

/** What is stored; null if there is nothing, or no storage. @returns {string | null} */
export function storedChoice(/** @type {string} */ name) {
  try {
    return window.localStorage.getItem(name);
  } catch {
    return null;
  }
}

/** Without storage, a choice lasts until the page is closed. */
export function storeChoice(/** @type {string} */ name, /** @type {string} */ value) {
  try {
    window.localStorage.setItem(name, value);
  } catch {
    // Nothing can be done about it.
  }
}
