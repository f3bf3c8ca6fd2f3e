// What the query of a plate's address says: changed parameters, the circuit, and what is switched on.

import { address } from "../../data/address.js";
import { findCurve, curveKey } from "../../data/family.js";
import { OVERLAYS } from "./overlays.js";
import { parseChanges } from "./parameters.js";

/**
 * { changes: Map, requestedCircuit: the place of a circuit among all, or null, on: Set of overlays' names } of a query.
 */
export function readPlateQuery(family, trace, query) {
  const circuit = Number(query.get("circuit"));
  const shown = query.get("show");
  const isOn = (overlay) => (shown === undefined ? overlay.isOn : shown.split(",").includes(overlay.name));
  return {
    changes: parseChanges(family, trace, query),
    requestedCircuit: Number.isInteger(circuit) && circuit > 0 ? circuit - 1 : null,
    on: new Set(OVERLAYS.filter(isOn).map(({ name }) => name)),
  };
}

/** The address of a plate, as short as it can be: what is as it was at first is not said. */
export function plateAddress({ family, curve, changes, requestedCircuit, on, study }) {
  const query = new Map(changes);
  if (requestedCircuit !== null && requestedCircuit !== study?.home)
    query.set("circuit", requestedCircuit + 1);
  const isUsual = OVERLAYS.every(({ name, isOn }) => on.has(name) === isOn);
  if (!isUsual) query.set("show", [...on].join(",") || "nothing");
  return address([family.id, "curve", curveKey(family, curve)], query);
}

/**
 * The name of a curve beyond its family, on the circuit that is shown, with what is changed of it; a circuit
 * that the atlas does not have is named by its number among all: "evans:1.1.1?circuit=2".
 */
export function plateCurveName({ family, curve, changes, study }) {
  const { key, extraCircuit } = keyOfShownCircuit(family, curve, study);
  const words = [...changes].map(([name, value]) => `${encodeURIComponent(name)}=${value}`);
  if (extraCircuit) words.push(`circuit=${extraCircuit}`);
  return `${family.id}:${key}${words.length ? `?${words.join("&")}` : ""}`;
}

/** Whether a plate shows a circuit that the atlas does not have. */
export function isExtraCircuit({ family, curve, study }) {
  return keyOfShownCircuit(family, curve, study).extraCircuit !== null;
}

/** The key of the curve on the circuit that a study shows; its own with a number where there is none. */
function keyOfShownCircuit(family, curve, study) {
  const own = curveKey(family, curve);
  if (!study || study.shown === study.home) return { key: own, extraCircuit: null };
  // Only where the atlas takes all circuits are they numbered as a plate counts them.
  const key = family.template.circuits === "all" ? own.replace(/\d+$/, study.shown + 1) : null;
  return key !== null && findCurve(family, key) !== undefined
    ? { key, extraCircuit: null }
    : { key: own, extraCircuit: study.shown + 1 };
}
