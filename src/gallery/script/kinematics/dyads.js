// Places one joint at many inputs, in columns. Each function takes positions of earlier joints as { x, y }
// columns and writes x[i], y[i] for `first` up to, not with, `last`. `mode` is what a dyad's height is
// multiplied by: 1 to the left of its base, -1 to the right, 0 where it lies flat. A dyad whose base is too
// long or too short is placed flat.

/** On a crank about `pivot`. */
export function placeCrank(pivot, length, cos, sin, x, y, first, last) {
  const { x: ox, y: oy } = pivot;
  for (let i = first; i < last; i++) {
    x[i] = ox[i] + length * cos[i];
    y[i] = oy[i] + length * sin[i];
  }
}

/**
 * The RRR dyad. The height's root is factored: the factors lose no digits where the dyad is nearly flat
 * (Natesan 5.7-5.10).
 */
export function placeDyad(p, q, [l0, l1], mode, x, y, first, last) {
  const { x: px, y: py } = p;
  const { x: qx, y: qy } = q;
  const sum = l0 + l1;
  const difference = l0 - l1;
  for (let i = first; i < last; i++) {
    const dx = qx[i] - px[i];
    const dy = qy[i] - py[i];
    const d2 = dx * dx + dy * dy;
    const d = Math.sqrt(d2);
    const discriminant = (sum - d) * (sum + d) * ((d - difference) * (d + difference));
    const half = 0.5 / d2;
    const along = (d2 + sum * difference) * half;
    const across = mode * (Math.sqrt(discriminant > 0 ? discriminant : 0) * half);
    x[i] = px[i] + along * dx - across * dy;
    y[i] = py[i] + along * dy + across * dx;
  }
}

/** On a crank driven by an actuator: an RRR dyad whose first link is sqrt(s^2 + e^2) long (McCarthy 2.40). */
export function placePiston(p, q, at, length, offset, mode, x, y, first, last) {
  for (let i = first; i < last; i++) {
    const b = Math.sqrt(at[i] * at[i] + offset * offset);
    placeDyad(p, q, [b, length], mode, x, y, i, i + 1);
  }
}

/**
 * The RRP dyad: as far off the line as that is from `a`, whose distance to its left is h, and
 * sqrt((l-h)(l+h)) along.
 */
export function placeSlide(a, length, p, q, offset, mode, x, y, first, last) {
  const { x: ax, y: ay } = a;
  const { x: px, y: py } = p;
  const { x: qx, y: qy } = q;
  for (let i = first; i < last; i++) {
    const dx = qx[i] - px[i];
    const dy = qy[i] - py[i];
    const d = Math.sqrt(dx * dx + dy * dy);
    const ux = dx / d;
    const uy = dy / d;
    const h = offset - (ux * (ay[i] - py[i]) - uy * (ax[i] - px[i]));
    const square = (length - h) * (length + h);
    const along = mode * Math.sqrt(square > 0 ? square : 0);
    x[i] = ax[i] + along * ux - h * uy;
    y[i] = ay[i] + along * uy + h * ux;
  }
}

/**
 * The RPR dyad: pivot, foot and joint are a right triangle with the base for hypotenuse (McCarthy 2.40-2.42).
 */
export function placeSlot(p, q, offset, mode, x, y, first, last) {
  const { x: px, y: py } = p;
  const { x: qx, y: qy } = q;
  for (let i = first; i < last; i++) {
    const dx = qx[i] - px[i];
    const dy = qy[i] - py[i];
    const d2 = dx * dx + dy * dy;
    const d = Math.sqrt(d2);
    const square = (d - offset) * (d + offset);
    const along = (offset * offset) / d2;
    const across = mode * ((offset * Math.sqrt(square > 0 ? square : 0)) / d2);
    x[i] = px[i] + along * dx - across * dy;
    y[i] = py[i] + along * dy + across * dx;
  }
}

/**
 * The RPP dyad: as far along the guide as the joint in the slot, less what the slot leans over up to there.
 */
export function placeYoke(a, p, q, offset, lean, x, y, first, last) {
  const { x: ax, y: ay } = a;
  const { x: px, y: py } = p;
  const { x: qx, y: qy } = q;
  for (let i = first; i < last; i++) {
    const dx = qx[i] - px[i];
    const dy = qy[i] - py[i];
    const d = Math.sqrt(dx * dx + dy * dy);
    const ux = dx / d;
    const uy = dy / d;
    const vx = ax[i] - px[i];
    const vy = ay[i] - py[i];
    const along = ux * vx + uy * vy - lean * (ux * vy - uy * vx - offset);
    x[i] = px[i] + along * ux - offset * uy;
    y[i] = py[i] + along * uy + offset * ux;
  }
}

/**
 * A point of a body aligned with a line. The line goes through q and past p at an offset: its direction is
 * that from p to q, turned to the right by the angle whose sine is offset / d. `known` has how far along it q
 * is, where that is known.
 */
export function placeAligned(a, p, q, offset, known, along, across, x, y, first, last) {
  const { x: ax, y: ay } = a;
  const { x: px, y: py } = p;
  const { x: qx, y: qy } = q;
  for (let i = first; i < last; i++) {
    const dx = qx[i] - px[i];
    const dy = qy[i] - py[i];
    const d2 = dx * dx + dy * dy;
    const d = Math.sqrt(d2);
    const square = (d - offset) * (d + offset);
    const s = known ? known[i] : Math.sqrt(square > 0 ? square : 0);
    const forward = (along * s + across * offset) / d2;
    const left = (across * s - along * offset) / d2;
    x[i] = ax[i] + forward * dx - left * dy;
    y[i] = ay[i] + forward * dy + left * dx;
  }
}

/** The fourth corner of a parallelogram. */
export function placeParallelogram(p, q, r, x, y, first, last) {
  for (let i = first; i < last; i++) {
    x[i] = p.x[i] + (r.x[i] - q.x[i]);
    y[i] = p.y[i] + (r.y[i] - q.y[i]);
  }
}

/** A point of a link, in parts of the distance of two others. */
export function placeRigid(p, q, along, across, x, y, first, last) {
  const { x: px, y: py } = p;
  const { x: qx, y: qy } = q;
  for (let i = first; i < last; i++) {
    const dx = qx[i] - px[i];
    const dy = qy[i] - py[i];
    x[i] = px[i] + along * dx - across * dy;
    y[i] = py[i] + along * dy + across * dx;
  }
}
