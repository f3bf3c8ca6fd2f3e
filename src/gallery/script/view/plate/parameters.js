// The parameters of a linkage that can be changed on its plate: parameters and helpers by their names, and the
// position of the traced point on its link as "M.along" and "M.across".

import { parameterWord } from "../../data/address.js";
import { roundBelow } from "../../draw/plane-view.js";

/** @type {("along" | "across")[]} */
const COORDINATES = ["along", "across"];

/**
 * The parameters that can be changed. `kind` is "free" if the atlas varies the parameter, "fixed" if it is constant, "derived" if an
 * expression gives it, and "unlinked" if a derived one has been changed. `low` to `high` is the range of the slider, `grain` its step.
 * `unit` is that of an angle. `recorded` and `current` are the values of the curve as the atlas has it and with the changes.
 * @param {Family} family @param {FamilyDescription["names"]} names @param {CurveValues} recorded @param {CurveValues} current @param
 * {Map<string, number>} changes
 */
export function changeableParameters(family, names, recorded, current, changes) {
  const values = Object.values(recorded.values).filter(Number.isFinite);
  const size = Math.max(...values.map(Math.abs), 0) || 1;
  const offered = names.map(({ name, min, max, unit, is_whole: isWhole, is_derived: isDerived }, slot) => {
    const kind = family.free.includes(slot) ? "free" : kindOfLocked(isDerived, changes.has(name));
    const own = recorded.values[name];
    const range = sliderRange(own, family.ranges[slot], { min, max }, size, isWhole);
    const value = changes.get(name) ?? current.values[name];
    return { name, kind, value, unit, recorded: own, min, max, ...range };
  });
  return [...offered, ...changeableCoordinates(recorded.point, current.point, changes, size)];
}

function kindOfLocked(/** @type {boolean} */ isDerived, /** @type {boolean} */ isChanged) {
  if (!isDerived) return "fixed";
  return isChanged ? "unlinked" : "derived";
}

/** @param {MovablePoint | null} recorded @param {MovablePoint | null} current @param {Map<string, number>} changes */
function changeableCoordinates(recorded, current, changes, /** @type {number} */ size) {
  if (!recorded || !current) return [];
  const changeable = COORDINATES.filter((way) => !recorded[way].is_parameter);
  return changeable.map((way) => {
    const name = `${recorded.name}.${way}`;
    const { value: own, is_constant: isConstant } = recorded[way];
    const kind = kindOfLocked(!isConstant, changes.has(name));
    const value = changes.get(name) ?? current[way].value;
    const free = { unit: null, min: null, max: null };
    return { name, kind, value, recorded: own, ...free, ...sliderRange(own, [own, own], free, size) };
  });
}

/** @param {number} recorded @param {number[]} _ @param {{ min: number | null, max: number | null }} _1 @param {number} size */
function sliderRange(recorded, [least, most], { min, max }, size, isWhole = false) {
  if (isWhole) return { low: Math.min(least, -6), high: Math.max(most, 6), grain: 1 };
  const reach = Math.max(most - least, 0.6 * Math.abs(recorded)) || size;
  let low = Math.min(least, recorded - 0.5 * reach);
  let high = Math.max(most, recorded + 0.5 * reach);
  // A bound of 0 is exclusive.
  if (min === 0 && low <= 0) low = 0.1 * Math.min(least, recorded);
  else if (min !== null) low = Math.max(low, min);
  if (max === 0 && high >= 0) high = 0.1 * Math.max(most, recorded);
  else if (max !== null) high = Math.min(high, max);
  return { low, high, grain: roundBelow((high - low) / 400) || 0.01 };
}

/**
 * Whether a value of a name is that of the atlas, which no expression gives.
 * @param {FamilyDescription["names"]} names @param {CurveValues} recorded @param {string} name @param {number} value
 */
export function isRecordedValue(names, { point, values }, name, value) {
  const way = point && COORDINATES.find((one) => name === `${point.name}.${one}`);
  if (way) return point[way].is_constant && point[way].value === value;
  return values[name] === value && !names.find((known) => known.name === name)?.is_derived;
}

/** Rounds a value to a multiple of `grain`, with no more decimals than it has. */
export function roundedToGrain(/** @type {number} */ value, /** @type {number} */ grain) {
  const decimals = Math.max(0, -Math.floor(Math.log10(grain) + 1e-9));
  return Number((Math.round(value / grain) * grain).toFixed(Math.min(decimals, 12)));
}

/** The names of values of a curve with a movable traced point or null. @param {Family} family @param {MovablePoint | null} point */
export function changeableNames(family, point) {
  return point ? [...family.names, `${point.name}.along`, `${point.name}.across`] : family.names;
}

/**
 * The changes in a query of a curve with a movable traced point or null.
 * @param {Family} family @param {MovablePoint | null} point @param {AddressQuery} query
 */
export function parseChanges(family, point, query) {
  /** @type {Map<string, number>} */ const changes = new Map();
  const names = new Map(changeableNames(family, point).map((name) => [parameterWord(name), name]));
  for (const word of query.keys()) {
    const name = names.get(word);
    const value = name === undefined ? undefined : query.number(word);
    if (name !== undefined && value !== undefined) changes.set(name, value);
  }
  return changes;
}
