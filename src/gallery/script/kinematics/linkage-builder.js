// Builds a linkage joint by joint.

import { cosSinOfDegrees } from "./angles.js";
import { greatestDivisor, placeOnLink } from "./linkage.js";
import { sideOf, modeWithSide } from "./assembly-mode.js";

/** A parameter set from which no linkage can be built; the message is a sentence. */
export class LinkageError extends Error {}

/**
 * Builds a linkage: each method adds a joint and returns its index in `joints`. Angles are in degrees, `side`
 * is 1 for left or -1 for right.
 */
export class LinkageBuilder {
  joints = [];
  links = [];
  // Bodies that are known by a joint and a line: { base, link, foot, offset } or { base, link, line, offset,
  // lineIs }.
  carriers = [];
  signs = 0;
  dyads = 0;

  fixed(name, [x, y]) {
    const id = this.#add(name, { kind: "fixed", x, y });
    if (this.links.length === 0) this.links.push([]);
    this.links[0].push({ joint: id, x, y });
    return id;
  }

  crank(name, pivot, length) {
    this.#positive(name, length);
    const id = this.#add(name, { kind: "crank", pivot, length });
    this.#bar(pivot, id, length);
    return id;
  }

  gear(name, pivot, length, ratio, phase) {
    const MOST = 100;
    this.#positive(name, length);
    const isGood = (x) => Number.isInteger(x) && Math.abs(x) >= 1 && Math.abs(x) <= MOST;
    if (!ratio.every(isGood)) {
      const rule = `both must be whole numbers from 1 to ${MOST} or their negatives`;
      throw new LinkageError(`\`${name}\` has the gear ratio ${ratio[0]} to ${ratio[1]}, but ${rule}`);
    }
    const lowest = greatestDivisor(Math.abs(ratio[0]), Math.abs(ratio[1])) * Math.sign(ratio[1]);
    const id = this.#add(name, { kind: "gear", pivot, length, ratio: ratio.map((x) => x / lowest), phase });
    this.#bar(pivot, id, length);
    return id;
  }

  piston(name, base, length, offset, side) {
    this.#two(name, base);
    this.#positive(name, length);
    this.#directedLink(name, base);
    const index = this.#twoValued(name, side);
    const id = this.#add(name, { kind: "piston", base, length, offset, index });
    this.#bar(base[1], id, length);
    // The foot is to the right of the line from pivot to pin, so the pivot is to the left of the actuator's
    // line.
    this.#body([base[0], id], [base[0], id], -offset, "driven");
    return id;
  }

