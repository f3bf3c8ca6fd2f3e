// Sums, and numbers as people type them.

/** The units of an angle in degrees, and of one in radians, each with what to multiply by. @type {Record<string, Units>} */
export const ANGLE_UNITS = {
  deg: { "°": 1, deg: 1, rad: 180 / Math.PI },
  rad: { rad: 1, "°": Math.PI / 180, deg: Math.PI / 180 },
};

/**
 * Parses a number with a point or a comma, perhaps grouped, and perhaps with one of some units behind it: { value }, in the first of
 * them, or { reason } where it is none, or could be two.
 * @param {string} text @param {Units} [units] @returns {{ value: number } | { reason: string }}
 */
export function parseNumber(text, units = {}) {
  // Other minus signs, and spaces of all widths.
  let word = text.trim().replaceAll("−", "-").replace(/\s+/gu, " ");
  const names = Object.keys(units);
  const unit = names.find((one) => word.toLowerCase().endsWith(one.toLowerCase()));
  if (unit) word = word.slice(0, -unit.length).trim();
  const parts = /^([+-]?)([\d., ]*)((?:e[+-]?\d+)?)$/i.exec(word);
  const digits = parts && plainDigits(parts[2]);
  if (!digits) {
    const other = unit ? null : /^[+-]?[\d.,]+ ?(°|[a-z]{2,})$/i.exec(word);
    const reason = other && !names.length ? "has a unit: write a number alone" : "is not a number";
    return { reason: `“${text.trim()}” ${reason}${names.length ? ` (in ${names.join(", ")})` : ""}` };
  }
  if (digits.length === 2) {
    const [one, other] = digits.map((way) => Number(`${parts[1]}${way}${parts[3]}`));
    return { reason: `“${text.trim()}” could be ${one} or ${other}: write it without a comma` };
  }
  const value = Number(`${parts[1]}${digits[0]}${parts[3]}`) * (unit ? units[unit] : 1);
  return Number.isFinite(value) ? { value } : { reason: `“${text.trim()}” is too large` };
}

/** What digits with points, commas and spaces can be, with a point: nothing, one number, or two. @returns {string[] | null} */
function plainDigits(/** @type {string} */ text) {
  const [, whole, part = ""] = /^(.*?)(?:[.,](\d*))?$/.exec(text) ?? [];
  const isGrouped = /^\d{1,3}(?:([ ,.])\d{3})(?:\1\d{3})*$/.test(whole);
  const mark = text.at(-part.length - 1);
  const isPlain = /^\d*$/.test(whole) && (whole !== "" || part !== "");
  if (isPlain && mark === "," && /^[1-9]\d{0,2}$/.test(whole) && part.length === 3)
    return [`${whole}.${part}`, `${whole}${part}`];
  if (isPlain) return [`${whole || "0"}.${part || "0"}`];
  if (!isGrouped) return null;
  const group = whole[whole.search(/[ ,.]/)];
  const plain = whole.replaceAll(group, "");
  // The same mark twice only groups: 1,234,567.
  if (text !== whole && mark === group) return part.length === 3 ? [`${plain}${part}`] : null;
  return [`${plain}.${part || "0"}`];
}

/** The sum of a number of each thing. @template T @param {Iterable<T>} things @param {(thing: T) => number} of */
export function sumOf(things, of) {
  let sum = 0;
  for (const thing of things) sum += of(thing);
  return sum;
}
