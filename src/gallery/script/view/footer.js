// The footer of the page: the program, the book, and the size of the atlas.

import { h } from "./dom.js";

/** The footer of the gallery. */
export function footer(atlas) {
  const sum = (of) => atlas.families.reduce((total, family) => total + of(family), 0);
  const facts = [
    formatCount(atlas.families.length, "family", "families"),
    formatCount(
      sum((family) => family.pages),
      "page",
      "pages",
    ),
    formatCount(
      sum((family) => family.curves),
      "curve",
      "curves",
    ),
    `${formatBytes(sum((family) => family.bytes))} of data, read by family`,
  ];
  const books = atlas.book.map((file) => h("a", { href: file }, `The book, ${file}`));
  return h(
    "footer",
    { class: "footer" },
    h("p", {}, facts.join(" · ")),
    h(
      "p",
      {},
      books.map((book) => [book, " · "]),
      `Made by ${atlas.program}`,
    ),
  );
}

/** A count with its noun: "1 page", "7,800 curves". */
export function formatCount(number, one, many) {
  return `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
}

/** A number of bytes in decimal units: "380 kB", "6.4 MB". */
export function formatBytes(bytes) {
  if (bytes < 1e6) return `${Math.round(bytes / 1000)} kB`;
  return `${(bytes / 1e6).toFixed(1)} MB`;
}
