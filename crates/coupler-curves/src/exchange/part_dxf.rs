//! Drawings of parts in DXF of AutoCAD 2000: outlines as closed polylines of lines and arcs, holes as circles, each part on a layer of its name.

use super::dxf_2000::{CENTRE_LINE, Dxf2000, DxfLayer, SOLID_LINE, ascii};
use super::part_drawing::{Layer, LayerKind, PartDrawing, Shape};
use crate::family::LengthUnit;
use crate::geometry::Point;
use crate::parts::{Outline, Vertex};

/// The document of a drawing whose lengths are in a unit.
pub(super) fn document(drawing: &PartDrawing, unit: Option<LengthUnit>) -> String {
    let bounds = drawing.bounds();
    let layers = layers(&drawing.layers);
    let mut out = Dxf2000::new(&layers, (bounds, drawing.hole));
    for (layer, shape) in &drawing.shapes {
        write_shape(&mut out, &layers[*layer].name, shape);
    }
    let unit_comment = match unit {
        Some(unit) => unit.note(),
        None => "lengths are in the unit of the manifest".to_owned(),
    };
    let comments =
        [concat!("coupler-atlas ", env!("CARGO_PKG_VERSION")), drawing.title.as_str(), unit_comment.as_str()];
    out.finish((bounds, LengthUnit::dxf_code(unit), unit != Some(LengthUnit::Inch)), &comments)
}

/// The layers, each with a name that DXF allows and no other has.
fn layers(layers: &[Layer]) -> Vec<DxfLayer> {
    /// White or black, green, cyan, magenta, orange, blue, olive: parts next to each other differ.
    const OUTLINE_COLORS: [u8; 7] = [7, 3, 4, 6, 30, 150, 50];
    let is_common = |name: &str| layers.iter().any(|other| other.kind != LayerKind::Outline && other.name == name);
    let layer = |(k, Layer { name, kind }): (usize, &Layer)| {
        let is_own = *kind == LayerKind::Outline;
        let allowed = |c: char| if "<>/\\\":;?*|=,`'".contains(c) || c.is_control() { '_' } else { c };
        let name: String = name.chars().map(allowed).collect();
        let is_taken = is_own && (name == "0" || is_common(&name.to_uppercase()));
        let color = match kind {
            LayerKind::Outline => OUTLINE_COLORS[k % OUTLINE_COLORS.len()],
            LayerKind::Curve => 1,
            LayerKind::Holes | LayerKind::Slots => 5,
            LayerKind::Centres | LayerKind::Text => 8,
        };
        let line_type = if *kind == LayerKind::Centres { CENTRE_LINE } else { SOLID_LINE };
        DxfLayer { name: if is_taken { format!("part {name}") } else { name }, color, line_type }
    };
    layers.iter().enumerate().map(layer).collect()
}

fn write_shape(out: &mut Dxf2000, layer: &str, shape: &Shape) {
    match shape {
        Shape::Outline(Outline::Circle { centre, radius }) => {
            out.entity("CIRCLE", layer, "AcDbCircle");
            out.coordinates(10, *centre);
            out.number(40, *radius);
        }
        Shape::Outline(Outline::Path(vertices)) => polyline(out, layer, vertices, true),
        Shape::Polyline(points, is_closed) => {
            // In a closed path the last point equals the first and is omitted.
            let own = if *is_closed && points.len() > 1 { &points[..points.len() - 1] } else { points };
            let vertices: Vec<Vertex> = own.iter().map(|&at| Vertex { at, bulge: 0.0 }).collect();
            polyline(out, layer, &vertices, *is_closed);
        }
        Shape::Line([from, to]) => {
            out.entity("LINE", layer, "AcDbLine");
            out.coordinates(10, *from);
            out.coordinates(11, *to);
        }
        Shape::Text(text, at, height) => write_text(out, layer, text, (*at, *height)),
    }
}

fn polyline(out: &mut Dxf2000, layer: &str, vertices: &[Vertex], is_closed: bool) {
    out.entity("LWPOLYLINE", layer, "AcDbPolyline");
    out.group(90, vertices.len());
    out.group(70, u8::from(is_closed));
    for Vertex { at, bulge } in vertices {
        out.number(10, at.x);
        out.number(20, at.y);
        if *bulge != 0.0 {
            out.number(42, *bulge);
        }
    }
}

fn write_text(out: &mut Dxf2000, layer: &str, text: &str, (at, height): (Point, f64)) {
    out.entity("TEXT", layer, "AcDbText");
    out.coordinates(10, at);
    out.number(40, height);
    out.group(1, ascii(text));
    out.group(100, "AcDbText");
}
