// Numbers as the program writes them, to the last digit.

/**
 * A number in the fewest digits that read back to it: written out from 1e-5 up to 1e16, beyond with an
 * exponent; zero without a sign, `inf`, and nothing where it is not a number.
 */
export function shortestDigits(value) {
  if (value === 0) return "0";
  if (Number.isNaN(value)) return "";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  const size = Math.abs(value);
  if (size >= 1e-5 && size < 1e16) return String(value);
  return value.toExponential().replace("e+", "e");
}

/**
 * The same with a point or an exponent always: some readers of DXF take a number without either for a whole
 * one.
 */
export function realDigits(value) {
  if (value === 0) return "0.0";
  const size = Math.abs(value);
  if (size < 1e-5 || size >= 1e16) return value.toExponential().replace("e+", "e");
  const digits = String(value);
  return digits.includes(".") ? digits : `${digits}.0`;
}

/** A number to so many decimal places, none where that is negative; zero has no sign. */
export function roundToPlaces(value, places) {
  return Number(value.toFixed(Math.min(Math.max(places, 0), 100))) + 0;
}
