// The query of a plate's address: changed parameters, the circuit, the overlays, and the input.

import { curveAddress, parameterWord } from "../../data/address.js";
import { findCurve, curveKey } from "../../data/family.js";
import { STILL } from "./figure.js";
import { OVERLAYS } from "./overlays.js";
import { QUANTITIES } from "./motion-view.js";
import { changeableNames, parseChanges } from "./parameters.js";

/**
 * Parses the query of a curve with a movable traced point or null; `requestedCircuit` is the index of a circuit among all, or null, `on`
 * are the names of overlays; `locked` are the names that handles leave; `at` is the input, "63.5", perhaps with the number of its pass,
 * "63.5,2".
 * @param {Family} family @param {MovablePoint | null} point @param {AddressQuery} query @returns {PlateState}
 */
export function readPlateQuery(family, point, query) {
  const circuit = query.number("circuit", 1);
  const [input, pass = 1] = (query.get("at") || "?").split(",").map(Number);
  const hasPlace = Number.isFinite(input) && pass >= 1;
  if (query.get("at") && !hasPlace) query.ignore("at", "not an input");
  const shown = query.list(
    "show",
    (word) => word === "nothing" || OVERLAYS.some(({ name }) => name === word),
  );
  /** @param {typeof OVERLAYS[number]} overlay */
  const isOn = (overlay) => (shown ? shown.includes(overlay.name) : overlay.isOn);
  const isName = (/** @type {string} */ name) => changeableNames(family, point).includes(name);
  return {
    changes: parseChanges(family, point, query),
    requestedCircuit: circuit === undefined ? null : Math.floor(circuit) - 1,
    on: new Set(OVERLAYS.filter(isOn).map(({ name }) => name)),
    motion: {
      joint: query.get("joint") || STILL.joint,
      graph: query.word("graph", Object.keys(QUANTITIES)) ?? STILL.graph,
      rpm: query.number("rpm") ?? STILL.rpm,
      load: query.get("load") || STILL.load,
    },
    locked: new Set(query.list("lock", isName)),
    at: hasPlace ? { input, pass: Math.floor(pass) - 1 } : null,
  };
}

/** Says what of an address the linkage does not have, which is known when it has been solved. @param {AddressQuery} query */
export function ignoreUnused(query, /** @type {Plate} */ { study, reason, state, drive: { place } }) {
  const { requestedCircuit: circuit, at, motion } = state;
  if (!study || reason) return;
  if (circuit !== null && circuit !== study.shown) query.ignore("circuit", `of ${study.circuits.length}`);
  if (motion.joint !== null && !study.joints.includes(motion.joint)) query.ignore("joint", "unknown");
  if (at && (at.pass !== place.pass || Math.abs(at.input - place.input) > 1e-6))
    query.ignore("at", "outside of the circuit");
}

/** A set with a member, or without it. @param {Set<string>} set @param {string} member @param {boolean} isIn */
export function withMember(set, member, isIn) {
  const others = [...set].filter((one) => one !== member);
  return new Set(isIn ? [...others, member] : others);
}

/** The shortest address of a plate in a state; defaults are left out. @param {Plate} _ @param {PlateState} state */
export function plateAddress({ family, curve, study }, state) {
  const { changes, requestedCircuit, on, at, locked, motion } = state;
  const query = new Map([...changes].map(([name, value]) => [parameterWord(name), String(value)]));
  if (requestedCircuit !== null && requestedCircuit !== study?.home)
    query.set("circuit", String(requestedCircuit + 1));
  const isUsual = OVERLAYS.every(({ name, isOn }) => on.has(name) === isOn);
  if (!isUsual) query.set("show", [...on].join(",") || "nothing");
  for (const name of /** @type {(keyof MotionState)[]} */ (Object.keys(motion)))
    if (motion[name] !== null && motion[name] !== STILL[name]) query.set(name, String(motion[name]));
  if (locked.size) query.set("lock", [...locked].join(","));
  if (at) query.set("at", `${Number(at.input.toPrecision(10))}${at.pass > 0 ? `,${at.pass + 1}` : ""}`);
  return curveAddress(family.id, curveKey(family, curve), query);
}

/**
 * The name of the curve on the shown circuit, with its family and changes. A circuit that the atlas does not
 * contain is given by its number among all: "evans:1.1.1?circuit=2".
 */
export function plateCurveName(/** @type {Plate} */ plate) {
  const { family, changes } = plate;
  const { key, extraCircuit } = keyOfShownCircuit(plate);
  const words = [...changes].map(([name, value]) => `${encodeURIComponent(name)}=${value}`);
  if (extraCircuit) words.push(`circuit=${extraCircuit}`);
  return `${family.id}:${key}${words.length ? `?${words.join("&")}` : ""}`;
}

/** Whether a plate shows a circuit that the atlas does not contain. @param {Plate} plate */
export function isExtraCircuit(plate) {
  return keyOfShownCircuit(plate).extraCircuit !== null;
}

/** The key of the curve on the shown circuit; if the atlas does not contain it, the curve's own key and the circuit's number. */
function keyOfShownCircuit(/** @type {Plate} */ { family, curve, study, description }) {
  const own = curveKey(family, curve);
  if (!study || study.shown === study.home) return { key: own, extraCircuit: null };
  // The atlas numbers circuits as a plate does only if it contains all circuits.
  const key = description.has_all_circuits ? own.replace(/\d+$/, String(study.shown + 1)) : null;
  return key !== null && findCurve(family, key) !== undefined
    ? { key, extraCircuit: null }
    : { key: own, extraCircuit: study.shown + 1 };
}
