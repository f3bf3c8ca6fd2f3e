// The query of an address, which knows what of it is ignored.

/** Words by their names. A name that no view reads is ignored, and so is a value that one cannot use. @extends {Map<string, string>} */
export class AddressQuery extends Map {
  /** @type {Set<string>} */ read = new Set();
  /** Why values are ignored, by their names. @type {Map<string, string>} */ wrong = new Map();
  /** Is called when a value is ignored. @type {() => void} */ onignore = () => {};

  get(/** @type {string} */ name) {
    this.read.add(name);
    return super.get(name);
  }

  /** A value is ignored, for a reason. */
  ignore(/** @type {string} */ name, /** @type {string} */ why) {
    this.wrong.set(name, why);
    this.onignore();
  }

  /** A finite number from `least` on; undefined if there is none. @returns {number | undefined} */
  number(/** @type {string} */ name, least = -Infinity) {
    const word = this.get(name);
    if (word === undefined) return undefined;
    const value = word.trim() === "" ? NaN : Number(word);
    if (Number.isFinite(value) && value >= least) return value;
    this.ignore(name, Number.isFinite(value) ? `less than ${least}` : "not a number");
    return undefined;
  }

  /** One of some words; undefined if there is none. */
  word(/** @type {string} */ name, /** @type {string[]} */ words) {
    return this.list(name, (word) => words.includes(word))?.[0];
  }

  /** A list of words, those that are usable; undefined if there is none. */
  list(/** @type {string} */ name, isUsable = (/** @type {string} */ _) => true) {
    const words = this.get(name)?.split(",").filter(Boolean);
    const wrong = words?.filter((word) => !isUsable(word)) ?? [];
    if (wrong.length) this.ignore(name, `there is no “${wrong.join(", ")}”`);
    return words?.filter(isUsable);
  }

  /** What is ignored, in a sentence; empty if nothing is. */
  get ignored() {
    const reasons = [...this].map(([name, value]) => {
      const why = this.wrong.get(name) ?? (this.read.has(name) ? null : "unknown");
      return why && `${name}${value ? `=${value.slice(0, 40)}` : ""} (${why})`;
    });
    const words = reasons.filter(Boolean);
    return words.length ? `Ignored in the address: ${words.join("; ")}` : "";
  }
}
