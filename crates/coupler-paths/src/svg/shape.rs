//! The outlines of the shapes of SVG.

use kurbo::{Affine, Arc, BezPath, Circle, Point, Shape, SvgArc, Vec2};
use svgtypes::{PathParser, PathSegment, PointsParser};

use super::length::{Side, Viewport, length};
use super::tree::Element;
use crate::drawing::shorten;

/// How near to a circle its curves are, relative to its radius.
const ACCURACY: f64 = 1e-6;

/// The outline that an element draws; `None` if it draws none.
///
/// # Errors
/// An attribute cannot be read.
pub(super) fn outline(element: &Element, viewport: Viewport) -> Result<Option<BezPath>, String> {
    let number = |name: &str, side| Ok::<f64, String>(length(element, name, viewport, side)?.unwrap_or(0.0));
    let text = |name: &str| element.attribute(name).unwrap_or_default();
    let path = match element.name.as_str() {
        "path" => path(text("d"))?,
        "polyline" => polygon(text("points"), false),
        "polygon" => polygon(text("points"), true),
        "line" => {
            let mut path = BezPath::new();
            path.move_to((number("x1", Side::Width)?, number("y1", Side::Height)?));
            path.line_to((number("x2", Side::Width)?, number("y2", Side::Height)?));
            path
        }
        "rect" => {
            let (width, height) = (number("width", Side::Width)?, number("height", Side::Height)?);
            let radii = [length(element, "rx", viewport, Side::Width)?, length(element, "ry", viewport, Side::Height)?];
            let corner = Point::new(number("x", Side::Width)?, number("y", Side::Height)?);
            rectangle(corner, [width, height], radii)
        }
        "circle" => {
            let radius = number("r", Side::Diagonal)?;
            ellipse((number("cx", Side::Width)?, number("cy", Side::Height)?), [radius, radius])
        }
        "ellipse" => {
            let radii = [length(element, "rx", viewport, Side::Width)?, length(element, "ry", viewport, Side::Height)?];
            let radii = match radii {
                [Some(rx), Some(ry)] => [rx, ry],
                [Some(both), None] | [None, Some(both)] => [both, both],
                [None, None] => [0.0, 0.0],
            };
            ellipse((number("cx", Side::Width)?, number("cy", Side::Height)?), radii)
        }
        _ => return Ok(None),
    };
    Ok(Some(path))
}

/// An ellipse with these radii; nothing if one is not positive.
fn ellipse(centre: (f64, f64), [rx, ry]: [f64; 2]) -> BezPath {
    if !(rx > 0.0 && ry > 0.0) {
        return BezPath::new();
    }
    Affine::translate(centre) * Affine::scale_non_uniform(rx, ry) * Circle::new((0.0, 0.0), 1.0).to_path(ACCURACY)
}

/// A rectangle, perhaps with rounded corners; nothing if a side is not positive.
fn rectangle(corner: Point, [width, height]: [f64; 2], radii: [Option<f64>; 2]) -> BezPath {
    let mut path = BezPath::new();
    if !(width > 0.0 && height > 0.0) {
        return path;
    }
    let [rx, ry] = match radii.map(|radius| radius.filter(|radius| *radius >= 0.0)) {
        [Some(rx), Some(ry)] => [rx, ry],
        [Some(both), None] | [None, Some(both)] => [both, both],
        [None, None] => [0.0, 0.0],
    };
    let (rx, ry) = (rx.min(0.5 * width), ry.min(0.5 * height));
    let at = |x: f64, y: f64| Point::new(corner.x + x, corner.y + y);
    let sides = [
        (at(rx, 0.0), at(width - rx, 0.0), at(width, ry)),
        (at(width, ry), at(width, height - ry), at(width - rx, height)),
        (at(width - rx, height), at(rx, height), at(0.0, height - ry)),
        (at(0.0, height - ry), at(0.0, ry), at(rx, 0.0)),
    ];
    path.move_to(sides[0].0);
    for (_, end, next) in sides {
        path.line_to(end);
        arc_to(&mut path, end, next, [rx, ry], 0.0, [false, true]);
    }
    path.close_path();
    path
}

