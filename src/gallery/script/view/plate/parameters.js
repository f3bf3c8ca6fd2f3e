// The parameters of a linkage that can be changed on its plate, as in kinematics/parameter-changes.js.

import { changedValues, tracedPoint } from "../../kinematics/parameter-changes.js";
import { roundBelow } from "../../draw/plane-view.js";

/**
 * The parameters that can be changed: [{ name, kind, value, recorded, low, high, grain, min, max }]. `kind`
 * is "free" if the atlas varies the parameter, "fixed" if it is constant, "derived" if an expression gives
 * it, and "unlinked" if a derived one has been changed. `low` to `high` is the range of the slider, `grain`
 * its step.
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
    const isDerived = derived.has(slot) && typeof derived.get(slot) !== "number";
    const kind = family.free.includes(slot)
      ? "free"
      : !isDerived
        ? "fixed"
        : changes.has(name)
          ? "unlinked"
          : "derived";
    const range = sliderRange(recorded[slot], family.ranges[slot], bounds, size, whole.has(slot));
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
      const [recordedValue, isDerived] = [point[way].at(recorded), !point[way].isKept];
      const kind = !isDerived ? "fixed" : changes.has(name) ? "unlinked" : "derived";
      const value = changes.get(name) ?? point[way].at(values);
      return {
        name,
        kind,
        value,
        recorded: recordedValue,
        min: null,
        max: null,
        ...sliderRange(recordedValue, [recordedValue, recordedValue], {}, size, false),
      };
    });
}

// The slots that must be integers: the numbers of teeth of gears.
function wholeSlots({ joints }) {
  const ratios = joints.flatMap((joint) => ("gear" in joint ? joint.ratio : []));
  return new Set(ratios.filter((part) => Array.isArray(part) && part.length === 1).map(([[slot]]) => slot));
}

function sliderRange(recorded, [least, most], { min, max }, size, isWhole) {
  if (isWhole) return { low: Math.min(least, -6), high: Math.max(most, 6), grain: 1 };
  const reach = Math.max(most - least, 0.6 * Math.abs(recorded)) || size;
  let low = Math.min(least, recorded - 0.5 * reach);
  let high = Math.max(most, recorded + 0.5 * reach);
  // A bound of 0 is exclusive.
  if (min === 0 && low <= 0) low = 0.1 * Math.min(least, recorded);
  else if (min !== null && min !== undefined) low = Math.max(low, min);
  if (max === 0 && high >= 0) high = 0.1 * Math.max(most, recorded);
  else if (max !== null && max !== undefined) high = Math.min(high, max);
  return { low, high, grain: roundBelow((high - low) / 400) || 0.01 };
}

/** Rounds a value to a multiple of `grain`, with no more decimals than it has. */
export function roundedToGrain(value, grain) {
  const decimals = Math.max(0, -Math.floor(Math.log10(grain) + 1e-9));
  return Number((Math.round(value / grain) * grain).toFixed(Math.min(decimals, 12)));
}

/** The changes in a query (a Map of words); names that cannot be changed are ignored. */
export function parseChanges(family, trace, query) {
  const point = tracedPoint(family.template, trace);
  const known = new Set([...family.names, ...(point ? [`${point.name}.along`, `${point.name}.across`] : [])]);
  const changes = new Map();
  for (const [name, word] of query) {
    const value = Number(word);
    if (known.has(name) && word.trim() !== "" && Number.isFinite(value)) changes.set(name, value);
  }
  return changes;
}
