// What stands below every room: what made the atlas, its book, and how much there is of it.

import { h } from "./dom.js";

/** The foot of the gallery. */
export function footer(atlas) {
  const sum = (of) => atlas.families.reduce((total, family) => total + of(family), 0);
  const facts = [
    counted(atlas.families.length, "family", "families"),
    counted(
      sum((family) => family.pages),
      "page",
      "pages",
    ),
    counted(
      sum((family) => family.curves),
      "curve",
      "curves",
    ),
    `${sizeInWords(sum((family) => family.bytes))} of data, read by family`,
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

/** "1 page", "7,800 curves". */
export function counted(number, one, many) {
  return `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
}

/** Bytes in the unit that suits them, of a thousand: "380 kB", "6.4 MB". */
export function sizeInWords(bytes) {
  if (bytes < 1e6) return `${Math.round(bytes / 1000)} kB`;
  return `${(bytes / 1e6).toFixed(1)} MB`;
}
