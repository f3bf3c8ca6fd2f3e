// The gallery begins here.

import { openAtlas } from "./data/atlas.js";
import { pinsOfTab } from "./view/pins.js";
import { openShell } from "./view/shell.js";
import { findRoom } from "./view/find/room.js";
import { shapeRoom } from "./view/shape/room.js";
import { compareRoom } from "./view/compare/room.js";
import { overviewRoom } from "./view/overview.js";
import { pageRoom } from "./view/page.js";
import { plateRoom } from "./view/plate/room.js";
import { sheetRoom } from "./view/sheet.js";

const app = { atlas: openAtlas(document, window), pins: pinsOfTab(window) };

/** The rooms, the particular before the general. */
const rooms = [overviewRoom, findRoom, shapeRoom, compareRoom, plateRoom, pageRoom, sheetRoom];

openShell(app, rooms, document.getElementById("gallery"));
