// Formats JSON as the program does: a line for each member, lists of plain values on one line.

import { shortestDigits } from "./digits.js";

/** A value as text with a final newline. Numbers that are not finite become null. */
export function prettyJson(value) {
  return `${prettyValue(value, 0)}\n`;
}

function prettyValue(value, depth) {
  if (typeof value === "number") return Number.isFinite(value) ? shortestDigits(value) : "null";
  if (value === null || typeof value !== "object") return JSON.stringify(value);
  const isList = Array.isArray(value);
  const items = isList
    ? value.map((item) => prettyValue(item, depth + 1))
    : Object.entries(value).map(([name, item]) => `${JSON.stringify(name)}: ${prettyValue(item, depth + 1)}`);
  const [open, close] = isList ? "[]" : "{}";
  if (items.length === 0) return `${open}${close}`;
  const isPlain = isList && value.every((item) => item === null || typeof item !== "object");
  if (isPlain) return `[${items.join(", ")}]`;
  const line = (at) => `\n${"  ".repeat(at)}`;
  return `${open}${line(depth + 1)}${items.join(`,${line(depth + 1)}`)}${line(depth)}${close}`;
}
