//! The outlines of a drawing, and which of them is a path.

use std::collections::HashMap;

use coupler_curves::geometry::{Bounds, Point, Vector, cross};
use coupler_curves::numerical::equal_parts;
use kurbo::{Affine, BezPath, PathEl};

use crate::outline::{Outline, ReadOptions, Reading, choose};

/// Points at equal distances along an outline: as many as are needed to see its shape.
const POINTS: usize = 100;

/// How near a chord is to a curve, relative to the extent of the outline.
const FLATNESS: f64 = 1e-5;

/// A gap is closed that is no greater than this part of the extent: drawing programs round coordinates.
const CLOSED: f64 = 1e-6;

/// Ends of strokes are one point if they are no further apart than this part of the extent of both.
const JOINED: f64 = 1e-5;

/// The most points of all outlines together.
const MAX_POINTS: usize = 2_000_000;

/// The coordinates whose squares have no rounding to zero or infinity.
const RANGE: std::ops::RangeInclusive<f64> = 1e-140..=1e140;

/// How surely a stroke is the path, from what is drawn: the most likely first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// What this program marks as the curve.
    Curve,
    /// A line.
    Stroke,
    /// The border of an area without a line.
    Fill,
}

/// A stroke or the border of an area.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// At least two points; of a closed one the first is repeated.
    pub points: Vec<Point>,
    pub kind: Kind,
    /// Its id in SVG, its layer in DXF.
    pub id: Option<String>,
    /// Strokes of one style that share an end are one outline.
    pub style: String,
}

impl Piece {
    fn is_closed(&self) -> bool {
        self.points.first() == self.points.last()
    }

    fn extent(&self) -> f64 {
        Bounds::from_points(self.points.iter().copied()).size().max()
    }

    fn length(&self) -> f64 {
        length(&self.points)
    }

    /// Whether it is a straight line or a rectangle with sides along the axes, as of a page, a frame or an axis.
    fn is_frame(&self) -> bool {
        const STRAIGHT: f64 = 1e-4;
        let extent = self.extent();
        let corners = corners(&self.points, STRAIGHT * extent);
        let is_along_axis = |pair: &[Point]| {
            let step = pair[1] - pair[0];
            step.x.abs().min(step.y.abs()) <= STRAIGHT * extent
        };
        corners.len() == 2 || corners.len() <= 6 && corners.windows(2).all(is_along_axis)
    }
}

/// The points of a polyline at which it turns, and its ends.
fn corners(points: &[Point], tolerance: f64) -> Vec<Point> {
    let mut corners: Vec<Point> = points[..1].to_vec();
    for (k, point) in points.iter().enumerate().skip(1) {
        let last = corners[corners.len() - 1];
        let Some(next) = points.get(k + 1) else {
            corners.push(*point);
            break;
        };
        let chord = *next - last;
        let is_beyond = (*point - last).dot(&chord) < 0.0 || (*point - *next).dot(&chord) > 0.0;
        let distance = cross(chord, *point - last).abs();
        if is_beyond || distance > tolerance * chord.norm() {
            corners.push(*point);
        }
        // More are no frame.
        if corners.len() > 8 {
            break;
        }
    }
    corners
}

