// The measures of a study, as this page reckons them.

import { sampleCircuit, newSampler } from "../../kinematics/sampling.js";
import { measuresOf } from "../../measure/measures.js";

/** { name: value } of a study's curve, under the names of the atlas's, sampled as its family is. */
export function measuresOfStudy(family, { linkage, routes, shown, joint }) {
  const circuit = sampleCircuit(linkage, newSampler(family.sampling), routes[shown]);
  return measuresOf(linkage, { circuits: [circuit], shortfall: null }, circuit, joint, {
    straight: family.straight,
  });
}
