// The highlighted curve of a page and the readings at the pointer; the rest of the page is dimmed.

import { curvePoints } from "../data/family.js";
import { placedData } from "../draw/path-data.js";
import { fill, termList } from "./dom.js";
import { readingRows, solveCurve } from "./curve-reading.js";
import { stepPlace } from "./plate/timeline.js";

// The chord error of the highlighted curve, in pixels.
const HIGHLIGHT_ERROR = 0.1;
// The number of curves that are kept solved.
const MAX_SOLVED = 8;

/** Highlights at most one curve of a page: that under the pointer or with the focus, or the selected one. */
export class CurveHighlight {
  /** @type {number | null} */ selected = null;
  /** The curve under the pointer or with the focus. @type {number | null} */ pointed = null;
  /** The highlighted curve. @type {number | null} */ curve = null;
  /** The curve in the panel. @type {number | null} */ listed = null;
  /** @type {SolvedCurve | null} */ solved = null;
  /** @type {Reading | null} */ at = null;
  /** Where the pointer reads the curve, in millimetres. @type {Point | null} */ place = null;
  fineness = 0;
  /** Curves that are kept solved, the oldest first. @type {Map<number, SolvedCurve | null>} */
  solutions = new Map();

  constructor(/** @type {PageView} */ page) {
    this.page = page;
    this.reset();
  }

  /** Resets the highlight for another page. */
  reset() {
    this.selected = this.pointed = null;
    for (const solved of this.solutions.values()) solved?.close();
    this.solutions.clear();
    this.clear();
  }

  /** Handles a pointer at a position in millimetres, near the curve `found` or none. */
  hover(/** @type {DrawnCurve | undefined} */ found, /** @type {Point} */ place) {
    if (!found) {
      if (this.pointed !== null) this.leave();
      return;
    }
    this.pointed = found.curve;
    this.highlight(found.curve);
    this.read(place);
  }

  /** Handles focus on a curve's link. */
  focus(/** @type {number} */ curve) {
    this.pointed = curve;
    this.highlight(curve);
    const { box } = this.drawnOf(curve);
    this.page.zoom.reveal(box);
    this.read(null);
  }

  /** Highlights the curve of a link in the panel; the panel keeps its list. */
  preview(/** @type {number} */ curve) {
    this.pointed = curve;
    this.highlight(curve, { updatesPanel: false });
  }

  /** Handles the pointer leaving the curves. The panel keeps its content so that it can be read and its links followed. */
  leave() {
    this.pointed = null;
    if (this.selected === null) this.clear();
    else this.highlight(this.selected);
  }

  /** Selects a curve (null: none) and reads it at a position in millimetres. @param {Point | null} [place] */
  select(/** @type {number | null} */ curve, place = null) {
    this.selected = curve;
    this.pointed = null;
    if (curve === null) {
      this.clear();
      return;
    }
    this.highlight(curve);
    this.read(place);
  }

  drawnOf(/** @type {number | null} */ curve) {
    const drawn = this.page.drawn.find((candidate) => candidate.curve === curve);
    if (!drawn) throw new Error("the curve is not on this page");
    return drawn;
  }

  highlight(/** @type {number} */ curve, { updatesPanel = true } = {}) {
    if (updatesPanel && this.listed !== curve) this.page.showPanel(curve);
    this.listed = updatesPanel ? curve : null;
    if (this.curve !== curve) this.#outline(curve);
  }

