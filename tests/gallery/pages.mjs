// Leafs through the gallery in Chromium: the shell, families, contact sheets, pages, and the curve that is
// pointed at.
//
//   PLAYWRIGHT_CORE=… CHROMIUM=… [ONLY=1] node tests/gallery/pages.mjs ATLAS LARGE_ATLAS
//
// ATLAS is the folder of the atlas of atlas.toml, LARGE_ATLAS of one family "hrones-nelson" of 7,800 curves
// on 780 pages. A line for each test, under the number of the promise it keeps: 1 leafing, 2 pointing at a
// curve, 7 usable by everyone, 8 light. ONLY leaves those whose number begins with it. Exit 1 if one fails.

import "./leafing.mjs";
import "./nearing.mjs";
import "./pointing.mjs";
import "./everyone.mjs";
import "./light.mjs";

import { runTests } from "./browser.mjs";
import { CHECKS } from "./desk.mjs";

await runTests(CHECKS);
