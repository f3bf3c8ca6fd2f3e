// Histograms of columns of numbers.

export const BINS = 48;
/** The bin of a missing number. */
const NO_BIN = 255;

/**
 * A scale for a column and the bin of each of its rows: { low, high, isLog, bins u8[count], counts u32[BINS],
 * placeOf(value), valueAt(place) } with places 0 to 1 between `low` and `high`. Logarithmic where all numbers
 * are positive and their middle nine tenths span more than a factor of thirty. What is infinite stands in the
 * last bin.
 */
export function histogramOf(values) {
  const sorted = values.filter((value) => Number.isFinite(value)).sort();
  const [low, high] = sorted.length ? [sorted[0], sorted[sorted.length - 1]] : [0, 1];
  const part = (share) => sorted[Math.floor(share * (sorted.length - 1))];
  const isLog = low > 0 && part(0.95) > 30 * part(0.05);
  const [from, to] = isLog ? [Math.log(low), Math.log(high)] : [low, high];
  const across = to > from ? to - from : 1;
  const placeOf = (value) => {
    if (isLog && !(value > 0)) return 0;
    return Math.min(Math.max(((isLog ? Math.log(value) : value) - from) / across, 0), 1);
  };
  const valueAt = (place) => {
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

/** How many of some rows are in each bin. */
export function binCounts({ bins }, rows) {
  const counts = new Uint32Array(NO_BIN + 1);
  for (let k = 0; k < rows.length; k += 1) counts[bins[rows[k]]] += 1;
  return counts.subarray(0, BINS);
}

/** A number as it is typed and written in addresses: four figures, and no more. */
export function formatBound(value) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(4))) : "";
}