/// The polyline or polygon with these coordinates.
fn polygon(text: &str, is_closed: bool) -> BezPath {
    let mut path = BezPath::new();
    for point in PointsParser::from(text) {
        if path.elements().is_empty() { path.move_to(point) } else { path.line_to(point) }
    }
    if is_closed && !path.elements().is_empty() {
        path.close_path();
    }
    path
}

/// Adds an arc of an ellipse, or a line where it is none.
fn arc_to(
    path: &mut BezPath,
    from: Point,
    to: Point,
    [rx, ry]: [f64; 2],
    rotation: f64,
    [large_arc, sweep]: [bool; 2],
) {
    let radii = Vec2::new(rx.abs(), ry.abs());
    let arc = SvgArc { from, to, radii, x_rotation: rotation, large_arc, sweep };
    match Arc::from_svg_arc(&arc) {
        Some(arc) if arc.radii.x > 0.0 && arc.radii.y > 0.0 && arc.radii.hypot().is_finite() => {
            let accuracy = ACCURACY * arc.radii.x.max(arc.radii.y);
            arc.to_cubic_beziers(accuracy, |p1, p2, p| path.curve_to(p1, p2, p));
        }
        _ => path.line_to(to),
    }
}

/// The path with this data.
///
/// # Errors
/// They cannot be read.
fn path(data: &str) -> Result<BezPath, String> {
    let mut path = BezPath::new();
    let (mut start, mut at) = (Point::ORIGIN, Point::ORIGIN);
    // The last control points of a cubic and of a quadratic curve, for smooth ones.
    let (mut cubic, mut quadratic) = (None, None);
    let mut needs_move = false;
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|error| format!("the path `{}` cannot be read: {error}", shorten(data)))?;
        let origin = if segment.is_abs() { Vec2::ZERO } else { at.to_vec2() };
        let point = |x: f64, y: f64| Point::new(x, y) + origin;
        if needs_move && !matches!(segment, PathSegment::MoveTo { .. } | PathSegment::ClosePath { .. }) {
            path.move_to(start);
        }
        needs_move = matches!(segment, PathSegment::ClosePath { .. });
        let mirrored = |control: Option<Point>| control.map_or(at, |control| at + (at - control));
        let (mut next_cubic, mut next_quadratic) = (None, None);
        let before = at;
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                at = point(x, y);
                start = at;
                path.move_to(at);
            }
            PathSegment::LineTo { x, y, .. } => at = point(x, y),
            PathSegment::HorizontalLineTo { x, .. } => at.x = x + origin.x,
            PathSegment::VerticalLineTo { y, .. } => at.y = y + origin.y,
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                let (p1, p2) = (point(x1, y1), point(x2, y2));
                at = point(x, y);
                next_cubic = Some(p2);
                path.curve_to(p1, p2, at);
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let (p1, p2) = (mirrored(cubic), point(x2, y2));
                at = point(x, y);
                next_cubic = Some(p2);
                path.curve_to(p1, p2, at);
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                let p1 = point(x1, y1);
                at = point(x, y);
                next_quadratic = Some(p1);
                path.quad_to(p1, at);
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let p1 = mirrored(quadratic);
                at = point(x, y);
                next_quadratic = Some(p1);
                path.quad_to(p1, at);
            }
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                at = point(x, y);
                if before != at {
                    arc_to(&mut path, before, at, [rx, ry], x_axis_rotation.to_radians(), [large_arc, sweep]);
                }
            }
            PathSegment::ClosePath { .. } => {
                at = start;
                path.close_path();
            }
        }
        if let PathSegment::LineTo { .. } | PathSegment::HorizontalLineTo { .. } | PathSegment::VerticalLineTo { .. } =
            segment
        {
            path.line_to(at);
        }
        (cubic, quadratic) = (next_cubic, next_quadratic);
    }
    Ok(path)
}