  dyad(name, base, lengths, side) {
    this.#two(name, base);
    for (const length of lengths) this.#positive(name, length);
    // On two joints of one link it is a point of that link, and not two-valued.
    if (this.#commonLink(base)) return this.distances(name, base, lengths, side);
    const index = this.#twoValued(name, side);
    const id = this.#add(name, { kind: "dyad", base, lengths, index });
    this.#bar(base[0], id, lengths[0]);
    this.#bar(base[1], id, lengths[1]);
    return id;
  }

  parallelogram(name, corners) {
    const [first, second, third] = corners;
    this.#two(name, [first, second]);
    this.#two(name, [first, third]);
    const long = this.#directedLink(name, [second, third]);
    const short = this.#commonLink([first, second]) ? this.#directedLink(name, [first, second]) : null;
    const id = this.#add(name, { kind: "parallelogram", corners });
    this.#bar(first, id, apart(long));
    if (short) this.#bar(third, id, apart(short));
    return id;
  }

  slide(name, from, length, line, offset, side) {
    this.#line(name, line);
    this.#positive(name, length);
    const index = this.#twoValued(name, side);
    const id = this.#add(name, { kind: "slide", from, length, line, offset, index });
    this.#bar(from, id, length);
    this.#body([id, line[1]], line, 0, "towards");
    return id;
  }

  yoke(name, from, line, offset, angle) {
    this.#line(name, line);
    const [cos, sin] = cosSinOfDegrees(angle);
    if (sin === 0) throw new LinkageError(`the slot of \`${name}\` is parallel to its guide`);
    const id = this.#add(name, { kind: "yoke", from, line, offset, lean: cos / sin });
    this.#body([id, line[1]], line, 0, "towards");
    return id;
  }

  slot(name, base, offset, side) {
    this.#two(name, base);
    const index = this.#twoValued(name, side);
    const id = this.#add(name, { kind: "slot", base, offset, index });
    if (offset === 0) {
      this.#body(base, base, 0, "turned", index);
      this.links[this.carriers[this.carriers.length - 1].link].push({ joint: id, x: 0, y: 0 });
      return id;
    }
    // With the foot to the right of pivot -> joint, the line points to the left of pivot -> foot.
    this.carriers.push({ base, foot: id, offset: side < 0 ? offset : -offset, link: this.links.length });
    this.#bar(base[0], id, Math.abs(offset));
    return id;
  }

  point(name, base, along, across) {
    const known = this.carriers.filter(
      (carrier) => carrier.base[0] === base[0] && carrier.base[1] === base[1],
    );
    if (known.length > 1) {
      const names = `\`${this.joints[base[0]].name}\` and \`${this.joints[base[1]].name}\``;
      throw new LinkageError(`\`${name}\` is ambiguous: more than one link slides on the line of ${names}`);
    }
    if (known.length === 1) return this.#pointOfCarrier(name, known[0], along, across);
    const found = this.#directedLink(name, base);
    const { link, from, to } = found;
    const span = apart(found);
    const step = { kind: "rigid", base, along: along / span, across: across / span };
    const id = this.#add(name, step);
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const x = from.x + step.along * dx - step.across * dy;
    const y = from.y + step.along * dy + step.across * dx;
    this.links[link].push({ joint: id, x, y });
    return id;
  }

  distances(name, base, d, side) {
    const span = apart(this.#directedLink(name, base));
    const along = ((d[0] - d[1]) * (d[0] + d[1]) + span * span) / (2 * span);
    const across2 = (d[0] - along) * (d[0] + along);
    // Rounding may leave a flat triangle a few units in the last place short of closing.
    const isOpen = across2 < -4 * Number.EPSILON * (d[0] * d[0] + d[1] * d[1]);
    if (isOpen || d.some((x) => !(x >= 0))) {
      throw new LinkageError(
        `\`${name}\` cannot be ${d[0]} from one joint and ${d[1]} from another ${span} away`,
      );
    }
    return this.point(name, base, along, side * Math.sqrt(Math.max(across2, 0)));
  }

  /** Throws unless a link has both of these joints, from which the linkage is to be seen. */
  seenFrom(joints) {
    this.#directedLink("seen_from", joints);
  }

  #pointOfCarrier(name, carrier, along, across) {
    const { base, link, foot, line, offset, lineIs, index } = carrier;
    let step;
    let place = { x: along, y: across };
    if (foot === undefined) {
      // At the start the line points towards the joint, whichever side that is.
      const sense = lineIs === "turned" ? -sideOf(this.signs, index) : 1;
      const by = { along: along * sense, across: across * sense };
      step = { kind: "directed", from: base[0], line, offset, lineIs, index, ...by };
    } else {
      step = { kind: "rigid", base: [base[0], foot], along: -across / offset, across: along / offset };
      place = { x: step.along * Math.abs(offset), y: step.across * Math.abs(offset) };
    }
    const id = this.#add(name, step);
    this.links[link].push({ joint: id, ...place });
    return id;
  }

  #twoValued(name, side) {
    const MOST = 16;
    if (this.dyads === MOST) {
      throw new LinkageError(`\`${name}\` is one dyad too many: a linkage may have at most ${MOST}`);
    }
    this.signs = modeWithSide(this.signs, this.dyads, side);
    return this.dyads++;
  }

  #add(name, step) {
    this.joints.push({ name, step });
    return this.joints.length - 1;
  }

  #bar(from, to, length) {
    this.links.push([
      { joint: from, x: 0, y: 0 },
      { joint: to, x: length, y: 0 },
    ]);
  }

  // A body that keeps the direction of a line.
  #body(base, line, offset, lineIs, index) {
    this.carriers.push({ base, line, offset, lineIs, index, link: this.links.length });
    this.links.push([{ joint: base[0], x: 0, y: 0 }]);
  }

  #positive(name, length) {
    if (!(length > 0 && Number.isFinite(length))) {
      throw new LinkageError(`the length of \`${name}\` must be positive, found ${length}`);
    }
  }

  #two(name, [a, b]) {
    if (a !== b) return;
    const twice = `\`${this.joints[a].name}\``;
    throw new LinkageError(`\`${name}\` is placed from ${twice} and ${twice}, which are the same joint`);
  }

  // Two joints that a line goes through: of one link, they are apart.
  #line(name, line) {
    this.#two(name, line);
    const found = this.#commonLink(line);
    if (found) this.#areApart(name, line, found);
  }

  #areApart(name, base, { from, to }) {
    if (from.x !== to.x || from.y !== to.y) return;
    const names = `\`${this.joints[base[0]].name}\` and \`${this.joints[base[1]].name}\``;
    throw new LinkageError(`\`${name}\` is placed along the line from ${names}, but these coincide`);
  }

  // The link that has both joints, which are apart, and where they are on it.
  #directedLink(name, base) {
    this.#two(name, base);
    const found = this.#commonLink(base);
    if (!found) {
      const [a, b] = base.map((joint) => `\`${this.joints[joint].name}\``);
      throw new LinkageError(`\`${name}\` needs a link with both ${a} and ${b}, but no link has both`);
    }
    this.#areApart(name, base, found);
    return found;
  }

  #commonLink([a, b]) {
    for (let link = 0; link < this.links.length; link++) {
      const [from, to] = [placeOnLink(this.links[link], a), placeOnLink(this.links[link], b)];
      if (from && to) return { link, from, to };
    }
    return null;
  }
}

// How far two places on a link are apart.
function apart({ from, to }) {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  return Math.sqrt(dx * dx + dy * dy);
}
