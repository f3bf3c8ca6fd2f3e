// Applies changed parameters to a linkage and recomputes the values derived from them.
//
// Changes are a Map of names to numbers, as in addresses: parameters and helpers by their names, and the
// position of the traced point on its link as "M.along" and "M.across". All other values are those of the
// atlas, or derived.

import { evaluateExpression } from "./expression.js";

/**
 * The values of a cell's names with changes; derived values are recomputed unless they are changed
 * themselves.
 */
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
 * A template with its traced point at its changed position; a changed point of a grid is added after the grid
 * and traced last.
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
