// The theme: system, light or dark, remembered between visits if the browser allows storage.

import { buttonOf, selectOf } from "./dom.js";

const THEME_KEY = "coupler-atlas-theme";
const PAGES_KEY = "coupler-atlas-pages";

const THEMES = ["system", "light", "dark"];

/**
 * The theme selector, which takes effect immediately. `data-theme` of <html> is the effective theme, light or
 * dark; "themechange" is dispatched on document when it changes.
 */
export function themeSelect() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  let choice = storedTheme();
  const apply = () => {
    const theme = choice === "system" ? (dark.matches ? "dark" : "light") : choice;
    if (document.documentElement.dataset.theme === theme) return;
    document.documentElement.dataset.theme = theme;
    document.dispatchEvent(new CustomEvent("themechange", { detail: theme }));
  };
  dark.addEventListener("change", apply);
  apply();
  const choose = (/** @type {string} */ theme) => {
    choice = theme;
    storeChoice(THEME_KEY, choice);
    apply();
  };
  const onchange = (/** @type {Heard<Event, HTMLSelectElement>} */ { target }) => choose(target.value);
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

function storedTheme() {
  const theme = storedChoice(THEME_KEY) ?? "";
  return THEMES.includes(theme) ? theme : "system";
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
