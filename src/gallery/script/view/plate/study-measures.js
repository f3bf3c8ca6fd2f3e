// The measures of a study, computed by the page.

import { sampleCircuit, newSampler } from "../../kinematics/sampling.js";
import { measuresOf } from "../../measure/measures.js";

/** The measures { name: value } of a study's curve, with the names of the atlas, sampled as in its family. */
export function measuresOfStudy(family, { linkage, routes, shown, joint }) {
  const circuit = sampleCircuit(linkage, newSampler(family.sampling), routes[shown]);
  return measuresOf(linkage, { circuits: [circuit], shortfall: null }, circuit, joint, {
    straight: family.straight,
  });
}
