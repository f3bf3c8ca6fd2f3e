// The highlighted curve of a page and the readings at the pointer; the rest of the page is dimmed.

import { h, fill } from "./dom.js";
import { solveCurveOrNull } from "./curve-reading.js";
import { formatNumber } from "./labels.js";

// The chord error of the highlighted curve, in pixels.
const HIGHLIGHT_ERROR = 0.1;

/**
 * Highlights at most one curve of a page: the one under the pointer or with the focus, otherwise the selected
 * one.
 */
export class CurveHighlight {
  constructor(page) {
    this.page = page;
    this.reset();
  }

  /** Resets the highlight for another page. */
  reset() {
    [this.selected, this.pointed, this.curve, this.solved, this.at] = [null, null, null, null, null];
    this.solutions = new Map();
    this.page.viewport.classList.remove("dimmed");
    this.page.reading.hidden = true;
  }

  /** Handles a pointer at a position in millimetres, near the curve `found` or none. */
  hover(found, place) {
    if (!found) {
      if (this.pointed !== null) this.leave();
      return;
    }
    this.pointed = found.curve;
    this.highlight(found.curve);
    this.read(place);
  }

  /** Handles focus on a curve's link. */
  focus(curve) {
    this.pointed = curve;
    this.highlight(curve);
    const { box } = this.drawnOf(curve);
    this.page.zoom.reveal(box);
    this.readInput(0, this.solved?.passes[0].from);
  }

  /** Highlights the curve of a link in the panel; the panel keeps its list. */
  preview(curve) {
    this.pointed = curve;
    this.highlight(curve, { updatesPanel: false });
  }

  /**
   * Handles the pointer leaving the curves. The panel keeps its content so that it can be read and its links
   * followed.
   */
  leave() {
    this.pointed = null;
    if (this.selected === null) this.clear();
    else this.highlight(this.selected);
  }

  /** Selects a curve (null: none) and reads it at a position in millimetres. */
  select(curve, place = null) {
    this.selected = curve;
    this.pointed = null;
    if (curve === null) {
      this.clear();
      return;
    }
    this.highlight(curve);
    if (place) this.read(place);
    else this.readInput(0, this.solved?.passes[0].from);
  }

  drawnOf(curve) {
    return this.page.drawn.find((candidate) => candidate.curve === curve);
  }

  highlight(curve, { updatesPanel = true } = {}) {
    if (updatesPanel && this.listed !== curve) {
      this.listed = curve;
      this.page.showPanel(curve);
    }
    if (!updatesPanel) this.listed = null;
    if (this.curve === curve) return;
    this.curve = curve;
    this.at = null;
    this.page.reading.hidden = true;
    this.solved = this.solve(curve);
    this.page.viewport.classList.add("dimmed");
    this.page.overlay.show(this.pathOf(curve));
    this.page.overlay.point(null);
  }

  clear() {
    this.curve = this.solved = this.at = this.listed = null;
    this.page.viewport.classList.remove("dimmed");
    this.page.overlay?.show(null);
    this.page.overlay?.point(null);
    this.page.reading.hidden = true;
  }

  /** The curve solved at the accuracy of the current zoom; null if it cannot be solved. */
  solve(curve) {
    const { view } = this.drawnOf(curve);
    const fineness = Math.max(0, Math.round(Math.log2(this.page.zoom.magnification)));
    const key = `${curve} ${fineness}`;
    if (!this.solutions.has(key)) {
      const tolerance = HIGHLIGHT_ERROR / (2 ** fineness * this.page.zoom.fitScale * view.scale);
      this.solutions.set(key, solveCurveOrNull(this.page.family, curve, tolerance));
    }
    return this.solutions.get(key);
  }

  /** Path data in millimetres of paper. */
  pathOf(curve) {
    const {
      view: { origin, scale },
      points,
      closed,
    } = this.drawnOf(curve);
    const fine = this.solved?.path.points;
    const places = fine
      ? fine.map((at, k) => (k % 2 ? origin[1] - scale * at : origin[0] + scale * at))
      : points;
    let path = "";
    for (let k = 0; k < places.length; k += 2)
      path += `${k ? "L" : "M"}${places[k].toFixed(4)} ${places[k + 1].toFixed(4)}`;
    return closed ? `${path}Z` : path;
  }

