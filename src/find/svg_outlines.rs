//! The outlines of a drawing in SVG.

use coupler_curves::geometry::Point;
use kurbo::{Affine, BezPath, Circle, Ellipse, PathEl, Shape};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::Outline;

/// Points at equal distances along an outline: as many as are needed to see its shape.
const POINTS: usize = 100;

/// How near a chord is to a curve, relative to the extent of the outline.
const FLATNESS: f64 = 1e-5;

/// A gap is closed that is no greater than this part of the extent: drawing programs round coordinates.
const CLOSED: f64 = 1e-6;

/// The most elements of nested groups.
const MAX_DEPTH: usize = 1000;

/// Elements whose contents are not drawn where they are written.
const NOT_DRAWN: [&str; 8] = ["defs", "clipPath", "mask", "pattern", "marker", "symbol", "style", "script"];

/// The longest of the outlines in a drawing, as points at equal distances. Its y points up, so that that of the drawing changes its
/// sign.
///
/// # Errors
/// The drawing cannot be read, or has no outline.
pub(super) fn longest_outline(text: &str) -> Result<Outline, String> {
    let longest = outlines(text)?
        .into_iter()
        .map(|path| (length(&path), path))
        .filter(|(length, _)| length.is_finite() && *length > 0.0)
        .reduce(|best, other| if other.0 > best.0 { other } else { best });
    let Some((length, path)) = longest else {
        return Err("the drawing has no path, line, polygon, rectangle, circle or ellipse".to_owned());
    };
    let is_closed = path.first() == path.last();
    let points = spaced_evenly(&path, length, is_closed);
    Ok(Outline { points, angles_deg: None, is_closed: Some(is_closed).filter(|closed| *closed) })
}

/// The outlines of a drawing as polylines; the first point of a closed one is repeated.
fn outlines(text: &str) -> Result<Vec<Vec<Point>>, String> {
    let mut xml = Reader::from_str(text);
    let mut outlines = Vec::new();
    // The transforms of the open elements, and the depth from which nothing is drawn.
    let mut transforms = vec![Affine::IDENTITY];
    let mut hidden_from: Option<usize> = None;
    loop {
        let event = xml.read_event().map_err(|error| format!("the drawing is not well-formed: {error}"))?;
        let (element, is_empty) = match &event {
            Event::Start(element) => (element, false),
            Event::Empty(element) => (element, true),
            Event::End(_) => {
                transforms.pop();
                hidden_from = hidden_from.filter(|depth| *depth <= transforms.len());
                continue;
            }
            Event::Eof => return Ok(outlines),
            _ => continue,
        };
        let Some(outer) = transforms.last().filter(|_| transforms.len() < MAX_DEPTH) else {
            return Err("the elements of the drawing are nested too deep".to_owned());
        };
        let transform = *outer * transform_of(element)?;
        let name = element.local_name();
        if hidden_from.is_none() && !NOT_DRAWN.contains(&name.as_ref()) {
            let path = path_of(name.as_ref(), element)?;
            outlines.extend(path.into_iter().flat_map(|path| polylines(&(transform * path))));
        }
        if !is_empty {
            transforms.push(transform);
            if NOT_DRAWN.contains(&name.as_ref()) {
                hidden_from.get_or_insert(transforms.len());
            }
        }
    }
}

/// The value of an attribute, without its entities.
fn attribute(element: &BytesStart, name: &str) -> Result<Option<String>, String> {
    let error = |error: String| format!("an attribute of the drawing cannot be read: {error}");
    let found = element.try_get_attribute(name).map_err(|cause| error(cause.to_string()))?;
    let value = found.map(|found| found.normalized_value(XmlVersion::Explicit1_0).map(|value| value.into_owned()));
    value.transpose().map_err(|cause| error(cause.to_string()))
}

