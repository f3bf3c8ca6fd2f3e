// Tests the plate of a curve in a browser: node tests/gallery/plate.mjs FOLDER
//
// FOLDER is that of the atlas of atlas.toml. Prints a line for each test with its number; ONLY in the
// environment selects the tests whose number begins with it. Exits with 1 if one fails.

import { runTests } from "./browser.mjs";
import { ACCESSIBILITY } from "./plate-accessibility.mjs";
import { HANDLES } from "./plate-handles.mjs";
import { KERNEL } from "./plate-kernel.mjs";
import { MOTION } from "./plate-motion.mjs";
import { MOVEMENT } from "./plate-movement.mjs";
import { NEW_PLATES } from "./new-plates.mjs";
import { PARAMETERS } from "./plate-parameters.mjs";
import { READINGS } from "./plate-readings.mjs";
import { STATE } from "./plate-state.mjs";

const [folder] = process.argv.slice(2);

await runTests(
  [
    ...MOTION,
    ...READINGS,
    ...PARAMETERS,
    ...ACCESSIBILITY,
    ...KERNEL,
    ...STATE,
    ...HANDLES,
    ...MOVEMENT,
    ...NEW_PLATES,
  ],
  {
    folder,
  },
);
