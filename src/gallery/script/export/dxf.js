// Writes a drawing in AutoCAD R12 DXF (AC1009), which every CAD program reads (AutoCAD Release 12
// Customization Manual, chapter 11). The curve is a polyline, a circle or an arc; the linkage is drawn as
// lines in one pose; joints are points, with fixed pivots on a layer of their own. R12 cannot name a unit.

import { mechanismOf } from "../draw/mechanism.js";
import { circleOfPath, extentOfPath } from "./circle.js";
import { realDigits } from "./digits.js";
import { polylineOfCurve } from "./polyline.js";
import { exportPose } from "./curve.js";

// Layer 0 is required. AutoCAD colour numbers: 1 is red, 5 blue, 7 black on white.
const DXF_LAYERS = [
  ["0", 7],
  ["CURVE", 1],
  ["LINKAGE", 7],
  ["JOINTS", 5],
  ["PIVOTS", 7],
];

/** The chord error of a polyline, relative to the curve's extent. */
const DXF_CHORD = 1e-4;

/** An exported curve as a DXF document; `program` is the program's name and version. */
export function dxfOfCurve(exported, program, chord = DXF_CHORD) {
  const samples = samplesOfCurve(exported);
  const path = polylineOfCurve(exported, chord * extentOfPath(samples));
  const pose = exportPose(exported);
  const { bars, plates, frame } = mechanismOf(exported.linkage, exported.circuitSamples);
  const isPlaced = (joint) => Number.isFinite(pose(joint).x) && Number.isFinite(pose(joint).y);
  const links = outlinesByLink(exported.linkage, bars, plates);
  const shown = [...new Set([...links.flatMap(({ joints }) => joints), ...frame, exported.joint])]
    .sort((a, b) => a - b)
    .filter(isPlaced);
  const lines = links.flatMap(barsOfLink).filter((bar) => bar.every(isPlaced));
  const circle = circleOfPath(path, samples);
  return [
    dxfGroup(999, program),
    dxfGroup(999, exported.name),
    dxfGroup(999, "lengths are in the unit of the manifest"),
    dxfHeader([...path, ...shown.map(pose)]),
    dxfTables(),
    dxfSection("BLOCKS", ""),
    dxfSection(
      "ENTITIES",
      [
        circle ? dxfCircle(circle) : dxfPolyline(path, exported.circuitSamples.closed),
        ...lines.map(([from, to]) =>
          dxfEntity("LINE", "LINKAGE", dxfPlace(10, pose(from)), dxfPlace(11, pose(to))),
        ),
        ...shown.map((joint) =>
          dxfEntity("POINT", frame.includes(joint) ? "PIVOTS" : "JOINTS", dxfPlace(10, pose(joint))),
        ),
      ].join(""),
    ),
    dxfGroup(0, "EOF"),
  ].join("");
}

/** The samples of an exported curve, [{ x, y }, …]; samples without a finite position are left out. */
function samplesOfCurve({ circuitSamples: { x, y, count }, joint }) {
  const all = Array.from({ length: count }, (_, k) => ({ x: x[joint][k], y: y[joint][k] }));
  return all.filter((p) => Number.isFinite(p.x) && Number.isFinite(p.y));
}

// Bars and plates in the order of their links.
function outlinesByLink(linkage, bars, plates) {
  const all = [...bars.map((joints) => ({ joints })), ...plates.map((joints) => ({ joints, isPlate: true }))];
  const isOn = (link, { joints }) => joints.every((joint) => link.some((place) => place.joint === joint));
  const place = (outline) => linkage.links.findIndex((link) => isOn(link, outline));
  return all.map((outline) => ({ ...outline, link: place(outline) })).sort((a, b) => a.link - b.link);
}

function barsOfLink({ joints, isPlate }) {
  const bars = joints.slice(1).map((joint, k) => [joints[k], joint]);
  return isPlate ? [...bars, [joints[joints.length - 1], joints[0]]] : bars;
}

