//! A drawing in the Drawing Interchange Format of AutoCAD R12 (AC1009), which every CAD program reads.
//!
//! The curve is a polyline, or a circle or an arc if it is one. The linkage is drawn as lines in one pose, and its
//! joints as points, the pivots on a separate layer. Lengths are in the manifest's own unit, for R12 cannot name a
//! unit.
//!
//! # Source
//! *AutoCAD Release 12 Customization Manual*, chapter 11.

use super::SelectedCurve;
use super::circle::{Circle, fit_circle};
use super::curve_path::curve_path;
use super::dxf_writer::DxfWriter;
use crate::geometry::{Bounds, Point};
use crate::linkage::{JointId, LinkOutline, is_plate};

const CURVE: &str = "CURVE";
const LINKAGE: &str = "LINKAGE";
const JOINTS: &str = "JOINTS";
const PIVOTS: &str = "PIVOTS";

/// The layers, each with its AutoCAD colour number: 1 is red, 5 is blue, 7 is black on white. Layer 0 always exists.
const LAYERS: [(&str, u8); 5] = [("0", 7), (CURVE, 1), (LINKAGE, 7), (JOINTS, 5), (PIVOTS, 7)];

/// The whole drawing; no chord of a polyline is further from the curve than `chord` times its extent.
pub(super) fn document(selected: &SelectedCurve, chord: f64) -> String {
    let (path, closed) = curve_path(selected, chord);
    let pose = selected.pose();
    let linkage = &selected.solved.linkage;
    let joints = shown_joints(selected);
    let mut out = DxfWriter::default();
    out.group(999, concat!("coupler-atlas ", env!("CARGO_PKG_VERSION")));
    out.group(999, selected.name());
    out.group(999, "lengths are in the unit of the manifest");
    write_header(Bounds::from_points(path.iter().chain(joints.iter().map(|&joint| &pose[joint])).copied()), &mut out);
    write_tables(&mut out);
    out.section("BLOCKS");
    out.end_marker("ENDSEC");
    out.section("ENTITIES");
    let samples: Vec<Point> = selected.circuit().points(selected.curve().joint).filter(is_finite).collect();
    match fit_circle(&path, &samples) {
        Some(circle) => out.circle(&circle),
        None => out.polyline(&path, closed),
    }
    for [from, to] in link_segments(selected, &pose) {
        out.line(pose[from], pose[to]);
    }
    let pivots = linkage.pivots();
    for joint in joints {
        out.point(if pivots.contains(&joint) { PIVOTS } else { JOINTS }, pose[joint]);
    }
    out.end_marker("ENDSEC");
    out.end_marker("EOF");
    out.0
}

fn is_finite(p: &Point) -> bool {
    p.x.is_finite() && p.y.is_finite()
}

/// The lines of the moving links, each from joint to joint.
fn link_segments(selected: &SelectedCurve, pose: &[Point]) -> Vec<[JointId; 2]> {
    let mut bars = Vec::new();
    for LinkOutline { joints, .. } in selected.circuit().link_outlines(&selected.solved.linkage) {
        bars.extend(joints.windows(2).map(|pair| [pair[0], pair[1]]));
        let points: Vec<Point> = joints.iter().map(|&joint| pose[joint]).collect();
        if let (true, [first, .., last]) = (is_plate(&points), &joints[..]) {
            bars.push([*last, *first]);
        }
    }
    bars.retain(|bar| bar.iter().all(|&joint| is_finite(&pose[joint])));
    bars
}

/// The joints that are drawn: those of links, the pivots, and the traced joint.
fn shown_joints(selected: &SelectedCurve) -> Vec<JointId> {
    let linkage = &selected.solved.linkage;
    let outlines = selected.circuit().link_outlines(linkage);
    let mut joints: Vec<JointId> = outlines.into_iter().flat_map(|outline| outline.joints).collect();
    joints.extend(linkage.pivots());
    joints.push(selected.curve().joint);
    joints.sort_unstable();
    joints.dedup();
    let pose = selected.pose();
    joints.retain(|&joint| is_finite(&pose[joint]));
    joints
}

fn write_header(bounds: Bounds, out: &mut DxfWriter) {
    out.section("HEADER");
    out.group(9, "$ACADVER");
    out.group(1, "AC1009");
    out.header_point("$INSBASE", Point::origin(), 3);
    out.header_point("$EXTMIN", bounds.min, 3);
    out.header_point("$EXTMAX", bounds.max, 3);
    out.header_point("$LIMMIN", bounds.min, 2);
    out.header_point("$LIMMAX", bounds.max, 2);
    // Decimal numbers with eight places; angles in decimal degrees from the x-axis, counter-clockwise.
    for (name, value) in [("$LUNITS", 2), ("$LUPREC", 8), ("$AUNITS", 0), ("$AUPREC", 8), ("$ANGDIR", 0)] {
        out.group(9, name);
        out.group(70, value);
    }
    out.group(9, "$ANGBASE");
    out.number(50, 0.0);
    // Points are shown as circles with a cross, a hundredth of the drawing in size.
    out.group(9, "$PDMODE");
    out.group(70, 34);
    out.group(9, "$PDSIZE");
    out.number(40, bounds.size().max() / 100.0);
    out.end_marker("ENDSEC");
}

fn write_tables(out: &mut DxfWriter) {
    out.section("TABLES");
    out.table("LTYPE", 1);
    out.group(0, "LTYPE");
    out.group(2, "CONTINUOUS");
    out.group(70, 0);
    out.group(3, "Solid line");
    out.group(72, 65);
    out.group(73, 0);
    out.number(40, 0.0);
    out.end_marker("ENDTAB");
    out.table("LAYER", LAYERS.len());
    for (name, color) in LAYERS {
        out.group(0, "LAYER");
        out.group(2, name);
        out.group(70, 0);
        out.group(62, color);
        out.group(6, "CONTINUOUS");
    }
    out.end_marker("ENDTAB");
    out.end_marker("ENDSEC");
}

impl DxfWriter {
    fn table(&mut self, name: &str, entries: usize) {
        self.group(0, "TABLE");
        self.group(2, name);
        self.group(70, entries);
    }

    fn entity(&mut self, kind: &str, layer: &str) {
        self.group(0, kind);
        self.group(8, layer);
    }

    fn point(&mut self, layer: &str, p: Point) {
        self.entity("POINT", layer);
        self.coordinates(10, p);
    }

    fn line(&mut self, from: Point, to: Point) {
        self.entity("LINE", LINKAGE);
        self.coordinates(10, from);
        self.coordinates(11, to);
    }

    fn circle(&mut self, circle: &Circle) {
        self.entity(if circle.arc_deg.is_some() { "ARC" } else { "CIRCLE" }, CURVE);
        self.coordinates(10, circle.centre);
        self.number(40, circle.radius);
        for (code, deg) in [50, 51].into_iter().zip(circle.arc_deg.iter().flatten()) {
            self.number(code, *deg);
        }
    }

    /// Writes a polyline. In a closed path the last point equals the first and is omitted.
    fn polyline(&mut self, path: &[Point], closed: bool) {
        let vertices = if closed && path.len() > 1 { &path[..path.len() - 1] } else { path };
        self.entity("POLYLINE", CURVE);
        // Vertices follow; the coordinates are a dummy point, of which only the elevation is used.
        self.group(66, 1);
        self.coordinates(10, Point::origin());
        self.group(70, u8::from(closed));
        for vertex in vertices {
            self.entity("VERTEX", CURVE);
            self.coordinates(10, *vertex);
        }
        self.entity("SEQEND", CURVE);
    }
}
