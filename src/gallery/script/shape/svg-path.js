// Converts SVG path data to polylines.

const CHORDS_PER_CURVE = 24;

/**
 * The subpaths of path data (M L H V C S Q T A Z, absolute and relative), [{ points: flat array, closed }], y
 * down as in SVG; curves in 24 chords. Everything after an error is ignored, as in SVG.
 */
export function subpathsOf(data) {
  const pen = new Pen();
  for (const [, letter, rest] of data.matchAll(/([mlhvcsqtaz])([^mlhvcsqtaz]*)/gi)) {
    const numbers = letter.toLowerCase() === "a" ? arcNumbers(rest) : numbersOf(rest);
    if (!pen.drawCommand(letter, numbers)) break;
  }
  return pen.outlines();
}

function numbersOf(text) {
  return (text.match(/[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?/gi) ?? []).map(Number);
}

/** The numbers of arcs, whose flags need no separator. */
function arcNumbers(text) {
  const number = "([+-]?(?:\\d+\\.?\\d*|\\.\\d+)(?:e[+-]?\\d+)?)[\\s,]*";
  const arc = new RegExp(`${number}${number}${number}([01])[\\s,]*([01])[\\s,]*${number}${number}`, "gi");
  return [...text.matchAll(arc)].flatMap((match) => match.slice(1).map(Number));
}

const PARAMETERS = { m: 2, l: 2, h: 1, v: 1, c: 6, s: 4, q: 4, t: 2, a: 7, z: 0 };

class Pen {
  /** @type {{ points: number[], closed: boolean }[]} */ paths = [];
  x = 0;
  y = 0;
  startX = 0;
  startY = 0;
  /** The last control point, and the kind of its command. @type {{ kind: string, x: number, y: number } | null} */
  control = null;

  outlines() {
    return this.paths
      .filter(({ points }) => points.length >= 4)
      .map(({ points, closed }) => ({ points: Float64Array.from(points), closed }));
  }

  /** Draws a command, repeated while its numbers suffice; false if they do not suffice for the first. */
  drawCommand(letter, numbers) {
    const kind = letter.toLowerCase();
    const isRelative = letter === kind;
    const width = PARAMETERS[kind];
    if (!this.paths.length && kind !== "m") return false;
    if (kind === "z") return this.closePath();
    if (numbers.length < width) return false;
    for (let k = 0; k + width <= numbers.length; k += width) {
      const given = numbers.slice(k, k + width);
      const at = isRelative ? [this.x, this.y] : [0, 0];
      if (kind === "a") this.arc(given, at);
      else if (kind === "m" && k === 0) this.moveTo(given[0] + at[0], given[1] + at[1]);
      else this.drawSegment(kind, given, at);
    }
    return true;
  }

  moveTo(x, y) {
    this.paths.push({ points: [x, y], closed: false });
    [this.x, this.y, this.startX, this.startY, this.control] = [x, y, x, y, null];
  }

  closePath() {
    this.paths[this.paths.length - 1].closed = true;
    [this.x, this.y, this.control] = [this.startX, this.startY, null];
    return true;
  }

  lineTo(x, y) {
    // After Z a new subpath starts where the last one started.
    if (this.paths.at(-1)?.closed) this.paths.push({ points: [this.x, this.y], closed: false });
    this.paths.at(-1)?.points.push(x, y);
    [this.x, this.y] = [x, y];
  }

  drawSegment(kind, given, /** @type {number[]} */ [ax, ay]) {
    const points = given.map((value, k) => value + (k % 2 ? ay : ax));
    if (kind === "c") this.bezier(points, "cubic");
    else if (kind === "s") this.bezier([...this.reflected("cubic"), ...points], "cubic");
    else if (kind === "q") this.bezier(points, "quadratic");
    else if (kind === "t") this.bezier([...this.reflected("quadratic"), ...points], "quadratic");
    else {
      if (kind === "h") this.lineTo(given[0] + ax, this.y);
      else if (kind === "v") this.lineTo(this.x, given[0] + ay);
      else this.lineTo(points[0], points[1]);
      this.control = null;
    }
  }

  /** The last control point reflected at the current point, if the command before was of this kind. */
  reflected(kind) {
    if (!this.control || this.control.kind !== kind) return [this.x, this.y];
    return [2 * this.x - this.control.x, 2 * this.y - this.control.y];
  }

  bezier(points, kind) {
    const whole = [this.x, this.y, ...points];
    for (let n = 1; n <= CHORDS_PER_CURVE; n += 1) this.lineTo(...casteljau(whole, n / CHORDS_PER_CURVE));
    const at = points.length - 4;
    this.control = { kind, x: points[at], y: points[at + 1] };
  }

  /** An elliptical arc by its ends (SVG 1.1, appendix F.6). */
  arc([rx, ry, turn, large, sweep, endX, endY], /** @type {number[]} */ [ax, ay]) {
    const [x, y] = [endX + ax, endY + ay];
    const arc = arcCentre([this.x, this.y], [x, y], rx, ry, turn, large, sweep);
    const { a, b, cx, cy, from, across, cos, sin } = arc;
    this.control = null;
    if (!(a > 0 && b > 0)) {
      this.lineTo(x, y);
      return;
    }
    for (let n = 1; n < CHORDS_PER_CURVE; n += 1) {
      const angle = from + (across * n) / CHORDS_PER_CURVE;
      const [u, v] = [a * Math.cos(angle), b * Math.sin(angle)];
      this.lineTo(cx + cos * u - sin * v, cy + sin * u + cos * v);
    }
    this.lineTo(x, y);
  }
}

/** The point of a Bézier curve by its control points, flat. @returns {[x: number, y: number]} */
function casteljau(points, t) {
  let now = points;
  while (now.length > 2) {
    const next = [];
    for (let k = 0; k + 2 < now.length; k += 1) next.push(now[k] + t * (now[k + 2] - now[k]));
    now = next;
  }
  return [now[0], now[1]];
}

function arcCentre([x0, y0], [x1, y1], rx, ry, turn, large, sweep) {
  const angle = (turn * Math.PI) / 180;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [dx, dy] = [(x0 - x1) / 2, (y0 - y1) / 2];
  const [u, v] = [cos * dx + sin * dy, cos * dy - sin * dx];
  let [a, b] = [Math.abs(rx), Math.abs(ry)];
  const reach = (u * u) / (a * a) + (v * v) / (b * b);
  if (reach > 1) [a, b] = [a * Math.sqrt(reach), b * Math.sqrt(reach)];
  const over = a * a * v * v + b * b * u * u;
  const root = over > 0 ? Math.sqrt(Math.max((a * a * b * b) / over - 1, 0)) * (large === sweep ? -1 : 1) : 0;
  const [p, q] = [(root * a * v) / b, (-root * b * u) / a];
  const from = Math.atan2((v - q) / b, (u - p) / a);
  let across = Math.atan2((-v - q) / b, (-u - p) / a) - from;
  if (sweep && across < 0) across += 2 * Math.PI;
  if (!sweep && across > 0) across -= 2 * Math.PI;
  const [cx, cy] = [cos * p - sin * q + (x0 + x1) / 2, sin * p + cos * q + (y0 + y1) / 2];
  return { a, b, cx, cy, from, across, cos, sin };
}
