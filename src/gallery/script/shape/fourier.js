// Computes the discrete Fourier transform of complex sequences whose length is a power of two.

/**
 * Transforms of one length: `forward(re, im)` and `inverse(re, im)`, both in place; the inverse divides by
 * the length.
 */
export function fourier(length) {
  const bits = Math.log2(length);
  const order = Uint32Array.from({ length }, (_, k) => {
    let turned = 0;
    for (let b = 0; b < bits; b += 1) turned |= ((k >> b) & 1) << (bits - 1 - b);
    return turned;
  });
  const angle = (-2 * Math.PI) / length;
  const cos = Float64Array.from({ length: length / 2 }, (_, k) => Math.cos(angle * k));
  const sin = Float64Array.from({ length: length / 2 }, (_, k) => Math.sin(angle * k));
  const forward = (re, im) => {
    for (let k = 0; k < length; k += 1) {
      const other = order[k];
      if (other > k) {
        [re[k], re[other]] = [re[other], re[k]];
        [im[k], im[other]] = [im[other], im[k]];
      }
    }
    for (let half = 1; half < length; half *= 2) butterflies(re, im, half, cos, sin);
  };
  // Swapping the real and imaginary parts of the input and of the output gives the inverse.
  const inverse = (re, im) => {
    forward(im, re);
    for (let k = 0; k < length; k += 1) {
      re[k] /= length;
      im[k] /= length;
    }
  };
  return { length, forward, inverse };
}

function butterflies(re, im, half, cos, sin) {
  const stride = cos.length / half;
  for (let from = 0; from < re.length; from += 2 * half) {
    for (let k = 0, t = 0; k < half; k += 1, t += stride) {
      const [a, b] = [from + k, from + k + half];
      const x = re[b] * cos[t] - im[b] * sin[t];
      const y = re[b] * sin[t] + im[b] * cos[t];
      re[b] = re[a] - x;
      im[b] = im[a] - y;
      re[a] += x;
      im[a] += y;
    }
  }
}

/**
 * Centres complex samples on their mean and scales them to unit energy, in place; false if they all coincide.
 */
export function normalised(re, im) {
  const count = re.length;
  let [x, y] = [0, 0];
  for (let k = 0; k < count; k += 1) {
    x += re[k] / count;
    y += im[k] / count;
  }
  let energy = 0;
  for (let k = 0; k < count; k += 1) {
    re[k] -= x;
    im[k] -= y;
    energy += re[k] * re[k] + im[k] * im[k];
  }
  const scale = energy > 0 ? 1 / Math.sqrt(energy) : 0;
  for (let k = 0; k < count; k += 1) {
    re[k] *= scale;
    im[k] *= scale;
  }
  return energy > 0;
}
