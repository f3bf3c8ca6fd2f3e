//! Drawings of parts as SVG, at their true size where the unit of lengths is known: outlines as lines and arcs, each part in a group of its name.

use std::fmt::Write;

use super::number::format_number;
use super::part_drawing::{LayerKind, PartDrawing, Shape, edges};
use crate::family::LengthUnit;
use crate::geometry::Point;
use crate::parts::Outline;

/// The document of a drawing whose lengths are in a unit. A unit of lengths is one of the drawing, whose y points down.
pub(super) fn document(drawing: &PartDrawing, unit: Option<LengthUnit>) -> String {
    let (bounds, margin) = (drawing.bounds(), drawing.hole);
    let corner = Point::new(bounds.min.x - margin, -bounds.max.y - margin);
    let size = bounds.size().add_scalar(2.0 * margin);
    let [x, y, width, height] = [corner.x, corner.y, size.x, size.y].map(format_number);
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"".to_owned();
    if let Some(unit) = unit {
        let [width, height] = [size.x, size.y].map(|length| format_number(length * unit.millimetres()));
        push(&mut out, format_args!(" width=\"{width}mm\" height=\"{height}mm\""));
    }
    push(
        &mut out,
        format_args!(" viewBox=\"{x} {y} {width} {height}\">\n<title>{}</title>\n", escaped(&drawing.title)),
    );
    for (index, layer) in drawing.layers.iter().enumerate() {
        let shapes: Vec<&Shape> =
            drawing.shapes.iter().filter(|(own, _)| *own == index).map(|(_, shape)| shape).collect();
        if shapes.is_empty() {
            continue;
        }
        push(
            &mut out,
            format_args!(
                "<g id=\"{}\" {}>\n",
                escaped(&layer.name.replace(char::is_whitespace, "-")),
                style(layer.kind, drawing.hole)
            ),
        );
        shapes.into_iter().for_each(|shape| write_shape(&mut out, shape));
        out.push_str("</g>\n");
    }
    out + "</svg>\n"
}

/// Appends to a text, which cannot fail.
fn push(out: &mut String, text: std::fmt::Arguments) {
    let _ = out.write_fmt(text);
}

/// What is cut is black, the curve red, marks and texts grey.
fn style(kind: LayerKind, hole: f64) -> String {
    let line = |color: &str, share: f64| {
        let width = format_number(hole * share);
        format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"")
    };
    match kind {
        LayerKind::Outline | LayerKind::Holes | LayerKind::Slots => line("#000000", 0.05),
        LayerKind::Curve => line("#c00000", 0.05),
        LayerKind::Centres => line("#808080", 0.025),
        LayerKind::Text => "fill=\"#606060\" font-family=\"DejaVu Sans, sans-serif\"".to_owned(),
    }
}

fn write_shape(out: &mut String, shape: &Shape) {
    let at = |p: Point| format!("{} {}", format_number(p.x), format_number(0.0 - p.y));
    match shape {
        Shape::Outline(Outline::Circle { centre, radius }) => {
            let [x, y, r] = [centre.x, 0.0 - centre.y, *radius].map(format_number);
            push(out, format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>\n"));
        }
        Shape::Outline(Outline::Path(vertices)) => {
            push(out, format_args!("<path d=\"M{}", at(vertices[0].at)));
            for (from, to, bulge) in edges(vertices) {
                if bulge == 0.0 {
                    push(out, format_args!(" L{}", at(to)));
                } else {
                    // No arc of a convex outline is more than half a turn; y down, one to the left is drawn against the clock.
                    let r = format_number((to - from).norm() * (1.0 + bulge * bulge) / (4.0 * bulge));
                    push(out, format_args!(" A{r} {r} 0 0 0 {}", at(to)));
                }
            }
            out.push_str(" Z\"/>\n");
        }
        Shape::Polyline(points, is_closed) => {
            let points: Vec<String> = points.iter().map(|p| at(*p)).collect();
            let end = if *is_closed { " Z" } else { "" };
            push(out, format_args!("<path d=\"M{}{end}\"/>\n", points.join(" L")));
        }
        Shape::Line([from, to]) => push(out, format_args!("<path d=\"M{} L{}\"/>\n", at(*from), at(*to))),
        Shape::Text(text, p, height) => {
            /// The height of a capital of the typeface, in units of its size.
            const CAPITAL: f64 = 0.73;
            let [x, y, size] = [p.x, 0.0 - p.y, height / CAPITAL].map(format_number);
            push(out, format_args!("<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\">{}</text>\n", escaped(text)));
        }
    }
}

/// A text in XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
