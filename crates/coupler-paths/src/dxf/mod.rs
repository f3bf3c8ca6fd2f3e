//! The outlines of a drawing in DXF.
//!
//! # Source
//! Autodesk, *DXF Reference*.

mod curves;
mod groups;

use std::collections::HashSet;
use std::f64::consts::TAU;

use coupler_curves::geometry::{Bounds, Point, Vector};

use crate::drawing::{Kind, Piece, outline_of};
use crate::outline::{Outline, ReadOptions};
use curves::{bulge_to, ellipse, spline};
use groups::{Group, Record, groups};

/// The most points of all outlines together.
const MAX_POINTS: usize = 2_000_000;

/// Whether a text is DXF: it begins with a section, or with comments.
pub(crate) fn is_dxf(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).skip_while(|line| line.is_empty());
    match (lines.next(), lines.next()) {
        (Some("0"), Some("SECTION")) => true,
        (Some("999"), Some(_)) => lines.next().is_some_and(|code| matches!(code, "999" | "0")),
        _ => false,
    }
}

/// The path in a drawing: its lines, polylines, circles, ellipses and splines, joined at their ends on each layer. In the drawing's unit.
///
/// # Errors
/// The drawing cannot be read, or has no such outline.
pub(crate) fn parse_dxf(text: &str, options: &ReadOptions) -> Result<Outline, String> {
    let groups = groups(text)?;
    let is_own = groups.first().is_some_and(|first| first.code == 999 && first.value.starts_with("coupler-atlas"));
    let records = Record::all(&groups);
    let hidden = hidden_layers(&records);
    let mut reader = EntityReader { is_own, pieces: Vec::new(), points: 0, not_read: Vec::new() };
    let mut records = section(&records, "ENTITIES").iter();
    while let Some(record) = records.next() {
        let vertices = match record.kind {
            "POLYLINE" => {
                let rest = records.as_slice();
                let count = rest.iter().take_while(|record| record.kind == "VERTEX").count();
                records = rest[count..].iter();
                &rest[..count]
            }
            _ => &[],
        };
        let is_hidden = hidden.contains(record.text(8).unwrap_or("0"))
            || record.flags(60) == 1
            // On the paper, not in the model.
            || record.flags(67) == 1;
        if !is_hidden {
            reader.read(record, vertices)?;
        }
    }
    let EntityReader { pieces, mut not_read, .. } = reader;
    not_read.sort_unstable();
    not_read.dedup();
    let without = match &not_read[..] {
        [] => String::new(),
        kinds => {
            let remedy = if kinds.contains(&"INSERT") { ", which places a block: explode it" } else { "" };
            format!("; not read: {}{remedy}", kinds.join(", "))
        }
    };
    if pieces.is_empty() {
        return Err(format!(
            "the drawing has no line, polyline, circle, arc, ellipse or spline that is shown{without}"
        ));
    }
    let mut outline = outline_of(pieces, options).map_err(|error| format!("the drawing: {error}"))?;
    outline.reading.taken += &format!("; in {}{without}", unit(&groups));
    Ok(outline)
}

/// The records of a section.
fn section<'r, 'g, 'a>(records: &'r [Record<'g, 'a>], name: &str) -> &'r [Record<'g, 'a>] {
    let is_start = |record: &Record| record.kind == "SECTION" && record.text(2) == Some(name);
    let Some(start) = records.iter().position(is_start) else { return &[] };
    let rest = &records[start + 1..];
    &rest[..rest.iter().position(|record| record.kind == "ENDSEC").unwrap_or(rest.len())]
}

/// The layers that are off, or frozen.
fn hidden_layers<'a>(records: &[Record<'_, 'a>]) -> HashSet<&'a str> {
    let layers = section(records, "TABLES").iter().filter(|record| record.kind == "LAYER");
    let hidden = layers.filter(|layer| layer.flags(62) < 0 || layer.flags(70) & 1 != 0);
    hidden.filter_map(|layer| layer.text(2)).collect()
}

/// The unit of the drawing.
fn unit(groups: &[Group]) -> &'static str {
    let variable = groups.iter().position(|group| group.code == 9 && group.value == "$INSUNITS");
    match variable.and_then(|k| groups.get(k + 1)).map_or("", |group| group.value) {
        "1" => "inches",
        "2" => "feet",
        "4" => "mm",
        "5" => "cm",
        "6" => "m",
        _ => "the drawing's unit",
    }
}

/// Collects the outlines of entities.
struct EntityReader<'a> {
    /// Whether this program has written the drawing, with the curve on a layer of its own.
    is_own: bool,
    pieces: Vec<Piece>,
    /// The number of points so far.
    points: usize,
    /// The kinds of entities that may have outlines and are not read.
    not_read: Vec<&'a str>,
}

