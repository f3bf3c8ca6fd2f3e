// The gallery begins here.

import { openAtlas } from "./data/atlas.js";
import { Pins } from "./view/pins.js";
import { openShell } from "./view/shell.js";
import { overviewRoom } from "./view/overview.js";

const app = { atlas: openAtlas(document, window), pins: new Pins() };

/** The rooms, the particular before the general. */
const rooms = [overviewRoom];

openShell(app, rooms, document.getElementById("gallery"));