function dxfHeader(points) {
  const xs = points.map(({ x }) => x);
  const ys = points.map(({ y }) => y);
  const least = { x: Math.min(...xs), y: Math.min(...ys) };
  const most = { x: Math.max(...xs), y: Math.max(...ys) };
  const corner = (name, { x, y }, isSpatial) =>
    dxfGroup(9, name) + dxfNumber(10, x) + dxfNumber(20, y) + (isSpatial ? dxfNumber(30, 0) : "");
  // Decimal numbers, with as many places as are shown; angles in decimal degrees from the x-axis,
  // counter-clockwise.
  const settings = [
    ["$LUNITS", 2],
    ["$LUPREC", 8],
    ["$AUNITS", 0],
    ["$AUPREC", 8],
    ["$ANGDIR", 0],
  ];
  return dxfSection(
    "HEADER",
    [
      dxfGroup(9, "$ACADVER") + dxfGroup(1, "AC1009"),
      corner("$INSBASE", { x: 0, y: 0 }, true),
      corner("$EXTMIN", least, true),
      corner("$EXTMAX", most, true),
      corner("$LIMMIN", least),
      corner("$LIMMAX", most),
      ...settings.map(([name, value]) => dxfGroup(9, name) + dxfGroup(70, value)),
      dxfGroup(9, "$ANGBASE") + dxfNumber(50, 0),
      // Points are shown as circles with a cross, a hundredth of the drawing in size.
      dxfGroup(9, "$PDMODE") + dxfGroup(70, 34),
      dxfGroup(9, "$PDSIZE") + dxfNumber(40, Math.max(most.x - least.x, most.y - least.y) / 100),
    ].join(""),
  );
}

function dxfTables() {
  const table = (name, entries, text) =>
    dxfGroup(0, "TABLE") + dxfGroup(2, name) + dxfGroup(70, entries) + text + dxfGroup(0, "ENDTAB");
  const line = [
    [0, "LTYPE"],
    [2, "CONTINUOUS"],
    [70, 0],
    [3, "Solid line"],
    [72, 65],
    [73, 0],
    [40, "0.0"],
  ];
  const layer = ([name, color]) => [
    [0, "LAYER"],
    [2, name],
    [70, 0],
    [62, color],
    [6, "CONTINUOUS"],
  ];
  const groups = (pairs) => pairs.map(([code, value]) => dxfGroup(code, value)).join("");
  return dxfSection(
    "TABLES",
    table("LTYPE", 1, groups(line)) + table("LAYER", DXF_LAYERS.length, groups(DXF_LAYERS.flatMap(layer))),
  );
}

// A group: a code and a value, each on its own line.
function dxfGroup(code, value) {
  return `${String(code).padStart(3)}\n${value}\n`;
}

function dxfNumber(code, value) {
  return dxfGroup(code, realDigits(value));
}

function dxfSection(name, text) {
  return dxfGroup(0, "SECTION") + dxfGroup(2, name) + text + dxfGroup(0, "ENDSEC");
}

function dxfEntity(kind, layer, ...groups) {
  return dxfGroup(0, kind) + dxfGroup(8, layer) + groups.join("");
}

function dxfPlace(first, { x, y }) {
  return dxfNumber(first, x) + dxfNumber(first + 10, y) + dxfNumber(first + 20, 0);
}

function dxfCircle({ x, y, radius, arc }) {
  const ends = arc ? [dxfNumber(50, arc[0]), dxfNumber(51, arc[1])] : [];
  return dxfEntity(arc ? "ARC" : "CIRCLE", "CURVE", dxfPlace(10, { x, y }), dxfNumber(40, radius), ...ends);
}

// A closed polyline does not repeat its first point. The polyline's own position is a dummy.
function dxfPolyline(path, closed) {
  const vertices = closed && path.length > 1 ? path.slice(0, -1) : path;
  return [
    dxfEntity(
      "POLYLINE",
      "CURVE",
      dxfGroup(66, 1),
      dxfPlace(10, { x: 0, y: 0 }),
      dxfGroup(70, closed ? 1 : 0),
    ),
    ...vertices.map((vertex) => dxfEntity("VERTEX", "CURVE", dxfPlace(10, vertex))),
    dxfEntity("SEQEND", "CURVE"),
  ].join("");
}