impl<'a> EntityReader<'a> {
    fn read(&mut self, record: &Record<'_, 'a>, vertices: &[Record]) -> Result<(), String> {
        let mut points = match record.kind {
            "LINE" => vec![record.point(10)?, record.point(11)?],
            "LWPOLYLINE" => light_polyline(record)?,
            "POLYLINE" if record.flags(70) & (16 | 64) == 0 => polyline(record, vertices)?,
            "CIRCLE" | "ARC" => circle(record)?,
            "ELLIPSE" => {
                let (centre, major, ratio) = (record.point(10)?, record.point(11)?.coords, record.needed(40)?);
                let side = if record.number(230)?.unwrap_or(1.0) < 0.0 { -ratio } else { ratio };
                let [from, to] = [record.number(41)?.unwrap_or(0.0), record.number(42)?.unwrap_or(TAU)];
                let to = if to <= from { to + TAU } else { to };
                closed_if_whole(ellipse(centre, [major, Vector::new(-major.y, major.x) * side], [from, to]), to - from)
            }
            "SPLINE" => spline(record)?,
            "INSERT" | "HATCH" | "POLYLINE" | "MLINE" | "REGION" | "BODY" | "3DSOLID" | "LEADER" | "SOLID"
            | "TRACE" => {
                self.not_read.push(record.kind);
                return Ok(());
            }
            _ => return Ok(()),
        };
        if matches!(record.kind, "LWPOLYLINE" | "POLYLINE" | "CIRCLE" | "ARC") {
            self.place(record, &mut points)?;
        }
        self.points += points.len();
        if self.points > MAX_POINTS {
            return Err(format!("the drawing has outlines of more than {MAX_POINTS} points: leave some out"));
        }
        let size = Bounds::from_points(points.iter().copied()).size().max();
        let greatest = points.iter().map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
        if !greatest.is_finite() || greatest > 1e140 || points.iter().any(|p| p.x.is_nan() || p.y.is_nan()) {
            return Err(format!(
                "line {}: the {} has coordinates up to {greatest:e}, which are too large to be read",
                record.line, record.kind
            ));
        }
        if points.len() < 2 || size <= 1e-140 {
            return Ok(());
        }
        let layer = record.text(8).unwrap_or("0").to_owned();
        let kind = if self.is_own && layer == "CURVE" { Kind::Curve } else { Kind::Stroke };
        self.pieces.push(Piece { points, kind, id: Some(layer.clone()), style: layer });
        Ok(())
    }

    /// Moves points of the plane of an entity to that of the drawing, of which it may be the back.
    fn place(&self, record: &Record, points: &mut [Point]) -> Result<(), String> {
        let normal =
            [(210, 0.0), (220, 0.0), (230, 1.0)].map(|(code, usual)| Ok(record.number(code)?.unwrap_or(usual)));
        let [x, y, z]: [Result<f64, String>; 3] = normal;
        let (x, y, z) = (x?, y?, z?);
        if x.abs().max(y.abs()) > 1e-6 * z.abs() {
            return Err(format!(
                "line {}: the {} is not parallel to the plane of the drawing",
                record.line, record.kind
            ));
        }
        if z < 0.0 {
            points.iter_mut().for_each(|p| p.x = -p.x);
        }
        Ok(())
    }
}

/// Points with the first one repeated exactly, if they are those of a whole turn.
fn closed_if_whole(mut points: Vec<Point>, turn: f64) -> Vec<Point> {
    let last = points.len() - 1;
    if (turn.abs() - TAU).abs() < 1e-6 {
        points[last] = points[0];
    }
    points
}

fn circle(record: &Record) -> Result<Vec<Point>, String> {
    let (centre, radius) = (record.point(10)?, record.needed(40)?);
    let [from, to] = match record.kind {
        "ARC" => [record.needed(50)?, record.needed(51)?].map(f64::to_radians),
        _ => [0.0, TAU],
    };
    // Counter-clockwise.
    let turn = (to - from).rem_euclid(TAU);
    let turn = if turn == 0.0 { TAU } else { turn };
    let axes = [Vector::new(radius, 0.0), Vector::new(0.0, radius)];
    Ok(closed_if_whole(ellipse(centre, axes, [from, from + turn]), turn))
}

/// The points of a polyline with vertices and their bulges.
fn with_bulges(vertices: &[(Point, f64)], is_closed: bool) -> Vec<Point> {
    let Some(((first, _), rest)) = vertices.split_first() else { return Vec::new() };
    let mut points = vec![*first];
    for ((_, bulge), (to, _)) in vertices.iter().zip(rest) {
        bulge_to(&mut points, *to, *bulge);
    }
    if is_closed {
        bulge_to(&mut points, *first, vertices[vertices.len() - 1].1);
    }
    points
}

fn light_polyline(record: &Record) -> Result<Vec<Point>, String> {
    let mut vertices: Vec<(Point, f64)> = Vec::new();
    let mut x = None;
    for group in record.groups {
        match (group.code, x, vertices.last_mut()) {
            (10, ..) => x = Some(group.number()?),
            (20, Some(left), _) => {
                vertices.push((Point::new(left, group.number()?), 0.0));
                x = None;
            }
            (42, None, Some((_, bulge))) => *bulge = group.number()?,
            _ => {}
        }
    }
    Ok(with_bulges(&vertices, record.flags(70) & 1 != 0))
}

