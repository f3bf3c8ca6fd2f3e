//! The band in which a curve stays where each length of its linkage is off by a tolerance.

use super::marks;
use super::plot::Plot;
use super::symbols::{Mark, Symbol};
use super::theme::Theme;
use crate::scene::{Color, Item, Path, Polyline};
use coupler_curves::geometry::{Bounds, Point, Vector, cross};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_curves::text::format_as_written;

/// The symbol of the band, in the ink of the first curve that has one.
pub(super) fn symbol(solved: &SolvedCell, ink: impl Fn(&MeasuredCurve) -> Color, theme: &Theme) -> Option<Symbol> {
    let curve = solved.curves.iter().find(|curve| curve.moves.is_some())?;
    let meaning =
        format!("where the curve may be with every length ± {}", format_as_written(solved.linkage.tolerance?));
    Some(Symbol { mark: Mark::Line(theme.stroke(tint(ink(curve), theme), 5.0 * theme.curve_width)), meaning })
}

fn tint(ink: Color, theme: &Theme) -> Color {
    theme.faded(theme.faded(ink))
}

/// The points of both borders of the band of a curve, pair by pair along it; none without a tolerance.
fn borders(solved: &SolvedCell, curve: &MeasuredCurve) -> Vec<[Point; 2]> {
    let Some((moves, tolerance)) = curve.moves.as_ref().zip(solved.linkage.tolerance) else { return Vec::new() };
    let sides = |(place, move_per_unit): &(Point, Vector)| {
        [place + move_per_unit * tolerance, place - move_per_unit * tolerance]
    };
    let most = marks::greatest_shown_move(solved, curve);
    let is_shown = |(_, move_per_unit): &&(Point, Vector)| move_per_unit.norm() * tolerance <= most;
    moves.worst_along.iter().filter(is_shown).map(sides).collect()
}

/// What the band of a curve covers.
pub(super) fn bounds(solved: &SolvedCell, curve: &MeasuredCurve) -> Bounds {
    Bounds::from_points(borders(solved, curve).into_iter().flatten())
}

/// The band of a curve.
pub(super) fn item(solved: &SolvedCell, curve: &MeasuredCurve, ink: Color, plot: &Plot, theme: &Theme) -> Option<Item> {
    let borders = borders(solved, curve);
    let first = borders.first().filter(|_| solved.circuit(curve).is_closed);
    let on_page = borders.iter().chain(first).map(|pair| pair.map(|point| plot.page_from_plane.apply(point)));
    let on_page: Vec<[Point; 2]> = on_page.collect();
    // Triangles in one sense of rotation, so that the band covers what it crosses, as in bends that are narrower than it.
    let triangles = on_page.windows(2).flat_map(|pair| {
        let ([a, b], [c, d]) = (pair[0], pair[1]);
        [[a, b, c], [b, d, c]]
    });
    let in_one_sense = |[a, b, c]: [Point; 3]| if cross(b - a, c - a) < 0.0 { vec![a, c, b] } else { vec![a, b, c] };
    let polylines: Vec<Polyline> =
        triangles.map(|triangle| Polyline { points: in_one_sense(triangle), is_closed: true }).collect();
    (!polylines.is_empty()).then(|| Item::Path(Path { polylines, stroke: None, fill: Some(tint(ink, theme)) }))
}
