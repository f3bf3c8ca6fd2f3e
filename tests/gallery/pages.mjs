// Tests the gallery's pages in Chromium: the shell, families, contact sheets, pages, and the curve under the
// pointer.
//
//   PLAYWRIGHT_CORE=… CHROMIUM=… [ONLY=1] node tests/gallery/pages.mjs ATLAS LARGE_ATLAS
//
// ATLAS is the folder of the atlas of atlas.toml, LARGE_ATLAS of one family "hrones-nelson" of 7,800 curves
// on 780 pages. Prints a line for each test with its number: 1 browsing, 2 pointing at a curve, 7 accessibility,
// 8 performance. ONLY selects the tests whose number begins with it. Exits with 1 if one fails.

import "./browsing.mjs";
import "./page-zoom.mjs";
import "./curve-hover.mjs";
import "./accessibility.mjs";
import "./performance.mjs";

import { runTests } from "./browser.mjs";
import { TESTS } from "./pages-support.mjs";

await runTests(TESTS);