fn polyline(record: &Record, vertices: &[Record]) -> Result<Vec<Point>, String> {
    // The control points of a fitted spline are not on it.
    let on_curve = vertices.iter().filter(|vertex| vertex.flags(70) & 16 == 0);
    let vertex = |vertex: &Record| Ok((vertex.point(10)?, vertex.number(42)?.unwrap_or(0.0)));
    let vertices: Vec<(Point, f64)> = on_curve.map(vertex).collect::<Result<_, String>>()?;
    Ok(with_bulges(&vertices, record.flags(70) & 1 != 0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::trig;

    fn drawing(entities: &str) -> String {
        format!(
            "0\nSECTION\n2\nTABLES\n0\nLAYER\n2\noff\n62\n-3\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
        )
    }

    fn read(entities: &str) -> Outline {
        parse_dxf(&drawing(entities), &ReadOptions::default()).unwrap()
    }

    #[test]
    fn lines_and_arcs_are_joined_to_a_slot() {
        // Two lines of length 4, and half circles of radius 1, in any order and direction.
        let slot = "0\nLINE\n8\na\n10\n0\n20\n-1\n11\n4\n21\n-1\n0\nLINE\n8\na\n10\n0\n20\n1\n11\n4\n21\n1\n\
                    0\nARC\n8\na\n10\n4\n20\n0\n40\n1\n50\n-90\n51\n90\n0\nARC\n8\na\n10\n0\n20\n0\n40\n1\n50\n90\n51\n270\n";
        let outline = read(slot);
        assert_eq!((outline.is_closed, outline.points.len()), (Some(true), 100));
        assert!(outline.reading.taken.starts_with("outline 1 of 1 `a`"), "{:?}", outline.reading);
        let distance = |p: &Point| trig::hypot(p.x - p.x.clamp(0.0, 4.0), p.y);
        assert!(outline.points.iter().all(|p| (distance(p) - 1.0).abs() < 1e-4));
    }

    #[test]
    fn circles_and_ellipses_are_closed_and_hidden_layers_left_out() {
        let circle = "0\nCIRCLE\n8\nb\n10\n3\n20\n4\n40\n2\n0\nCIRCLE\n8\noff\n10\n0\n20\n0\n40\n90\n";
        let outline = read(circle);
        assert_eq!(outline.is_closed, Some(true));
        assert!(outline.points.iter().all(|p| ((p - Point::new(3.0, 4.0)).norm() - 2.0).abs() < 1e-4));
        let ellipse = read("0\nELLIPSE\n8\nb\n10\n1\n20\n0\n11\n0\n21\n4\n40\n0.5\n41\n0\n42\n6.283185307179586\n");
        assert!(ellipse.points.iter().all(|p| (trig::hypot((p.x - 1.0) / 2.0, p.y / 4.0) - 1.0).abs() < 1e-3));
        // On the back of the plane.
        let mirrored = read("0\nARC\n8\nb\n10\n3\n20\n0\n40\n1\n50\n0\n51\n90\n230\n-1\n");
        assert!(mirrored.points.iter().all(|p| p.x <= -3.0 + 1e-9 && p.y >= -1e-9));
        assert_eq!(mirrored.is_closed, None);
    }

    #[test]
    fn polylines_have_bulges() {
        let light = "0\nLWPOLYLINE\n8\nc\n70\n1\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n42\n1\n";
        let heavy =
            "0\nPOLYLINE\n8\nc\n70\n1\n0\nVERTEX\n10\n0\n20\n0\n42\n1\n0\nVERTEX\n10\n2\n20\n0\n42\n1\n0\nSEQEND\n";
        for text in [light, heavy] {
            let outline = read(text);
            assert_eq!(outline.is_closed, Some(true));
            assert!(outline.points.iter().all(|p| ((p - Point::new(1.0, 0.0)).norm() - 1.0).abs() < 1e-4));
        }
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        for (entities, expected) in [
            ("", "no line, polyline"),
            ("0\nINSERT\n8\n0\n2\nb\n", "not read: INSERT"),
            ("0\nLINE\n8\n0\n10\nx\n20\n0\n", "`x` is not a number"),
            ("0\nLINE\n8\n0\n10\n0\n20\n0\n", "has no group 11"),
            ("0\nSPLINE\n71\n3\n11\n0\n21\n0\n", "has fit points only"),
            ("0\nCIRCLE\n10\n0\n20\n0\n40\n1e300\n", "too large"),
            ("0\nARC\n10\n0\n20\n0\n40\n1\n50\n0\n51\n9\n210\n1\n220\n0\n230\n0\n", "not parallel"),
            ("a\nb\n", "is not the code of a group"),
        ] {
            let error = parse_dxf(&drawing(entities), &ReadOptions::default()).unwrap_err();
            assert!(error.contains(expected), "{entities}: {error}");
        }
    }
}
