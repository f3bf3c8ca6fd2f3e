// Truncated Taylor series in the input: arrays of the coefficients of 1, t, t^2 and so on. Sums, products,
// quotients and roots are exact to their order, so that the results are derivatives in closed form, not
// differences. A planar series is { x, y }.

/** The series of a constant. */
export function constantSeries(value, terms) {
  const series = new Array(terms).fill(0);
  series[0] = value;
  return series;
}

/** The series of the variable itself where it has this value. */
export function variableSeries(value, terms) {
  const series = constantSeries(value, terms);
  if (terms > 1) series[1] = 1;
  return series;
}

export function sumOfSeries(a, b) {
  return a.map((c, n) => c + b[n]);
}

export function differenceOfSeries(a, b) {
  return a.map((c, n) => c - b[n]);
}

export function productOfSeries(a, b) {
  const product = new Array(a.length);
  for (let n = 0; n < a.length; n++) {
    let sum = a[0] * b[n];
    for (let k = 1; k <= n; k++) sum += a[k] * b[n - k];
    product[n] = sum;
  }
  return product;
}

export function quotientOfSeries(a, b) {
  const quotient = new Array(a.length);
  for (let n = 0; n < a.length; n++) {
    let left = a[n];
    for (let k = 1; k <= n; k++) left -= b[k] * quotient[n - k];
    quotient[n] = left / b[0];
  }
  return quotient;
}

/** The square root; 0 where rounding makes the square negative. */
export function rootOfSeries(a) {
  const root = new Array(a.length);
  root[0] = Math.sqrt(Math.max(a[0], 0));
  for (let n = 1; n < a.length; n++) {
    let left = a[n];
    for (let k = 1; k < n; k++) left -= root[k] * root[n - k];
    root[n] = left / (2 * root[0]);
  }
  return root;
}

export function scaledSeries(a, by) {
  return a.map((c) => c * by);
}

/**
 * The root of a square that touches zero where the series begins, with the sign it has beyond; null where it
 * goes through zero. One term fewer is known of it than of the square: that one is not a number.
 */
export function sqrtAtTouch(square, size) {
  // A touch has no first term but rounding; at a limit that is as near one as 1e-12 it is 1e-6.
  if (!(Math.abs(square[1]) <= 1e-9 * size && square[2] > 0)) return null;
  const root = rootOfSeries(square.map((_, n) => square[n + 2] ?? NaN));
  return square.map((_, n) => (n === 0 ? 0 : root[n - 1]));
}

/** A constant position as a planar series. */
export function constantPlace(x, y, terms) {
  return { x: constantSeries(x, terms), y: constantSeries(y, terms) };
}

/** A direction that turns `by` radians to a radian of input. */
export function rotatingUnit(cos, sin, by, terms) {
  const [x, y] = [[cos], [sin]];
  for (let n = 1; n < terms; n++) {
    const rate = by / n;
    x.push(-(rate * y[n - 1]));
    y.push(rate * x[n - 1]);
  }
  return { x, y };
}

export function planarDifference(a, b) {
  return { x: differenceOfSeries(a.x, b.x), y: differenceOfSeries(a.y, b.y) };
}

/** A place moved `along` times a vector and `across` times its left normal, both series. */
export function movedPlace(place, by, along, across) {
  const forward = [productOfSeries(along, by.x), productOfSeries(along, by.y)];
  const left = [productOfSeries(across, by.y), productOfSeries(across, by.x)];
  return {
    x: differenceOfSeries(sumOfSeries(place.x, forward[0]), left[0]),
    y: sumOfSeries(sumOfSeries(place.y, forward[1]), left[1]),
  };
}

export function planarDot(a, b) {
  return sumOfSeries(productOfSeries(a.x, b.x), productOfSeries(a.y, b.y));
}

/** Positive where b points to the left of a. */
export function planarCross(a, b) {
  return differenceOfSeries(productOfSeries(a.x, b.y), productOfSeries(a.y, b.x));
}

/** The direction, of length 1. */
export function planarUnit(a) {
  const length = rootOfSeries(planarDot(a, a));
  return { x: quotientOfSeries(a.x, length), y: quotientOfSeries(a.y, length) };
}
