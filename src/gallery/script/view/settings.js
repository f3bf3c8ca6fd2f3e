// The theme: as the system has it, light, or dark; remembered from one visit to the next where the browser
// lets a page.

import { h } from "./dom.js";

const KEPT_THEME = "coupler-atlas-theme";

const THEME_CHOICES = [
  ["system", "Theme: system"],
  ["light", "Theme: light"],
  ["dark", "Theme: dark"],
];

/**
 * The choice of the theme, which takes effect at once. `data-theme` of <html> is always the one in effect,
 * light or dark; "themechange" is dispatched on document when it changes.
 */
export function themeChoice() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  let wish = keptTheme();
  const put = () => {
    const theme = wish === "system" ? (dark.matches ? "dark" : "light") : wish;
    if (document.documentElement.dataset.theme === theme) return;
    document.documentElement.dataset.theme = theme;
    document.dispatchEvent(new CustomEvent("themechange", { detail: theme }));
  };
  dark.addEventListener("change", put);
  put();
  const choose = (event) => {
    wish = event.target.value;
    keepTheme(wish);
    put();
  };
  const options = THEME_CHOICES.map(([value, label]) =>
    h("option", { value, selected: value === wish }, label),
  );
  return h("select", { class: "theme quiet", "aria-label": "Theme", onchange: choose }, options);
}

function keptTheme() {
  try {
    const kept = window.localStorage.getItem(KEPT_THEME);
    return THEME_CHOICES.some(([value]) => value === kept) ? kept : "system";
  } catch {
    return "system";
  }
}

/** Where the browser keeps nothing for pages from disk, the choice lasts as long as the page. */
function keepTheme(theme) {
  try {
    window.localStorage.setItem(KEPT_THEME, theme);
  } catch {
    // There is nothing to be done about it, and nothing lost but a convenience.
  }
}
