// Finds the extremes of a quantity of the pose over a circuit.

import { passRange } from "../kinematics/pass.js";
import { posesAt } from "../kinematics/poses.js";

/**
 * The least and the greatest value over a circuit of a quantity of the pose: quantity(at), with at(joint) ->
 * [x, y], of joints that others depend on. By its samples, and then by parabolas between them: near a smooth
 * extreme the error of the value is of second order in that of the position.
 */
export function extremesOver(linkage, circuit, quantity) {
  const values = Float64Array.from({ length: circuit.count }, (_, i) =>
    quantity((joint) => [circuit.x[joint][i], circuit.y[joint][i]]),
  );
  const at = (pass, input) => {
    const { x, y } = posesAt(linkage, pass, [input]);
    return quantity((joint) => [x[joint][0], y[joint][0]]);
  };
  return [1, -1].map((sign) => {
    let best = -1;
    for (let i = 0; i < values.length; i++) {
      if (Number.isFinite(values[i]) && (best < 0 || sign * values[i] < sign * values[best])) best = i;
    }
    if (best < 0) return NaN;
    let least = sign * values[best];
    for (const pass of circuit.passes) {
      const three = inputsAbout(circuit, pass, best);
      if (three)
        least = Math.min(
          least,
          leastByParabolas((input) => sign * at(pass, input), ...three),
        );
    }
    return sign * least;
  });
}

// The inputs of a sample and its neighbours on a pass; null where the sample is not on it.
function inputsAbout(circuit, pass, best) {
  const [low, high] = passRange(pass);
  const middle = circuit.input[best];
  // On a whole turn the first sample is between the last and the second.
  const step = (high - low) / Math.max(circuit.count, 2);
  const turn = middle > high ? low - high : 0;
  const here = middle + turn;
  if (pass.signs !== circuit.signs(best) || here < low - step || here > high + step) return null;
  const beside = (way) => {
    const input = circuit.input[best + way];
    const off = input === undefined ? step : Math.abs(input - middle);
    return Math.min(Math.max(here + way * off, low), high);
  };
  return [beside(-1), here, beside(1)];
}

// The least value of a function about a place where it is less than at both ends, by parabolas through three
// places.
function leastByParabolas(f, from, middle, to) {
  const ROUNDS = 8;
  let [a, b, c] = [from, middle, to];
  let [fa, fb, fc] = [f(a), f(b), f(c)];
  for (let round = 0; round < ROUNDS; round++) {
    const [left, right] = [(b - a) * (fb - fc), (b - c) * (fb - fa)];
    const vertex = b - ((b - a) * left - (b - c) * right) / (2 * (left - right));
    if (!Number.isFinite(vertex) || vertex <= a || vertex >= c || vertex === b) break;
    const fv = f(vertex);
    if (fv > fb) {
      // The vertex is a new end.
      if (vertex < b) [a, fa] = [vertex, fv];
      else [c, fc] = [vertex, fv];
    } else if (vertex < b) [c, fc, b, fb] = [b, fb, vertex, fv];
    else [a, fa, b, fb] = [b, fb, vertex, fv];
  }
  return Math.min(fb, fa, fc);
}
