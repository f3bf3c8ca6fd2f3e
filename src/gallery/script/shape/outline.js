// Outlines: polylines, open or closed, as flat arrays [x0, y0, x1, y1, …] without a repeated first point.

/**
 * The finite points of an outline without repetitions of the point before; of a closed one also without
 * repetitions of the first point at its end.
 */
export function withoutDuplicates(/** @type {Points} */ points, closed) {
  const kept = [];
  for (let k = 0; k + 1 < points.length; k += 2) {
    const [x, y] = [points[k], points[k + 1]];
    const n = kept.length;
    if (Number.isFinite(x) && Number.isFinite(y) && !(n && kept[n - 2] === x && kept[n - 1] === y))
      kept.push(x, y);
  }
  if (closed) {
    while (kept.length > 2 && kept[0] === kept[kept.length - 2] && kept[1] === kept[kept.length - 1])
      kept.length -= 2;
  }
  return Float64Array.from(kept);
}

/** The length of an outline up to each of its points; of a closed one also round to its first. */
export function lengthsAlong(/** @type {Points} */ points, closed) {
  const count = points.length / 2;
  const along = new Float64Array(count + (closed ? 1 : 0));
  for (let k = 1; k < along.length; k += 1) {
    const [a, b] = [2 * (k - 1), 2 * (k % count)];
    const [dx, dy] = [points[b] - points[a], points[b + 1] - points[a + 1]];
    along[k] = along[k - 1] + Math.sqrt(dx * dx + dy * dy);
  }
  return along;
}

/**
 * `count` points spaced evenly along an outline: of an open one with both ends, of a closed one from its
 * first point round. An outline without length gives the same point throughout.
 */
export function resampled(/** @type {Points} */ points, closed, count) {
  const along = lengthsAlong(points, closed);
  const whole = along[along.length - 1];
  const vertices = points.length / 2;
  const out = new Float64Array(2 * count);
  const step = whole / Math.max(closed ? count : count - 1, 1);
  let k = 0;
  for (let n = 0; n < count; n += 1) {
    const s = n * step;
    while (k + 2 < along.length && along[k + 1] < s) k += 1;
    const [a, b] = [2 * k, 2 * ((k + 1) % vertices)];
    const span = along.length > 1 ? along[k + 1] - along[k] : 0;
    const t = span > 0 ? Math.min((s - along[k]) / span, 1) : 0;
    out[2 * n] = points[a] + t * (points[b] - points[a]);
    out[2 * n + 1] = points[a + 1] + t * (points[b + 1] - points[a + 1]);
  }
  return out;
}

/** The length of an outline. @param {Float64Array} points @param {boolean} closed */
export function lengthOf(points, closed) {
  const along = lengthsAlong(points, closed);
  return along[along.length - 1];
}

/** The greatest distance between two points of an outline: its extent, which no turning changes. */
export function extentOf(/** @type {Points} */ points) {
  let greatest = 0;
  // Two hundred points along it miss less than one in ten thousand of the extent of a smooth curve.
  const few = points.length > 400 ? resampled(points, false, 200) : points;
  for (let i = 0; i < few.length; i += 2) {
    for (let k = i + 2; k < few.length; k += 2) {
      const [dx, dy] = [few[i] - few[k], few[i + 1] - few[k + 1]];
      greatest = Math.max(greatest, dx * dx + dy * dy);
    }
  }
  return Math.sqrt(greatest);
}

/**
 * Whether an outline ends so near to its start, within 12 % of its extent, that it is probably meant to be
 * closed.
 */
export function looksClosed(/** @type {Points} */ points) {
  const end = points.length - 2;
  const gap = Math.hypot(points[end] - points[0], points[end + 1] - points[1]);
  return points.length >= 12 && gap <= 0.12 * extentOf(points);
}

/**
 * The portion of an outline between two fractions of its length as `count` even points; on a closed one it may
 * continue over the first point, on an open one it ends at the ends: `from` and `to` are the actual fractions.
 * @param {Float64Array | Float32Array} points @param {boolean} closed
 */
export function portion(points, closed, from, to, count) {
  const along = lengthsAlong(points, closed);
  const whole = along[along.length - 1];
  const vertices = points.length / 2;
  const [a, b] = closed ? [from, to] : [Math.max(from, 0), Math.min(to, 1)];
  const out = new Float64Array(2 * count);
  for (let n = 0; n < count; n += 1) {
    const part = a + ((b - a) * n) / (count - 1);
    const s = whole * (closed ? part - Math.floor(part) : part);
    let [low, high] = [0, along.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (along[middle] <= s) low = middle;
      else high = middle;
    }
    const span = along[high] - along[low];
    const t = span > 0 ? Math.min((s - along[low]) / span, 1) : 0;
    const [p, q] = [2 * low, 2 * (high % vertices)];
    out[2 * n] = points[p] + t * (points[q] - points[p]);
    out[2 * n + 1] = points[p + 1] + t * (points[q + 1] - points[p + 1]);
  }
  return { points: out, from: a, to: b };
}
