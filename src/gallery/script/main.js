// The entry point of the gallery.

import { openAtlas } from "./data/atlas.js";
import { KernelLoader } from "./kernel/kernel.js";
import { elementIn } from "./view/dom.js";
import { tabPins } from "./view/pins.js";
import { openShell } from "./view/shell.js";
import { findRoute } from "./view/find/find-view.js";
import { shapeRoute } from "./view/shape/shape-view.js";
import { compareRoute } from "./view/compare/compare-view.js";
import { overviewRoute } from "./view/overview.js";
import { pageRoute } from "./view/page.js";
import { plateRoute } from "./view/plate/route.js";
import { familyRoute } from "./view/family.js";

const atlas = openAtlas(document, window);
const shared = {
  atlas,
  kernel: new KernelLoader(atlas),
  pins: tabPins(window),
};

/** The routes, the more specific first. */
const routes = [overviewRoute, findRoute, shapeRoute, compareRoute, plateRoute, pageRoute, familyRoute];

openShell(shared, routes, elementIn(document, "#gallery"));
