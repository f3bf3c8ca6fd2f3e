// The plate of a curve, in a browser: node tests/gallery/plate.mjs FOLDER
//
// FOLDER is that of the atlas of atlas.toml. A line for each test, under the number of the promise it keeps;
// ONLY in the environment leaves those whose number begins with it. Exit 1 if one fails.

import { runTests } from "./browser.mjs";
import { EVERYONE } from "./plate-everyone.mjs";
import { HANDS } from "./plate-hands.mjs";
import { PARAMETERS } from "./plate-parameters.mjs";
import { READINGS } from "./plate-readings.mjs";

const [folder] = process.argv.slice(2);

await runTests([...HANDS, ...READINGS, ...PARAMETERS, ...EVERYONE], { folder });
