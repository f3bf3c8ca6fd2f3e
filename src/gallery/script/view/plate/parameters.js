// What can be changed of a linkage on its plate, and what follows from it.
//
// Changes are a Map of names to numbers, as the address has them: parameters and helpers by their names, and
// where the traced point is on its link as "M.along" and "M.across". What is not changed is as the atlas has
// it, or follows.

import { evaluateExpression } from "../../kinematics/expression.js";
import { roundBelow } from "../../draw/paper-view.js";

/** The values of a cell's names with changes: what is derived follows, where it is not changed itself. */
export function changedValues(family, cell, changes) {
  const width = family.names.length;
  const values = family.cells.values.slice(cell * width, (cell + 1) * width);
  const has = (slot) => changes.has(family.names[slot]);
  const isChanged = family.names.some((name) => changes.has(name));
  if (!isChanged) return values;
  family.names.forEach((name, slot) => {
    if (has(slot)) values[slot] = changes.get(name);
  });
  for (const [slot, expression] of family.derived) {
    if (!has(slot) && typeof expression !== "number") values[slot] = evaluateExpression(expression, values);
  }
  return values;
}

/**
 * The traced joint of a template, { joint (its place), name, along, across } with coordinates as numbers or
 * expressions.
 */
export function tracedPoint(template, trace) {
  let left = trace - 1;
  for (const joint of template.trace) {
    const made = template.joints[joint];
    const isPoint = made.point && !made.distances;
    const [alongs, acrosses] = isPoint ? [made.along, made.across].map(coordinateCount) : [1, 1];
    if (left >= alongs * acrosses) {
      left -= alongs * acrosses;
      continue;
    }
    if (!isPoint) return null;
    const isGrid = alongs * acrosses > 1;
    // Of a grid the points across one another come first.
    const along = coordinatePart(made.along, Math.floor(left / acrosses));
    const across = coordinatePart(made.across, left % acrosses);
    return { joint, name: made.name, isGrid, along, across };
  }
  return null;
}

function coordinateCount(coordinate) {
  return coordinate?.count ?? 1;
}

// The k-th place of a coordinate, as a function of the values.
function coordinatePart(coordinate, k) {
  const plain = coordinate ?? 0;
  if (typeof plain === "number" || Array.isArray(plain)) {
    const isKept = typeof plain === "number";
    const isParameter = !isKept && plain.length === 1 && Array.isArray(plain[0]);
    return { isKept, isParameter, at: (values) => evaluateExpression(plain, values) };
  }
  const part = plain.count === 1 ? 0 : k / (plain.count - 1);
  const at = (values) => {
    const [from, to] = [plain.from, plain.to].map((end) => evaluateExpression(end, values));
    return from + (to - from) * part;
  };
  return { isKept: false, isParameter: false, at };
}

/**
 * A template whose traced point is where changes have it; a point of a grid comes to stand beside the grid,
 * traced last.
 */
export function templateWithChanges(template, trace, values, changes) {
  const point = tracedPoint(template, trace);
  const names = point ? ["along", "across"].map((way) => `${point.name}.${way}`) : [];
  if (!names.some((name) => changes.has(name))) return { template, trace };
  const [along, across] = [point.along, point.across].map(
    (way, k) => changes.get(names[k]) ?? way.at(values),
  );
  const moved = { ...template.joints[point.joint], along, across };
  const joints = [...template.joints];
  if (!point.isGrid) {
    joints[point.joint] = moved;
    return { template: { ...template, joints }, trace };
  }
  joints.push({ ...moved, name: `${point.name}′` });
  return { template: { ...template, joints, trace: [...template.trace, joints.length - 1] }, trace: null };
}

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
