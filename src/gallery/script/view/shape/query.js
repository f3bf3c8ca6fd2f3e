// The state of the search by shape as its address says it: the shape, how it is compared, and what four-bars must be.

import { curveOutline, findCurve, parseCurveKey } from "../../data/family.js";
import { needPieces } from "../../data/needs.js";
import { decodeShape } from "../../shape/outline.js";

const USUAL = { least: 0.15, maxLink: 10 };

/** `d` is a drawn shape with the `place` of its box, `like` the name of a curve; without `part` it is not known. */
export function parseShapeQuery(/** @type {Query} */ query) {
  /** @type {SearchOptions["by"]} */ const by = query.get("by") === "greatest" ? "greatest" : "rms";
  const least = Number(query.get("least"));
  const link = query.get("max-link");
  const maxLink = link === "inf" ? Infinity : Number(link);
  const mu = Number(query.get("mu"));
  return {
    d: query.get("d") ?? null,
    place: numbersOf(query.get("at"), 3),
    like: query.get("like") ?? null,
    part: query.has("part") ? query.get("part") !== "no" : null,
    least: least > 0 && least <= 1 ? least : USUAL.least,
    mirror: query.get("mirror") !== "no",
    by,
    families: query.get("family")?.split(",").filter(Boolean) ?? null,
    fullTurn: query.get("input") !== "any",
    maxLink: maxLink > 0 ? maxLink : USUAL.maxLink,
    mu: mu > 0 && mu < 90 ? mu : 0,
    pivots: numbersOf(query.get("pivots"), 4),
  };
}

/** The inverse of parseShapeQuery. @param {ShapeQuery} state */
export function formatShapeQuery(state) {
  const { d, place, like, part, least, mirror, by, families, fullTurn, maxLink, mu, pivots } = state;
  return {
    d,
    at: d && place?.join(","),
    like,
    part: part === null ? null : part ? "yes" : "no",
    least: part && least !== USUAL.least ? least : null,
    mirror: mirror ? null : "no",
    by: by === "rms" ? null : by,
    family: families?.join(","),
    input: fullTurn ? null : "any",
    "max-link": maxLink === USUAL.maxLink ? null : maxLink === Infinity ? "inf" : maxLink,
    mu: mu || null,
    pivots: pivots?.join(","),
  };
}

/** So many numbers with commas or blanks between them; null if they are others. @param {string | undefined} text */
export function numbersOf(text, /** @type {number} */ count) {
  const words = text?.trim().split(/[\s,;]+/) ?? [];
  const numbers = words.map(Number);
  return numbers.length === count && numbers.every(Number.isFinite) ? numbers : null;
}

/** What a search for four-bars is asked, for the kernel. @param {ShapeQuery} state */
export function fourBarOptions({ fullTurn, maxLink, mu, pivots }) {
  return {
    full_turn: fullTurn,
    max_link: maxLink,
    condition: mu ? `mu_worst_deg >= ${mu}` : null,
    pivots: pivots && Float64Array.from(pivots),
  };
}

/** The drawn shape of a state, or a curve of the atlas. @param {App} app @param {ShapeQuery} _ @returns {Promise<Outline | null>} */
export async function outlineOfState({ atlas }, { d, place, like }) {
  if (d) return decodeShape(d, place);
  if (!like) return null;
  const [id, key] = like.split(":");
  const family = await atlas.family(id);
  await needPieces(family, [family.outlines.ofNumber(parseCurveKey(key)?.[0] ?? NaN)]);
  const curve = findCurve(family, key);
  if (curve === undefined) throw new Error(`There is no curve ${key} in the family ${id}.`);
  return curveOutline(family, curve);
}
