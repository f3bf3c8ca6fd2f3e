// Evaluates expressions, which are programs for a stack machine.

import { degreesOf, radiansOf } from "./angles.js";

/**
 * The value of an expression: a number, or a program in an array (numbers are pushed, [slot] pushes
 * values[slot], strings are operators, or functions with their number of arguments: "atan2/2"). Booleans are
 * 1 or 0; an undefined value is NaN.
 */
export function evaluateExpression(expression, values) {
  if (typeof expression === "number") return expression;
  const stack = [];
  for (const instruction of expression) {
    if (typeof instruction === "number") stack.push(instruction);
    else if (Array.isArray(instruction)) stack.push(values[instruction[0]]);
    else if (instruction === "neg") stack.push(-stack.pop());
    else if (instruction === "not") stack.push(stack.pop() === 0 ? 1 : 0);
    else if (instruction.includes("/") && instruction !== "/") {
      const [name, count] = instruction.split("/");
      stack.push(calledFunction(name, stack.splice(stack.length - Number(count))));
    } else {
      const right = stack.pop();
      stack.push(appliedOperator(instruction, stack.pop(), right));
    }
  }
  return stack.length > 0 ? stack[stack.length - 1] : NaN;
}

// A comparison with a missing value, which is not a number, is false.
function appliedOperator(operator, a, b) {
  const truth = (holds) => (holds ? 1 : 0);
  switch (operator) {
    case "+":
      return a + b;
    case "-":
      return a - b;
    case "*":
      return a * b;
    case "/":
      return a / b;
    case "^":
      // Unlike `**`, 1 to the power of anything is 1.
      return a === 1 || (a === -1 && !Number.isFinite(b) && !Number.isNaN(b)) ? 1 : Math.pow(a, b);
    case "==":
      return truth(a === b);
    case "!=":
      return truth(a !== b && !Number.isNaN(a) && !Number.isNaN(b));
    case "<":
      return truth(a < b);
    case "<=":
      return truth(a <= b);
    case ">":
      return truth(a > b);
    case ">=":
      return truth(a >= b);
    case "and":
      return truth(a === 1 && b === 1);
    case "or":
      return truth(a === 1 || b === 1);
    default:
      return NaN;
  }
}

function calledFunction(name, [x, ...rest]) {
  switch (name) {
    case "deg":
      return degreesOf(x);
    case "rad":
      return radiansOf(x);
    case "sqrt":
    case "sin":
    case "cos":
    case "tan":
    case "asin":
    case "acos":
    case "atan2":
    case "abs":
    case "min":
    case "max":
    case "hypot":
      return Math[name](x, ...rest);
    default:
      return NaN;
  }
}
