// Parses the attribute `transform` of SVG into matrices [a, b, c, d, e, f]: x' = a x + c y + e, y' = b x + d
// y + f.

import { cosSinOfDegrees, radiansOf } from "../kinematics/angles.js";

export const IDENTITY_MATRIX = [1, 0, 0, 1, 0, 0];

/** The product of two matrices, which applies the second, then the first. */
export function matrixProduct([a, b, c, d, e, f], [p, q, r, s, t, u]) {
  return [a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f];
}

/** A flat array of points transformed by a matrix. */
export function transformPoints([a, b, c, d, e, f], points) {
  return points.map((value, k) =>
    k % 2 ? b * points[k - 1] + d * value + f : a * value + c * points[k + 1] + e,
  );
}

/** The matrix of each kind of transform from its numbers; null if they are too few or too many. */
const TRANSFORMS = {
  matrix: (numbers) => (numbers.length === 6 ? numbers : null),
  translate: ([x, y = 0, ...more]) => (more.length ? null : [1, 0, 0, 1, x, y]),
  scale: ([x, y = x, ...more]) => (more.length ? null : [x, 0, 0, y, 0, 0]),
  rotate: (numbers) => {
    const [angle, x = 0, y = 0] = numbers;
    const [cos, sin] = cosSinOfDegrees(angle);
    const turned = [cos, sin, -sin, cos, x - cos * x + sin * y, y - sin * x - cos * y];
    return [1, 3].includes(numbers.length) ? turned : null;
  },
  skewX: ([angle, ...more]) => (more.length ? null : [1, 0, Math.tan(radiansOf(angle)), 1, 0, 0]),
  skewY: ([angle, ...more]) => (more.length ? null : [1, Math.tan(radiansOf(angle)), 0, 1, 0, 0]),
};

/**
 * The matrix of a list of transforms, of which the last is applied first.
 *
 * @throws {Error} a sentence, if the text is not such a list
 */
export function matrixOfTransform(text) {
  const list = text.trim();
  const refused = () => new Error(`The transform “${list.slice(0, 60)}” cannot be read.`);
  if (list === "" || list === "none") return IDENTITY_MATRIX;
  let matrix = IDENTITY_MATRIX;
  let rest = list;
  while (rest) {
    const found = /^(\w+)\s*\(([^()]*)\)[\s,]*/.exec(rest);
    const does = found && Object.hasOwn(TRANSFORMS, found[1]) ? TRANSFORMS[found[1]] : null;
    const numbers = found && parseNumbers(found[2]);
    const next = does && numbers?.length ? does(numbers) : null;
    if (!next || !next.every(Number.isFinite)) throw refused();
    matrix = matrixProduct(matrix, next);
    rest = rest.slice(found[0].length);
  }
  return matrix;
}

/** The numbers of a list separated by commas, blanks or signs; null if there is anything else. */
export function parseNumbers(text) {
  const number = /[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?/gi;
  if (/[^\s,]/.test(text.replace(number, " "))) return null;
  return (text.match(number) ?? []).map(Number);
}
