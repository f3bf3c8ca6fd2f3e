// The equation of a coupler curve, a sextic (Samuel Roberts; Natesan 6.5 and 7.1 with the sign of y^2
// corrected), in the frame with its origin at the crank's pivot and x towards the rocker's.

/**
 * The equation for a point [along, left] of the coupler: coefficients c[i][j] of x^i y^j, that of x^6 being
 * 1; null for the pins, which go on circles.
 */
export function couplerEquation({ frame, crank, coupler, rocker }, [ux, uy]) {
  const vx = ux - coupler;
  if ((ux === 0 && uy === 0) || (vx === 0 && uy === 0)) return null;
  const [u2, v2] = [ux * ux + uy * uy, vx * vx + uy * uy];
  const difference = (length2, length) => (Math.sqrt(length2) - length) * (Math.sqrt(length2) + length);
  const [dot, sine] = [ux * vx + uy * uy, ux * uy - uy * vx];
  // From (6.4): x cos t + y sin t = E1 / 2b, and the same about the rocker's pivot, turned by gamma.
  const e1 = circlePolynomial(difference(u2, crank), 0, 0, 1);
  const e2 = circlePolynomial(frame * frame + difference(v2, rocker), -2 * frame, 0, 1);
  const line = (c, x, y) => circlePolynomial(c, x, y, 0);
  const first = polynomialSum(
    polynomialProduct(line(-frame * sine, sine, -dot), e1),
    polynomialProduct(line(0, 0, u2), e2),
  );
  const second = polynomialSum(
    polynomialProduct(line(-frame * dot, dot, sine), e1),
    polynomialProduct(line(0, -u2, 0), e2),
  );
  const right = circlePolynomial(0, -frame * sine, -frame * dot, sine);
  const squares = polynomialSum(polynomialProduct(first, first), polynomialProduct(second, second));
  const product = scaledPolynomial(polynomialProduct(right, right), -4 * u2);
  const equation = polynomialSum(squares, product);
  return scaledPolynomial(equation, 1 / equation[6][0]);
}

/**
 * The left side of the equation at a point, the sum of its terms' magnitudes, and the length of its gradient.
 */
export function equationAt(equation, x, y) {
  const ladder = (value) => {
    const powers = [1];
    for (let n = 1; n < 7; n++) powers.push(powers[n - 1] * value);
    return powers;
  };
  const [xs, ys] = [ladder(x), ladder(y)];
  let [value, size, byX, byY] = [0, 0, 0, 0];
  for (let i = 0; i <= 6; i++) {
    for (let j = 0; i + j <= 6; j++) {
      const c = equation[i][j];
      const term = c * xs[i] * ys[j];
      value += term;
      size += Math.abs(term);
      if (i > 0) byX += c * i * xs[i - 1] * ys[j];
      if (j > 0) byY += c * j * xs[i] * ys[j - 1];
    }
  }
  return { value, size, gradient: Math.sqrt(byX * byX + byY * byY) };
}

function zeroPolynomial() {
  return Array.from({ length: 7 }, () => new Array(7).fill(0));
}

// c + x X + y Y + q (x^2 + y^2).
function circlePolynomial(c, x, y, q) {
  const p = zeroPolynomial();
  [p[0][0], p[1][0], p[0][1], p[2][0], p[0][2]] = [c, x, y, q, q];
  return p;
}

function polynomialSum(a, b) {
  return a.map((row, i) => row.map((c, j) => c + b[i][j]));
}

function scaledPolynomial(a, by) {
  return a.map((row) => row.map((c) => c * by));
}

function polynomialProduct(a, b) {
  const product = zeroPolynomial();
  for (let i = 0; i <= 6; i++) {
    for (let j = 0; i + j <= 6; j++) {
      if (a[i][j] === 0) continue;
      for (let k = 0; i + j + k <= 6; k++) {
        for (let l = 0; i + j + k + l <= 6; l++) product[i + k][j + l] += a[i][j] * b[k][l];
      }
    }
  }
  return product;
}
