// The keyboard commands of a plate, active unless a field has the focus.

import { address } from "../../data/address.js";
import { curveKey } from "../../data/family.js";
import { stepByKey } from "./transport.js";

/** Listens for keys until `leave()`. */
export class PlateKeys {
  constructor(plate) {
    this.listener = (event) => handlePlateKey(plate, event);
    window.addEventListener("keydown", this.listener);
  }

  leave() {
    window.removeEventListener("keydown", this.listener);
  }
}

function handlePlateKey(plate, event) {
  const { drive, stage } = plate;
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
  const { target } = event;
  const isField = target.matches?.("input:not([type=range]):not([type=checkbox]), select, textarea");
  if (isField) return;
  const isPressed = target.matches?.("button, a, summary, input[type=checkbox]");
  if (event.key === " " && !isPressed) drive.toggle();
  else if (event.key === "0") stage.fit();
  else if (event.key === "+" || event.key === "=") stage.zoom(1.3);
  else if (event.key === "-") stage.zoom(1 / 1.3);
  else if (event.key === "[" || event.key === "]") goToNeighbour(plate, event.key === "]" ? 1 : -1);
  else if (target.matches?.("input[type=range], select")) return;
  else if (/^Arrow(Left|Right)$/.test(event.key)) {
    stepByKey(event, drive);
    return;
  } else return;
  event.preventDefault();
}

/** The address of the previous (-1) or next (1) curve of a family; null at the ends. */
export function neighbourAddress(family, curve, way) {
  const next = curve + way;
  return next >= 0 && next < family.curves.count
    ? address([family.id, "curve", curveKey(family, next)])
    : null;
}

function goToNeighbour({ app, family, curve }, way) {
  const next = neighbourAddress(family, curve, way);
  if (next) app.go(next);
}