  #outline(/** @type {number} */ curve) {
    this.curve = curve;
    this.at = null;
    this.page.reading.hidden = true;
    this.solved = this.solve(curve);
    this.page.viewport.classList.add("dimmed");
    this.page.overlay?.show(this.pathOf(curve));
    this.page.overlay?.point(null);
  }

  clear() {
    this.curve = this.solved = this.at = this.listed = null;
    this.page.viewport.classList.remove("dimmed");
    this.page.overlay?.show(null);
    this.page.overlay?.point(null);
    this.page.reading.hidden = true;
  }

  /** The curve solved; null if it cannot be, or while the kernel is loaded. */
  solve(/** @type {number} */ curve) {
    const { app, family } = this.page;
    const { kernel } = app.kernel;
    if (!kernel) {
      this.#solveWhenLoaded();
      return null;
    }
    const known = this.solutions.get(curve);
    if (known !== undefined) return known;
    if (this.solutions.size >= MAX_SOLVED) {
      const [[oldest, dropped]] = this.solutions;
      dropped?.close();
      this.solutions.delete(oldest);
    }
    const solved = solveCurve(kernel, kernel.curve(family, curve));
    this.solutions.set(curve, solved);
    return solved;
  }

  // Outlines and reads again what is highlighted when the kernel is loaded.
  #solveWhenLoaded() {
    const again = () => {
      const { curve, place } = this;
      if (curve === null || this.solved) return;
      this.#outline(curve);
      this.read(place);
    };
    this.page.app.kernel.load().then(again, () => {});
  }

  /** Path data in millimetres of paper. */
  pathOf(/** @type {number} */ curve) {
    const { view, closed } = this.drawnOf(curve);
    const [x, y] = view.origin;
    const { scale } = view;
    this.fineness = this.#zoomLevel();
    const tolerance = HIGHLIGHT_ERROR / (2 ** this.fineness * this.page.zoom.fitScale * scale);
    const points = this.solved?.path(tolerance) ?? curvePoints(this.page.family, curve);
    return placedData(points, closed, { scale, x, y }, 4);
  }

  // The power of two of the zoom, by which the outline is refined.
  #zoomLevel() {
    return Math.max(0, Math.round(Math.log2(this.page.zoom.magnification)));
  }

  /** Reads the highlighted curve at a position in millimetres, or at its start: null. */
  read(/** @type {Point | null} */ place) {
    this.place = place;
    if (!this.solved) return;
    if (!place) return this.readInput(0, this.solved.passes[0].from);
    const [x, y] = place;
    const { origin, scale } = this.drawnOf(this.curve).view;
    this.at = this.solved.nearTo((x - origin[0]) / scale, (origin[1] - y) / scale);
    this.position();
  }

  readInput(/** @type {number} */ pass, /** @type {number} */ input) {
    this.place = null;
    if (!this.solved) return;
    this.at = this.solved.atInput(pass, input);
    this.position();
  }

  /** Moves the reading along the curve by an increment of the input, from pass to pass. */
  stepAlong(/** @type {number} */ by) {
    if (!this.solved || !this.at) return;
    const { timeline, isLength } = this.solved;
    const { pass, input } = this.at;
    const place = { pass, input };
    stepPlace(timeline, place, isLength ? (by / 360) * timeline.whole : by);
    this.readInput(place.pass, place.input);
    const rows = readingRows(this.at, this.solved);
    this.page.app.announce(rows.map((row) => row.join(" ")).join(", "));
  }

  /** Refines the curve for a changed zoom and moves the reading to its point. */
  updateZoom() {
    if (this.curve === null) return;
    if (this.fineness !== this.#zoomLevel()) this.page.overlay?.show(this.pathOf(this.curve));
    this.position();
  }

  /** Positions the point and the reading for the current zoom. */
  position() {
    const { page, at } = this;
    if (!at || !this.solved || this.curve === null || !at.place.every(Number.isFinite)) return;
    const { view, box } = this.drawnOf(this.curve);
    const { origin, scale } = view;
    const [x, y] = [origin[0] + scale * at.place[0], origin[1] - scale * at.place[1]];
    page.overlay?.point([x, y], 4 / page.zoom.scale);
    fill(page.reading, termList("dl", readingRows(at, this.solved)));
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
 * The position of a label of a given size next to a point, before or after it as preferred, if there is space.
 * @param {number} at @param {number} size @param {number} available @param {boolean} isBefore
 */
function positionNextTo(at, size, available, isBefore) {
  const [before, after] = [at - 16 - size, at + 16];
  if (isBefore) return before < 0 ? after : before;
  return after + size > available ? before : after;
}
