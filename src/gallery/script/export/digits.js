// Formats numbers as the program writes them, to the last digit.

/**
 * The shortest digits that parse back to a number: positional from 1e-5 up to 1e16, otherwise with an
 * exponent. Zero has no sign; infinity is `inf`; NaN is empty.
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
 * The same, always with a decimal point or an exponent: some DXF readers take a number without either for an
 * integer.
 */
export function realDigits(value) {
  if (value === 0) return "0.0";
  const size = Math.abs(value);
  if (size < 1e-5 || size >= 1e16) return value.toExponential().replace("e+", "e");
  const digits = String(value);
  return digits.includes(".") ? digits : `${digits}.0`;
}

/** Rounds a number to decimal places, to an integer if `places` is negative; zero has no sign. */
export function roundToPlaces(value, places) {
  return Number(value.toFixed(Math.min(Math.max(places, 0), 100))) + 0;
}