/// The polylines along the parts of a path, from its plane to that of the drawing by a transform, with y pointing up. `count` is the number
/// of points so far.
///
/// # Errors
/// It has coordinates that are too large or too small, or there are too many points.
pub(crate) fn polylines(path: &BezPath, transform: Affine, count: &mut usize) -> Result<Vec<Vec<Point>>, String> {
    let path = transform * path;
    let bounds = path.control_box();
    let extent = bounds.width().max(bounds.height());
    if extent == 0.0 {
        return Ok(Vec::new());
    }
    let greatest = [bounds.x0, bounds.y0, bounds.x1, bounds.y1].into_iter().map(f64::abs).fold(0.0, f64::max);
    if !(RANGE.contains(&extent) && greatest.is_finite() && *RANGE.end() >= greatest) {
        return Err(format!(
            "it has an outline of extent {extent:e} with coordinates up to {greatest:e}, which is too large or too small to be read"
        ));
    }
    let centre = bounds.center();
    let unit = Affine::scale(1.0 / extent) * Affine::translate(-centre.to_vec2());
    let up = |p: kurbo::Point| Point::new(centre.x + extent * p.x, -(centre.y + extent * p.y));
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut is_full = false;
    kurbo::flatten(unit * path, FLATNESS, |element| {
        *count += 1;
        is_full |= *count > MAX_POINTS;
        match (element, parts.last_mut()) {
            _ if is_full => {}
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
        }
    });
    if is_full {
        return Err(format!("its outlines have more than {MAX_POINTS} points: leave some out"));
    }
    for part in &mut parts {
        let (first, last) = (part[0], part.len() - 1);
        if last > 0 && (part[last] - first).norm() <= CLOSED * extent {
            part[last] = first;
        }
    }
    parts.retain(|part| length(part) > 0.0);
    Ok(parts)
}

fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// The path in a drawing: the outline that is chosen, or else the longest of those that are most likely the path: the curve of an own plate,
/// strokes, areas; and straight lines and upright rectangles only if there is nothing else. As points at equal distances.
///
/// # Errors
/// There is no outline, or not the one that is chosen.
pub(crate) fn outline_of(pieces: Vec<Piece>, options: &ReadOptions) -> Result<Outline, String> {
    let pieces = join(pieces);
    let order = |piece: &Piece| (piece.is_frame(), piece.kind);
    let index = match options.outline {
        Some(chosen) => {
            let ids: Vec<Option<&str>> = pieces.iter().map(|piece| piece.id.as_deref()).collect();
            choose([options.outline_option, chosen], &ids, "outline")?
        }
        None => {
            let ranked = pieces.iter().enumerate().map(|(k, piece)| (order(piece), piece.length(), k));
            let best = ranked.reduce(|best, other| {
                let is_better = other.0 < best.0 || other.0 == best.0 && other.1 > best.1;
                if is_better { other } else { best }
            });
            best.map(|(_, _, k)| k).ok_or("it shows no outline")?
        }
    };
    let piece = &pieces[index];
    let is_closed = piece.is_closed();
    let points = spaced_evenly(&piece.points, is_closed);
    let mut outline = Outline::new(points, None, is_closed.then_some(true));
    outline.reading = Reading::of(describe_taken(&pieces, index, options));
    Ok(outline)
}

/// Which outline was taken.
fn describe_taken(pieces: &[Piece], index: usize, options: &ReadOptions) -> String {
    let piece = &pieces[index];
    let id = piece.id.as_ref().map_or(String::new(), |id| format!(" `{id}`"));
    let kind = match piece.kind {
        _ if piece.is_frame() => "a straight line or a rectangle",
        Kind::Curve => "a curve of this program",
        Kind::Stroke => "a line",
        Kind::Fill => "the border of an area",
    };
    let size = Bounds::from_points(piece.points.iter().copied()).size();
    let mut taken = format!(
        "outline {} of {}{id}, {kind} of {:.6} by {:.6}",
        index + 1,
        pieces.len(),
        Short(size.x),
        Short(size.y)
    );
    if options.outline.is_none() && pieces.len() > 1 {
        let alike =
            pieces.iter().filter(|other| (other.is_frame(), other.kind) == (piece.is_frame(), piece.kind)).count();
        let why = if alike > 1 { format!(", the longest of {alike} such") } else { String::new() };
        taken += &format!("{why}; {}N or ID takes another", options.outline_option);
    }
    taken
}

/// A number in at most six significant digits.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&coupler_find::format_length(self.0, self.0))
    }
}