fn transform_of(element: &BytesStart) -> Result<Affine, String> {
    let Some(text) = attribute(element, "transform")? else { return Ok(Affine::IDENTITY) };
    let transform: svgtypes::Transform =
        text.parse().map_err(|error| format!("the transform `{text}` of the drawing cannot be read: {error}"))?;
    let svgtypes::Transform { a, b, c, d, e, f } = transform;
    Ok(Affine::new([a, b, c, d, e, f]))
}

/// The path that an element draws.
fn path_of(name: &str, element: &BytesStart) -> Result<Option<BezPath>, String> {
    /// How near to a circle its curves are, relative to its radius.
    const ACCURACY: f64 = 1e-6;
    let number = |name: &str| -> Result<f64, String> {
        let Some(text) = attribute(element, name)? else { return Ok(0.0) };
        let plain = text.trim().trim_end_matches("px").trim();
        let value = plain.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("`{name} = {text}` of the drawing is not a number in the drawing's unit"))
    };
    let text = |name: &str| Ok::<_, String>(attribute(element, name)?.unwrap_or_default());
    let path = match name {
        "path" => {
            let data = text("d")?;
            BezPath::from_svg(&data)
                .map_err(|error| format!("the path `{}` cannot be read: {error}", shorten(&data)))?
        }
        "polyline" | "polygon" => polygon(&text("points")?, name == "polygon")?,
        "line" => {
            let mut path = BezPath::new();
            path.move_to((number("x1")?, number("y1")?));
            path.line_to((number("x2")?, number("y2")?));
            path
        }
        "rect" => {
            let (x, y, width, height) = (number("x")?, number("y")?, number("width")?, number("height")?);
            let radii = [number("rx")?, number("ry")?].into_iter().fold(0.0, f64::max);
            kurbo::RoundedRect::new(x, y, x + width, y + height, radii).to_path(ACCURACY * (width + height))
        }
        "circle" => {
            let radius = number("r")?;
            Circle::new((number("cx")?, number("cy")?), radius).to_path(ACCURACY * radius)
        }
        "ellipse" => {
            let radii = (number("rx")?, number("ry")?);
            Ellipse::new((number("cx")?, number("cy")?), radii, 0.0).to_path(ACCURACY * radii.0.max(radii.1))
        }
        _ => return Ok(None),
    };
    Ok(Some(path))
}

/// The polyline or polygon with these coordinates.
fn polygon(text: &str, is_closed: bool) -> Result<BezPath, String> {
    let points = svgtypes::PointsParser::from(text);
    let mut path = BezPath::new();
    for point in points {
        if path.elements().is_empty() { path.move_to(point) } else { path.line_to(point) }
    }
    if is_closed && !path.elements().is_empty() {
        path.close_path();
    }
    Ok(path)
}

