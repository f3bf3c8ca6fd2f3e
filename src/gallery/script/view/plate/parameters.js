// What can be changed of a linkage on its plate (changes are as in kinematics/changes.js).

import { changedValues, tracedPoint } from "../../kinematics/parameter-changes.js";
import { roundBelow } from "../../draw/plane-view.js";

/**
 * What a plate offers to change: [{ name, kind, value, recorded, low, high, grain, min, max }]. `kind` is
 * "free" for what the atlas varies, "kept" for what it keeps, "follows" for what is derived from others, and
 * "freed" for that when it has been changed; `low` to `high` is a sensible range, `grain` the step of a
 * slider.
 */
export function changeableParameters(family, cell, trace, changes) {
  const width = family.names.length;
  const recorded = family.cells.values.subarray(cell * width, (cell + 1) * width);
  const values = changedValues(family, cell, changes);
  const size = Math.max(...recorded.filter(Number.isFinite).map(Math.abs), 0) || 1;
  const whole = wholeSlots(family.template);
  const derived = new Map(family.derived);
  const offered = family.names.map((name, slot) => {
    const bounds = family.template.parameters[slot] ?? {};
    const follows = derived.has(slot) && typeof derived.get(slot) !== "number";
    const kind = family.free.includes(slot)
      ? "free"
      : !follows
        ? "kept"
        : changes.has(name)
          ? "freed"
          : "follows";
    const spread = spreadOfSlot(family, slot);
    const range = sensibleRange(recorded[slot], spread, bounds, size, whole.has(slot));
    return {
      name,
      kind,
      value: values[slot],
      recorded: recorded[slot],
      min: bounds.min ?? null,
      max: bounds.max ?? null,
      ...range,
    };
  });
  return [...offered, ...changeableCoordinates(family, recorded, values, trace, changes, size)];
}

function changeableCoordinates({ template }, recorded, values, trace, changes, size) {
  const point = tracedPoint(template, trace);
  if (!point) return [];
  return ["along", "across"]
    .filter((way) => !point[way].isParameter)
    .map((way) => {
      const name = `${point.name}.${way}`;
      const [kept, follows] = [point[way].at(recorded), !point[way].isKept];
      const kind = !follows ? "kept" : changes.has(name) ? "freed" : "follows";
      const value = changes.get(name) ?? point[way].at(values);
      return {
        name,
        kind,
        value,
        recorded: kept,
        min: null,
        max: null,
        ...sensibleRange(kept, [kept, kept], {}, size, false),
      };
    });
}

function spreadOfSlot({ cells, names }, slot) {
  let [least, most] = [Infinity, -Infinity];
  for (let k = slot; k < cells.values.length; k += names.length) {
    if (cells.values[k] < least) least = cells.values[k];
    if (cells.values[k] > most) most = cells.values[k];
  }
  return [least, most];
}

// The slots that must be whole numbers: the teeth of gears.
function wholeSlots({ joints }) {
  const ratios = joints.flatMap((joint) => ("gear" in joint ? joint.ratio : []));
  return new Set(ratios.filter((part) => Array.isArray(part) && part.length === 1).map(([[slot]]) => slot));
}

function sensibleRange(recorded, [least, most], { min, max }, size, isWhole) {
  if (isWhole) return { low: Math.min(least, -6), high: Math.max(most, 6), grain: 1 };
  const reach = Math.max(most - least, 0.6 * Math.abs(recorded)) || size;
  let low = Math.min(least, recorded - 0.5 * reach);
  let high = Math.max(most, recorded + 0.5 * reach);
  // A bound of 0 is itself left out.
  if (min === 0 && low <= 0) low = 0.1 * Math.min(least, recorded);
  else if (min !== null && min !== undefined) low = Math.max(low, min);
  if (max === 0 && high >= 0) high = 0.1 * Math.max(most, recorded);
  else if (max !== null && max !== undefined) high = Math.min(high, max);
  return { low, high, grain: roundBelow((high - low) / 400) || 0.01 };
}

/** A value rounded to a grain, with no more decimals than that has. */
export function roundedToGrain(value, grain) {
  const decimals = Math.max(0, -Math.floor(Math.log10(grain) + 1e-9));
  return Number((Math.round(value / grain) * grain).toFixed(Math.min(decimals, 12)));
}

/** The changes that a query (a Map of words) says, of what can be changed; the rest is left out. */
export function changesOfQuery(family, trace, query) {
  const point = tracedPoint(family.template, trace);
  const known = new Set([...family.names, ...(point ? [`${point.name}.along`, `${point.name}.across`] : [])]);
  const changes = new Map();
  for (const [name, word] of query) {
    const value = Number(word);
    if (known.has(name) && word.trim() !== "" && Number.isFinite(value)) changes.set(name, value);
  }
  return changes;
}
