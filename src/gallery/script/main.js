// The entry point of the gallery.

import { openAtlas } from "./data/atlas.js";
import { KernelLoader } from "./kernel/kernel.js";
import { withLinkages } from "./kernel/linkages.js";
import { elementIn } from "./view/dom.js";
import { storedPins } from "./view/pins.js";
import { openShell } from "./view/shell.js";
import { findRoute } from "./view/find/find-view.js";
import { shapeRoute } from "./view/shape/shape-view.js";
import { compareRoute } from "./view/compare/compare-view.js";
import { newRoute } from "./view/new-view.js";
import { overviewRoute } from "./view/overview.js";
import { pageRoute } from "./view/page.js";
import { newPlateRoute, onlyPlateRoute, plateRoute } from "./view/plate/route.js";
import { familyRoute } from "./view/family.js";

const files = openAtlas(document, window);
const kernel = new KernelLoader(files);
const atlas = withLinkages(files, kernel);
const shared = { atlas, kernel, pins: storedPins(window) };

/** The routes, the more specific first. */
const found = [overviewRoute, findRoute, shapeRoute, compareRoute, newRoute];
const routes = [...found, newPlateRoute, plateRoute, pageRoute, familyRoute];

openShell(shared, atlas.plate ? [onlyPlateRoute] : routes, elementIn(document, "#gallery"));
