// A filter for numbers: a histogram with two handles to drag, and fields for their values.

import { ANGLE_UNITS } from "../../data/number.js";
import { BINS, binCounts, histogramOf, formatBound } from "../../find/histogram.js";
import { buttonOf, h, s, setAttributes } from "../dom.js";
import { stepsOfKey } from "../keys.js";
import { NumberField } from "../number-field.js";

/** @type {(keyof Bounds)[]} */
const ENDS = ["low", "high"];

/** Calls `changed(filter, isHeld)` with { low, high } or null when a bound is changed, perhaps by a handle that is held. */
export class RangeFilter {
  /** @param {Column} column @param {CurveTable} table @param {Filter | undefined} filter @param {(filter: Bounds | null, isHeld?: boolean) => void} changed */
  constructor(column, table, filter, changed) {
    this.column = column;
    this.changed = changed;
    this.scale = histogramOf(table.numbers(column.name));
    /** @type {Bounds} */ this.filter = filter instanceof Set ? {} : { ...filter };
    const words = column.title;
    this.behind = s("path.behind", { d: histogramBars(this.scale, this.scale.counts) });
    this.front = s("path.front");
    const hidden = { "aria-hidden": "true", focusable: "false" };
    const box = { viewBox: `0 0 ${BINS} 1`, preserveAspectRatio: "none", ...hidden };
    const picture = s("svg.bars", box, this.behind, this.front);
    this.ends = ENDS.map((end) => this.createHandle(end, words));
    this.inputs = ENDS.map((end) => this.createInput(end, words));
    this.track = h("div.track", { onpointerdown: (event) => this.startDrag(event) }, picture, this.ends);
    const attributes = { class: "quiet clear", hidden: true, "aria-label": `Clear ${words}` };
    this.clear = buttonOf("×", () => this.setFilter({}), attributes);
    const log = this.scale.isLog ? h("span.note", " log") : null;
    const title = `${column.name}: ${column.definition}`;
    const [low, high] = this.inputs.map(({ element }) => element);
    this.element = h(
      "fieldset.range",
      h("legend", { title }, words, column.unit ? " °" : "", log),
      this.clear,
      this.track,
      h("div.bounds", low, h("span", { "aria-hidden": "true" }, "–"), high),
    );
    this.render();
  }

  createHandle(/** @type {keyof Bounds} */ end, /** @type {string} */ words) {
    return h("span", {
      class: `end ${end}`,
      role: "slider",
      "aria-valuemin": 0,
      "aria-valuemax": 100,
      tabindex: "0",
      "aria-label": `${words}, ${end === "low" ? "minimum" : "maximum"}`,
      onkeydown: (event) => this.handleKey(event, end),
    });
  }

  createInput(/** @type {keyof Bounds} */ end, /** @type {string} */ words) {
    const units = ANGLE_UNITS[this.column.unit];
    const type = (/** @type {number | undefined} */ value) =>
      this.setFilter({ ...this.filter, [end]: value }, true);
    const settle = () => this.setFilter(this.filter);
    const attributes = {
      "aria-label": `${words}, ${end === "low" ? "at least" : "at most"}`,
      placeholder: formatBound(this.scale[end]),
    };
    return new NumberField(attributes, { units, change: type, empty: () => type(undefined), settle });
  }

  /** Sets the filter, positions the handles and reports the change. @param {Bounds} _ */
  setFilter({ low, high }, isHeld = false) {
    this.filter = { low, high };
    this.render();
    this.changed(low === undefined && high === undefined ? null : { low, high }, isHeld);
  }

  render() {
    const { scale, filter, ends, inputs } = this;
    const places = [
      filter.low === undefined ? 0 : scale.placeOf(filter.low),
      filter.high === undefined ? 1 : scale.placeOf(filter.high),
    ];
    ENDS.forEach((end, k) => {
      const value = filter[end] ?? scale[end];
      ends[k].style.left = `${100 * places[k]}%`;
      const now = Math.round(100 * places[k]);
      setAttributes(ends[k], { "aria-valuenow": now, "aria-valuetext": formatBound(value) });
      inputs[k].show(filter[end]);
    });
    this.track.style.setProperty("--from", String(places[0]));
    this.track.style.setProperty("--to", String(places[1]));
    this.clear.hidden = filter.low === undefined && filter.high === undefined;
    this.element.classList.toggle("set", !this.clear.hidden);
  }

  /** Draws the number of remaining rows in each bin. @param {Uint32Array} rows */
  show(rows) {
    this.front.setAttribute("d", histogramBars(this.scale, binCounts(this.scale, rows)));
  }

  moveEnd(/** @type {number} */ place, /** @type {keyof Bounds} */ end, isHeld = false) {
    const other = end === "low" ? this.filter.high : this.filter.low;
    const isOpen = end === "low" ? place <= 0 : place >= 1;
    let value = isOpen ? undefined : Number(formatBound(this.scale.valueAt(place)));
    if (value !== undefined && other !== undefined)
      value = end === "low" ? Math.min(value, other) : Math.max(value, other);
    this.setFilter({ ...this.filter, [end]: value }, isHeld);
  }

  startDrag(/** @type {PointerEvent} */ event) {
    const { left, width } = this.track.getBoundingClientRect();
    const placeOf = (/** @type {PointerEvent} */ { clientX }) =>
      Math.min(Math.max((clientX - left) / width, 0), 1);
    const at = placeOf(event);
    const distance = (/** @type {number} */ k) => Math.abs(at - parseFloat(this.ends[k].style.left) / 100);
    const [low, high] = [distance(0), distance(1)];
    const end = low < high || (low === high && at < 0.5) ? "low" : "high";
    event.preventDefault();
    this.ends[end === "low" ? 0 : 1].focus();
    this.track.setPointerCapture(event.pointerId);
    const move = (/** @type {PointerEvent} */ moved) => this.moveEnd(placeOf(moved), end, true);
    move(event);
    this.track.onpointermove = move;
    this.track.onlostpointercapture = () => {
      this.track.onpointermove = null;
      this.setFilter(this.filter);
    };
  }

  handleKey(/** @type {KeyboardEvent} */ event, /** @type {keyof Bounds} */ end) {
    const bound = this.filter[end];
    const now = bound === undefined ? (end === "low" ? 0 : 1) : this.scale.placeOf(bound);
    const to = { Home: 0, End: 1 }[event.key] ?? now + (stepsOfKey(event, 8) ?? NaN) / 100;
    if (Number.isNaN(to)) return;
    event.preventDefault();
    this.moveEnd(Math.min(Math.max(to, 0), 1), end);
  }
}

/** Bars of counts in a box of BINS × 1; small bars have a minimum height. */
function histogramBars(/** @type {Histogram} */ scale, /** @type {Uint32Array} */ counts) {
  const highest = Math.max(...scale.counts, 1);
  let path = "";
  counts.forEach((count, k) => {
    if (count) path += `M${k + 0.08} 1v${-(0.03 + 0.97 * (count / highest)).toFixed(4)}h.84V1z`;
  });
  return path;
}
