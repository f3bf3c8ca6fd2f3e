// The text alternative of a plate.

import { measureValue } from "../../data/family.js";
import { formatDecimals, circuitTitle } from "./study.js";
import { formatLength } from "./speed-view.js";

/** A few sentences that describe the drawing. */
export function summaryOfStudy(family, curve, study, isRecorded) {
  const { linkage, routes, shown, mechanism, joint, fourBar } = study;
  const words = [];
  const moving = mechanism.bars.length + mechanism.plates.length;
  const kind = fourBar ? `A four-bar, ${fourBar.class}` : `A linkage of ${moving} moving links`;
  words.push(`${kind}, ${mechanism.fixed.length} fixed pivots, tracing point ${linkage.joints[joint].name}.`);
  words.push(`Its circuit: ${circuitTitle(linkage, routes[shown])}.`);
  const box = study.curveBox;
  words.push(`The curve is ${formatLength(box[2] - box[0])} wide and ${formatLength(box[3] - box[1])} high.`);
  const of = (name) => (isRecorded ? measureValue(family, curve, name) : undefined);
  // A family may be measured only in part.
  if (of("straight_length") && of("straight_deviation") !== undefined) {
    words.push(
      `Its straightest portion is ${formatLength(of("straight_length"))} long, ` +
        `within ${formatLength(of("straight_deviation"))}.`,
    );
  }
  if (of("mu_min_deg") !== undefined && of("mu_max_deg") !== undefined) {
    words.push(
      `Transmission angle from ${formatDecimals(of("mu_min_deg"), 1)} ` +
        `to ${formatDecimals(of("mu_max_deg"), 1)} degrees.`,
    );
  }
  if (!isRecorded) words.push("Its parameters or its circuit differ from the atlas.");
  return words.join(" ");
}