fn shorten(text: &str) -> String {
    const LENGTH: usize = 40;
    match text.char_indices().nth(LENGTH) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// The polylines along a path, one for each of its parts, with y pointing up.
fn polylines(path: &BezPath) -> Vec<Vec<Point>> {
    let bounds = path.control_box();
    let extent = bounds.width().max(bounds.height());
    if !(extent.is_finite() && extent > 0.0) {
        return Vec::new();
    }
    let up = |p: kurbo::Point| Point::new(p.x, -p.y);
    let mut parts: Vec<Vec<Point>> = Vec::new();
    kurbo::flatten(path, FLATNESS * extent, |element| match (element, parts.last_mut()) {
        (PathEl::MoveTo(to), _) => parts.push(vec![up(to)]),
        (PathEl::LineTo(to), Some(part)) => part.push(up(to)),
        (PathEl::ClosePath, Some(part)) => {
            let first = part[0];
            if part.last() != Some(&first) {
                part.push(first);
            }
        }
        // A path begins with a move, and what is flattened has lines only.
        _ => {}
    });
    for part in &mut parts {
        let (first, last) = (part[0], part.len() - 1);
        if last > 0 && (part[last] - first).norm() <= CLOSED * extent {
            part[last] = first;
        }
    }
    parts
}

fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// Points at equal distances along a polyline: of a closed one without the last, which is the first.
fn spaced_evenly(path: &[Point], length: f64, is_closed: bool) -> Vec<Point> {
    let step = length / if is_closed { POINTS } else { POINTS - 1 } as f64;
    let mut points = vec![path[0]];
    let mut before = 0.0;
    for pair in path.windows(2) {
        let whole = (pair[1] - pair[0]).norm();
        while points.len() < POINTS && step * points.len() as f64 <= before + whole {
            points.push(pair[0] + (pair[1] - pair[0]) * ((step * points.len() as f64 - before) / whole));
        }
        before += whole;
    }
    // Rounding may leave out the end.
    points.extend((points.len() < POINTS).then(|| path[path.len() - 1]));
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Outline {
        longest_outline(text).unwrap()
    }

    #[test]
    fn shapes_are_read_as_they_are_drawn() {
        let circle = |outline: Outline, centre: [f64; 2], radius: f64| {
            assert_eq!((outline.points.len(), outline.is_closed), (POINTS, Some(true)));
            for p in outline.points {
                let distance = (p - Point::new(centre[0], centre[1])).norm();
                // The arcs of a path are drawn as cubic curves of a quarter turn, as browsers do.
                assert!((distance - radius).abs() < 3e-4 * radius, "{p} {distance}");
            }
        };
        circle(read("<svg><circle cx='3' cy='4' r='2'/></svg>"), [3.0, -4.0], 2.0);
        circle(read("<svg><ellipse cx='3' cy='4' rx='2' ry='2px'/><line x2='1'/></svg>"), [3.0, -4.0], 2.0);
        let arcs = "<svg xmlns='http://www.w3.org/2000/svg'><path d='M1 4a2 2 0 1 0 4 0a2 2 0 1 0-4 0z'/></svg>";
        circle(read(arcs), [3.0, -4.0], 2.0);
        // From the outside in: moved by (10, 0), and twice as large.
        let moved = "<svg><g transform='translate(10 0)'><g transform='scale(2)'><circle cx='3' cy='4' r='2'/></g></g>\
                     <circle r='1'/></svg>";
        circle(read(moved), [16.0, -8.0], 4.0);
        let hidden = "<svg><defs><circle r='9'/><g><circle r='8'/></g></defs><circle cx='3' cy='4' r='2'/></svg>";
        circle(read(hidden), [3.0, -4.0], 2.0);
    }

    #[test]
    fn lines_are_open_and_polygons_closed() {
        let line = read("<svg><polyline points='0,0 10,0 10,-5'/></svg>");
        assert_eq!(
            (line.points[0], line.points[99], line.is_closed),
            (Point::new(0.0, 0.0), Point::new(10.0, 5.0), None)
        );
        let step = 15.0 / 99.0;
        assert!(line.points.windows(2).all(|pair| (pair[1] - pair[0]).norm() < step + 1e-12));
        let square = read("<svg><rect x='1' y='1' width='2' height='2'/></svg>");
        assert_eq!((square.points.len(), square.is_closed), (100, Some(true)));
        assert!(
            (square.points[25] - Point::new(3.0, -1.0)).norm() < 1e-9
                || (square.points[25] - Point::new(1.0, -3.0)).norm() < 1e-9
        );
        assert_eq!(read("<svg><polygon points='0,0 1,0 0,1'/></svg>").is_closed, Some(true));
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        for text in [
            "<svg>",
            "<svg/>",
            "<svg><text>M0 0</text></svg>",
            "<svg><path d='M0 0 L'/></svg>",
            "<svg><path d='nothing'/></svg>",
            "<svg><circle r='1em'/></svg>",
            "<svg><circle r='1' transform='turn(3)'/></svg>",
            "<svg><path d='M0 0'/></svg>",
            "<svg><circle r='0'/></svg>",
            "<svg><a></b></svg>",
        ] {
            assert!(longest_outline(text).is_err(), "{text}");
        }
        assert!(longest_outline(&"<g>".repeat(100_000)).is_err());
    }
}
