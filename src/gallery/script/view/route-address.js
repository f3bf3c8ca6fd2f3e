// The addresses of rooms that have a word of their own, where a family may be called by the same word.

import { address } from "../data/address.js";

/**
 * Whether a place is in the room of a word, `#/find?…`: a family that is called so has what is below it, and
 * the word itself where a query says nothing that is not of the family's sheet.
 */
export function matchesRoute(word, { path, query }, { atlas }) {
  if (path.length !== 1 || path[0] !== word) return false;
  return !isFamily(atlas, word) || !isFamilyQuery(query);
}

/** The address of the room of a word with a query, which is never empty where a family is called so. */
export function routeAddress(word, query, { atlas }) {
  const short = address([word], query);
  const isTaken = !short.includes("?") && isFamily(atlas, word);
  return isTaken ? address([word], { show: "room" }) : short;
}

function isFamily({ families }, word) {
  return families.some(({ id }) => id === word);
}

function isFamilyQuery(query) {
  return query.size === 0 || query.has("page") || query.has("curve") || query.get("show") === "curves";
}