/// Joins open strokes of one kind and style whose ends are in one place, in which no other ends; in the order of the first of each outline.
fn join(pieces: Vec<Piece>) -> Vec<Piece> {
    let is_open = |piece: &Piece| piece.kind == Kind::Stroke && !piece.is_closed();
    let bounds = Bounds::from_points(
        pieces.iter().filter(|piece| is_open(piece)).flat_map(|piece| piece.points.iter().copied()),
    );
    let tolerance = JOINED * bounds.size().max();
    if !(tolerance.is_finite() && tolerance > 0.0) {
        return pieces;
    }
    let partners = partners(&pieces, (bounds.min, tolerance), is_open);
    let mut rest: Vec<Option<Piece>> = pieces.into_iter().map(Some).collect();
    let mut joined = Vec::with_capacity(rest.len());
    for k in 0..rest.len() {
        let Some(mut piece) = rest[k].take() else { continue };
        let [start, end] = [2 * k, 2 * k + 1];
        extend(&mut piece.points, [end, start], &partners, &mut rest);
        if !piece.is_closed() {
            piece.points.reverse();
            extend(&mut piece.points, [start, end], &partners, &mut rest);
            piece.points.reverse();
        }
        joined.push(piece);
    }
    joined
}

/// Appends the pieces that follow from an end of a chain on, whose other end is `start`, and closes it if that is reached.
fn extend(
    points: &mut Vec<Point>,
    [mut end, start]: [usize; 2],
    partners: &[Option<usize>],
    rest: &mut [Option<Piece>],
) {
    while let Some(next) = partners[end] {
        if next == start {
            points.push(points[0]);
            return;
        }
        let Some(mut piece) = rest[next / 2].take() else { return };
        if next % 2 == 1 {
            piece.points.reverse();
        }
        points.extend_from_slice(&piece.points[1..]);
        end = next ^ 1;
    }
}

/// For both ends of each piece, 2 k the first and 2 k + 1 the last of piece k, the one other end in its place, of a piece of the same style.
/// Ends are in cells as large as the tolerance, from the corner of all on; where they crowd, none has one.
fn partners(
    pieces: &[Piece],
    (corner, tolerance): (Point, f64),
    is_open: impl Fn(&Piece) -> bool,
) -> Vec<Option<usize>> {
    const CROWD: usize = 16;
    let place = |end: usize| {
        let points = &pieces[end / 2].points;
        if end.is_multiple_of(2) { points[0] } else { points[points.len() - 1] }
    };
    let cell = |end: usize| {
        let from = (place(end) - corner) / tolerance;
        [from.x, from.y].map(|value| value.floor() as i64)
    };
    let ends: Vec<usize> = (0..2 * pieces.len()).filter(|end| is_open(&pieces[end / 2])).collect();
    let mut cells: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    for end in &ends {
        cells.entry(cell(*end)).or_default().push(*end);
    }
    let mut partners = vec![None; 2 * pieces.len()];
    for end in ends {
        let [x, y] = cell(end);
        let near: Vec<&Vec<usize>> = (0..9).filter_map(|k| cells.get(&[x + k % 3 - 1, y + k / 3 - 1])).collect();
        if near.iter().any(|cell| cell.len() > CROWD) {
            continue;
        }
        let is_here = |other: &usize| *other != end && (place(*other) - place(end)).norm() <= tolerance;
        let others: Vec<usize> = near.into_iter().flatten().copied().filter(is_here).collect();
        if let [other] = others[..]
            && pieces[other / 2].style == pieces[end / 2].style
        {
            partners[end] = Some(other);
        }
    }
    // An end of which the other one has a further neighbour has none.
    (0..partners.len()).map(|end| partners[end].filter(|other| partners[*other] == Some(end))).collect()
}

/// Points at equal distances along a polyline: of a closed one without the last, which is the first. Of one without a length,
/// its ends.
fn spaced_evenly(path: &[Point], is_closed: bool) -> Vec<Point> {
    let segments: Vec<Vector> = path.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let lengths: Vec<f64> = segments.iter().map(|segment| segment.norm()).collect();
    let places = equal_parts(&lengths, if is_closed { POINTS } else { POINTS - 1 });
    if places.is_empty() {
        return vec![path[0], path[path.len() - 1]];
    }
    places.iter().take(POINTS).map(|at| path[at.segment] + segments[at.segment] * at.fraction).collect()
}

/// A part of a text for a message.
pub(crate) fn shorten(text: &str) -> String {
    const LENGTH: usize = 40;
    match text.char_indices().nth(LENGTH) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