  read([x, y]) {
    if (!this.solved) return;
    const {
      view: { origin, scale },
    } = this.drawnOf(this.curve);
    this.at = this.solved.nearTo((x - origin[0]) / scale, (origin[1] - y) / scale);
    this.position();
  }

  readInput(pass, input) {
    if (!this.solved || input === undefined) return;
    this.at = this.solved.atInput(pass, input);
    this.position();
  }

  /** Moves the reading along the curve by an increment of the input, from pass to pass. */
  stepAlong(by) {
    if (!this.solved || !this.at) return;
    const { passes } = this.solved;
    const { isLength } = this.solved;
    let { pass, input } = this.at;
    const whole = Math.abs(passes[pass].to - passes[pass].from);
    input += (isLength ? (by / 360) * whole : by) * Math.sign(passes[pass].to - passes[pass].from);
    const isPast = (end, start) => (input - end) * Math.sign(end - start) > 0;
    if (isPast(passes[pass].to, passes[pass].from)) {
      pass = (pass + 1) % passes.length;
      input = passes[pass].from;
    } else if (isPast(passes[pass].from, passes[pass].to)) {
      pass = (pass + passes.length - 1) % passes.length;
      input = passes[pass].to;
    }
    this.readInput(pass, input);
    this.page.app.announce(
      readingRows(this.at, this.solved)
        .map((row) => row.join(" "))
        .join(", "),
    );
  }

  /** Refines the curve for a changed zoom and moves the reading to its point. */
  updateZoom() {
    if (this.curve === null) return;
    const solved = this.solve(this.curve);
    if (solved !== this.solved) {
      this.solved = solved;
      this.page.overlay.show(this.pathOf(this.curve));
    }
    this.position();
  }

  /** Positions the point and the reading for the current zoom. */
  position() {
    const { page, at } = this;
    if (!at || this.curve === null || !at.place.every(Number.isFinite)) return;
    const {
      view: { origin, scale },
      box,
    } = this.drawnOf(this.curve);
    const [x, y] = [origin[0] + scale * at.place[0], origin[1] - scale * at.place[1]];
    page.overlay.point([x, y], 4 / page.zoom.scale);
    const rows = readingRows(at, this.solved).map(([name, text]) => [h("dt", {}, name), h("dd", {}, text)]);
    fill(page.reading, h("dl", {}, rows));
    const { clientWidth, clientHeight } = page.viewport;
    const [across, down] = [page.zoom.x + page.zoom.scale * x, page.zoom.y + page.zoom.scale * y];
    page.reading.hidden = across < 0 || down < 0 || across > clientWidth || down > clientHeight;
    if (page.reading.hidden) return;
    const { offsetWidth, offsetHeight } = page.reading;
    const left = positionNextTo(across, offsetWidth, clientWidth, 2 * x < box[0] + box[2] - 1);
    const top = positionNextTo(down, offsetHeight, clientHeight, 2 * y < box[1] + box[3]);
    page.reading.style.transform = `translate(${Math.max(left, 0)}px, ${Math.max(top, 0)}px)`;
  }
}

/**
 * The position of a label of a given size next to a point, before or after it as preferred, if there is
 * space.
 */
function positionNextTo(at, size, available, isBefore) {
  const [before, after] = [at - 16 - size, at + 16];
  if (isBefore) return before < 0 ? after : before;
  return after + size > available ? before : after;
}

/** The readings at a point of a curve: [[name, value with unit], …]. */
function readingRows({ input, speed, mu }, { isLength, passes }) {
  return [
    ["input", isLength ? formatNumber(input) : formatInputAngle(input, passes)],
    ["speed", `${formatNumber(speed, 4)} per ${isLength ? "unit" : "rad"}`],
    ...(mu === null || !Number.isFinite(mu) ? [] : [["transmission", `${mu.toFixed(1)}°`]]),
  ];
}

/** Degrees of input; for a full rotation, the end of the period equals its start. */
function formatInputAngle(input, passes) {
  const text = input.toFixed(1);
  const period = Math.abs(passes[0].to - passes[0].from);
  if (passes.length === 1 && period % 360 === 0 && text === period.toFixed(1)) return "0.0°";
  return `${text.replace("-", "−")}°`;
}
