// Addresses of routes with a reserved word, which may also be the id of a family.

import { address } from "../data/address.js";

/**
 * Whether an address matches the route of a word, `#/find?…`. A family with that id keeps the addresses below
 * it, and the word itself if the query has only names of the family's view.
 */
export function matchesRoute(word, { path, query }, { atlas }) {
  if (path.length !== 1 || path[0] !== word) return false;
  return !isFamily(atlas, word) || !isFamilyQuery(query);
}

/** The address of a route with a query, which is never empty if a family has the same id. */
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
