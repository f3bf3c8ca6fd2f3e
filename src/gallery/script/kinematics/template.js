// Builds a linkage from a template and values.

import { LinkageBuilder, LinkageError } from "./linkage-builder.js";
import { evaluateExpression } from "./expression.js";
import { inputOfJoints } from "./linkage.js";

/** What is wrong with the value of a parameter of a template, in a sentence; null where nothing is. */
function valueError({ name, min, max }, value) {
  if (!Number.isFinite(value)) return `\`${name}\` is ${value}, which is not a finite number`;
  if (min === 0 && value <= 0) return `\`${name}\` is ${value}, and must be more than 0`;
  if (min !== null && min !== undefined && value < min) {
    return `\`${name}\` is ${value}, below its least value of ${min}`;
  }
  if (max === 0 && value >= 0) return `\`${name}\` is ${value}, and must be less than 0`;
  if (max !== null && max !== undefined && value > max) {
    return `\`${name}\` is ${value}, above its greatest value of ${max}`;
  }
  return null;
}

/**
 * The linkage of a parameter set.
 *
 * @param template a template as in the data of the page
 * @param values the values of its parameters, in their order; more may follow
 * @returns a linkage, as linkage.js has it
 * @throws {LinkageError} a value out of bounds, a number that is not finite, a joint that cannot be placed
 */
export function linkageOf(template, values) {
  template.parameters?.forEach((parameter, k) => {
    const objection = valueError(parameter, values[k]);
    if (objection) throw new LinkageError(objection);
  });
  const assembly = new LinkageBuilder();
  // Where each joint of the template has gone: a grid of points makes several.
  const made = [];
  for (const joint of template.joints) made.push(placedJoints(assembly, joint, made, values));
  const seenFrom = template.seen_from ? template.seen_from.map((joint) => made[joint][0]) : null;
  if (seenFrom) assembly.seenFrom(seenFrom);
  const { joints, links, signs, dyads } = assembly;
  const input = inputOfJoints(joints);
  const travel = { signs, ...motionOptions(template, values, input) };
  const placement = template.placement ?? { mirror: false, cos: 1, sin: 0 };
  const traced = template.trace.flatMap((joint) => made[joint]);
  return { joints, links, traced, seenFrom, placement, travel, dyads, input };
}

function placedJoints(assembly, joint, made, values) {
  const { name } = joint;
  const number = (expression) => evaluateExpression(expression, values);
  const finite = (what, expression) => {
    const value = number(expression ?? 0);
    if (Number.isFinite(value)) return value;
    throw new LinkageError(`${what} of \`${name}\` is ${value}, which is not a finite number`);
  };
  const at = (base) => base.map((k) => made[k][0]);
  const one = (k) => made[k][0];
  if (joint.fixed)
    return [assembly.fixed(name, [finite("the x", joint.fixed[0]), finite("the y", joint.fixed[1])])];
  if ("crank" in joint) return [assembly.crank(name, one(joint.crank), number(joint.length))];
  if ("gear" in joint) {
    const phase = finite("`phase`", joint.phase);
    return [assembly.gear(name, one(joint.about), number(joint.length), joint.ratio.map(number), phase)];
  }
  const offset = () => finite("`offset`", joint.offset);
  if (joint.piston)
    return [assembly.piston(name, at(joint.piston), number(joint.length), offset(), joint.side)];
  if (joint.dyad) return [assembly.dyad(name, at(joint.dyad), joint.lengths.map(number), joint.side)];
  if ("slide" in joint) {
    const [from, length] = [one(joint.slide), number(joint.length)];
    return [assembly.slide(name, from, length, at(joint.line), offset(), joint.side)];
  }
  if ("yoke" in joint) {
    const angle = finite("`angle`", joint.angle ?? 90);
    return [assembly.yoke(name, one(joint.yoke), at(joint.line), offset(), angle)];
  }
  if (joint.slot) return [assembly.slot(name, at(joint.slot), offset(), joint.side)];
  if (joint.parallelogram) return [assembly.parallelogram(name, at(joint.parallelogram))];
  if (joint.distances)
    return [assembly.distances(name, at(joint.point), joint.distances.map(number), joint.side)];
  const across = coordinateValues(joint.across, number);
  return coordinateValues(joint.along, number).flatMap((along) =>
    across.map((to) =>
      assembly.point(name, at(joint.point), finite("`along`", along), finite("`across`", to)),
    ),
  );
}

// The values of a coordinate on a link: one, or evenly spaced ones with both ends among them.
function coordinateValues(coordinate, number) {
  if (coordinate === undefined || coordinate === null) return [0];
  if (typeof coordinate === "number" || Array.isArray(coordinate)) return [number(coordinate)];
  const { count } = coordinate;
  const [from, to] = [number(coordinate.from), number(coordinate.to)];
  return Array.from({ length: count }, (_, k) => from + (to - from) * (count === 1 ? 0 : k / (count - 1)));
}

function motionOptions(template, values, input) {
  const number = (expression) => evaluateExpression(expression, values);
  const finite = (what, expression) => {
    const value = number(expression);
    if (Number.isFinite(value)) return value;
    throw new LinkageError(`${what} is ${value}, which is not a finite number`);
  };
  const isGiven = (value) => value !== null && value !== undefined;
  let range = null;
  if (isGiven(template.input)) {
    range = [finite("the input's `from`", template.input[0]), finite("the input's `to`", template.input[1])];
    const length = range[1] - range[0];
    const tooFar = (why) => new LinkageError(`the input's \`to\` is ${range[1]}, ${why}`);
    if (length <= 0) throw tooFar("and must be more than `from`");
    if (length > input.period) throw tooFar("which is more than a period from `from`");
  }
  const start = isGiven(template.start) ? finite("`start`", template.start) : null;
  // An arc whose ends do not exist for these lengths is no part of the curve.
  const ends = template.arc ? template.arc.input.map(number) : [NaN];
  const arc = ends.every(Number.isFinite) ? { input: ends, branch: template.arc.branch } : null;
  const { circuits = "start", continuation = "smooth", coincident = "together" } = template;
  return { start, range, circuits, continuation, coincident, arc };
}
