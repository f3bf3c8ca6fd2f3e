// Histograms of columns of numbers.

export const BINS = 48;
/** The bin of a missing number. */
const NO_BIN = 255;

/**
 * The histogram of a column, with places from 0 to 1 between `low` and `high`. Logarithmic if all numbers are
 * positive and the middle 90 % span more than a factor of thirty. Infinity is in the last bin.
 */
export function histogramOf(/** @type {Float64Array} */ values) {
  const sorted = values.filter((value) => Number.isFinite(value)).sort();
  const [low, high] = sorted.length ? [sorted[0], sorted[sorted.length - 1]] : [0, 1];
  const part = (/** @type {number} */ share) => sorted[Math.floor(share * (sorted.length - 1))];
  const isLog = low > 0 && part(0.95) > 30 * part(0.05);
  const [from, to] = isLog ? [Math.log(low), Math.log(high)] : [low, high];
  const across = to > from ? to - from : 1;
  const placeOf = (/** @type {number} */ value) => {
    if (isLog && !(value > 0)) return 0;
    return Math.min(Math.max(((isLog ? Math.log(value) : value) - from) / across, 0), 1);
  };
  const valueAt = (/** @type {number} */ place) => {
    if (place <= 0) return low;
    if (place >= 1) return high;
    return isLog ? Math.exp(from + place * across) : from + place * across;
  };
  const bins = new Uint8Array(values.length);
  const counts = new Uint32Array(BINS);
  for (let row = 0; row < values.length; row += 1) {
    const value = values[row];
    bins[row] = Number.isNaN(value) ? NO_BIN : Math.min(Math.floor(placeOf(value) * BINS), BINS - 1);
    if (bins[row] !== NO_BIN) counts[bins[row]] += 1;
  }
  return { low, high, isLog, bins, counts, placeOf, valueAt };
}

/** The number of the given rows in each bin. @param {Histogram} _ @param {Uint32Array} rows */
export function binCounts({ bins }, rows) {
  const counts = new Uint32Array(NO_BIN + 1);
  for (let k = 0; k < rows.length; k += 1) counts[bins[rows[k]]] += 1;
  return counts.subarray(0, BINS);
}

/** A number as it appears in fields and addresses: at most four significant digits. */
export function formatBound(/** @type {number} */ value) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(4))) : "";
}
