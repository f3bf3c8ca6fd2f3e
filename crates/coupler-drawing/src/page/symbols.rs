//! The line at the foot of a page that explains the symbols on it.

use super::GuidedBody;
use super::area::Area;
use super::body::{self, Axes};
use super::element::{Drawing, TextLine};
use super::heading::{Heading, foot_baseline, margins};
use super::marks;
use super::mechanism;
use super::motion_marks::{self, TickSteps};
use super::scales::format_scale;
use super::theme::Theme;
use crate::scene::{Anchor, Circle, Color, Item, Path, Polyline, Stroke, Text};
use coupler_curves::expression::join_names;
use coupler_curves::family::LengthUnit;
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{Joint, JointId, JointKind, LinkOutline, Linkage};
use coupler_curves::solve::SolvedCell;

/// A symbol and its meaning.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Symbol {
    pub mark: Mark,
    pub meaning: String,
}

/// A mark as it is drawn on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mark {
    /// The fixed pivot of the crank.
    CrankPivot,
    /// Another fixed pivot.
    Pivot,
    /// A traced point in the pose.
    TracedPoint(Color),
    /// The pitch circle of a gear.
    PitchCircle,
    /// A link in an ink.
    Link(Color),
    /// A curve in dashes.
    Dashes(Color),
    /// The start of a curve, with its direction.
    Start(Color),
    /// A tick across a curve.
    Tick(Color),
    /// A limit of the input.
    Limit(Color),
    /// The part of a curve that the figure of its source does not show.
    Light(Color),
    /// A straight portion.
    Band(Color),
    /// The linkage in another pose.
    Ghost,
    /// An axis of symmetry.
    Axis,
    /// A pose of a body.
    Pose,
    /// A line in a stroke.
    Line(Stroke),
    /// A single place in an ink.
    Place(Color),
    /// A scale bar.
    ScaleBar,
    /// A letter or a sign in the text of the page.
    Letter(&'static str),
}

/// The symbols of the joints of a linkage, of which the first that is traced is in an ink.
pub(super) fn of_joints(solved: &SolvedCell, ink: Color) -> Vec<Symbol> {
    let pivots = solved.linkage.pivots();
    let crank_pivot = solved.linkage.crank().map(|[pivot, _]| pivot).filter(|pivot| pivots.contains(pivot));
    let mut symbols = Vec::new();
    let mut add = |mark: Mark, meaning: String| symbols.push(Symbol { mark, meaning });
    if crank_pivot.is_some() {
        add(Mark::CrankPivot, "crank's pivot".to_owned());
    }
    if pivots.iter().any(|pivot| Some(*pivot) != crank_pivot) {
        add(Mark::Pivot, "fixed pivot".to_owned());
    }
    add(Mark::TracedPoint(ink), "traced point".to_owned());
    let is_gear = |joint: &Joint| matches!(joint.kind, JointKind::Gear { .. } | JointKind::Rack { .. });
    if solved.linkage.joints.iter().any(is_gear) {
        add(Mark::PitchCircle, "pitch circle of a gear".to_owned());
    }
    symbols
}

/// The symbols of the linkage and of the motion along its curves, of which the first is in an ink; `period` is that of
/// dashes.
pub(super) fn of_cell(solved: &SolvedCell, ink: Color, period: f64) -> Vec<Symbol> {
    let mut symbols = of_joints(solved, ink);
    let mut add = |mark: Mark, meaning: String| symbols.push(Symbol { mark, meaning });
    let unit = solved.linkage.input().unit_sign();
    add(Mark::Dashes(ink), format!("dash and gap: {period}{unit} of input"));
    add(Mark::Start(ink), "start and direction".to_owned());
    let tick = TickSteps::new(&solved.linkage, period).tick;
    // A curve with a smaller range of the input may have no tick.
    if solved.motion.circuits.iter().flat_map(|circuit| &circuit.passes).any(|pass| pass.input_length() >= tick) {
        add(Mark::Tick(ink), format!("every {tick}{unit} of input"));
    }
    symbols
}

/// The inks of chains of links that are drawn in one, such as those of cognates.
pub(super) fn of_chains(linkage: &Linkage, theme: &Theme) -> Vec<Symbol> {
    let symbol = |joints: &[JointId], ink: Color| {
        let names = joints.iter().map(|&joint| linkage.joints[joint].name.as_str()).collect::<Vec<_>>();
        let meaning = format!("links of {}", join_names(&names));
        Symbol { mark: Mark::Link(ink), meaning }
    };
    let is_in_chain = |outline: &LinkOutline| {
        linkage.chains.iter().any(|chain| outline.joints.iter().all(|joint| chain.contains(joint)))
    };
    let others = linkage.link_outlines().into_iter().filter(|outline| !is_in_chain(outline));
    let mut others: Vec<JointId> = others.flat_map(|outline| outline.joints).collect();
    others.sort_unstable();
    others.dedup();
    let first = (!linkage.chains.is_empty() && !others.is_empty()).then(|| symbol(&others, theme.ink));
    let chains = linkage.chains.iter().enumerate();
    first.into_iter().chain(chains.map(|(k, chain)| symbol(chain, mechanism::chain_ink(k, theme)))).collect()
}

/// The poses of a body, and the places that belong to them.
pub(super) fn of_body(body: &GuidedBody, theme: &Theme) -> Vec<Symbol> {
    let meaning = match body.step() {
        1 => "pose of the body".to_owned(),
        step => format!("pose of the body, one of each {step}"),
    };
    let pose = (!body.poses.is_empty()).then_some(Symbol { mark: Mark::Pose, meaning });
    let places = body.places.iter().map(|places| {
        let stroke = places.stroke(theme);
        let mark = if places.lines.is_empty() { Mark::Place(stroke.color) } else { Mark::Line(stroke) };
        Symbol { mark, meaning: places.label.clone() }
    });
    pose.into_iter().chain(places).collect()
}

/// The scale bar, which says the unit of lengths, and, of a scale in millimetres to a unit that is common to all figures, that scale or
/// what length on paper the crank has, or else a unit.
pub(super) fn scale_bar(scale: Option<f64>, crank: Option<f64>, unit: Option<LengthUnit>) -> Symbol {
    let meaning = match (scale, crank, unit) {
        (Some(scale), _, Some(unit)) => format!("scale {}, {}", format_scale(scale, Some(unit)), unit.note()),
        (None, _, Some(unit)) => unit.note(),
        (Some(scale), Some(crank), None) => format!("crank = {:.1} mm on paper", crank * scale),
        (Some(scale), None, None) => format!("one unit of length = {} mm", marks::format_with_digits(scale, 3)),
        (None, _, None) => "units of length".to_owned(),
    };
    Symbol { mark: Mark::ScaleBar, meaning }
}

/// The symbols in lines that are not wider than `width`.
pub(super) fn lines(symbols: &[Symbol], width: f64, theme: &Theme) -> Vec<Vec<Symbol>> {
    let mut lines: Vec<(f64, Vec<Symbol>)> = Vec::new();
    for symbol in symbols {
        let own = symbol.width(theme);
        match lines.last_mut() {
            Some((used, line)) if *used + gap(theme) + own <= width => {
                *used += gap(theme) + own;
                line.push(symbol.clone());
            }
            _ => lines.push((own, vec![symbol.clone()])),
        }
    }
    lines.into_iter().map(|(_, line)| line).collect()
}

/// The lines of symbols at the foot of a page, left of its folio, or above it where one is too wide for that, with their positions; and the
/// greatest y of the contents above them and the folio.
pub(super) fn at_foot(
    page: Vector,
    heading: &Heading,
    symbols: &[Symbol],
    theme: &Theme,
) -> (Vec<(Point, Vec<Symbol>)>, f64) {
    const LEADING: f64 = 1.45;
    let [_, bottom, _] = margins(theme);
    let [left, right] = [theme.border + theme.margin, page.x - theme.border - theme.margin];
    let folio_height = heading.folio_height(page, theme);
    let beside = right - left - heading.folio_width(page, theme) - 2.0 * theme.note_size;
    let step = LEADING * theme.note_size;
    let (width, foot) = match symbols.iter().all(|symbol| symbol.width(theme) <= beside) {
        true => (beside, 0.0),
        false => (right - left, folio_height + step),
    };
    let lines = lines(symbols, width, theme);
    let height = foot + step * lines.len().saturating_sub(1) as f64;
    let above = page.y - bottom - height.max(folio_height);
    let first = foot_baseline(page, theme) - height;
    let placed = lines.into_iter().enumerate().map(|(k, line)| (Point::new(left, first + step * k as f64), line));
    (placed.collect(), above)
}

/// Draws a line of symbols from a point on its baseline.
pub(super) fn draw(area: &impl Area, line: &[Symbol], at: Point, theme: &Theme) {
    let mut at = at;
    for symbol in line {
        let middle = at + Vector::new(mark_width(symbol.mark, theme) / 2.0, -0.32 * theme.note_size);
        let items = symbol.mark.items(middle, theme);
        area.record(Drawing { class: "symbol", title: String::new(), items });
        let text_at = at + Vector::new(mark_width(symbol.mark, theme) + 0.45 * theme.note_size, 0.0);
        area.record(symbol.text(text_at, theme));
        at.x += symbol.width(theme) + gap(theme);
    }
}

impl Symbol {
    fn text(&self, at: Point, theme: &Theme) -> TextLine {
        theme.text_line(&self.meaning, at, Anchor::Start, theme.note_size, theme.grey)
    }

    fn width(&self, theme: &Theme) -> f64 {
        mark_width(self.mark, theme) + 0.45 * theme.note_size + self.text(Point::origin(), theme).text.width()
    }
}

/// The space between a meaning and the next symbol.
fn gap(theme: &Theme) -> f64 {
    1.3 * theme.note_size
}

fn mark_width(mark: Mark, theme: &Theme) -> f64 {
    let em = theme.note_size;
    match mark {
        Mark::CrankPivot | Mark::Pivot => 3.0 * theme.joint_radius,
        Mark::TracedPoint(_) => 2.0 * theme.joint_radius,
        Mark::PitchCircle => 3.0 * theme.joint_radius,
        Mark::Limit(_) | Mark::Place(_) => theme.joint_radius,
        Mark::Start(_) => 2.0 * theme.joint_radius,
        Mark::Tick(_) => 0.9 * em,
        Mark::Dashes(_)
        | Mark::Link(_)
        | Mark::Light(_)
        | Mark::Band(_)
        | Mark::Ghost
        | Mark::Axis
        | Mark::Line(_)
        | Mark::ScaleBar => 2.0 * em,
        Mark::Pose => 1.2 * em,
        Mark::Letter(letter) => theme.typeface.regular().width(letter, em),
    }
}

impl Mark {
    /// The items of the mark about its middle.
    pub fn items(self, middle: Point, theme: &Theme) -> Vec<Item> {
        let half = mark_width(self, theme) / 2.0;
        let along = |x: f64| middle + Vector::new(x * half, 0.0);
        let line = |from: f64, to: f64| Polyline { points: vec![along(from), along(to)], is_closed: false };
        let stroked = |polylines, stroke| Item::Path(Path { polylines, stroke: Some(stroke), fill: None });
        match self {
            Mark::CrankPivot => mechanism::pivot_items(middle, true, theme.ink, theme),
            Mark::Pivot => mechanism::pivot_items(middle, false, theme.ink, theme),
            Mark::TracedPoint(ink) => {
                let stroke = Some(theme.stroke(ink, theme.fine_width));
                vec![Item::Circle(Circle {
                    centre: middle,
                    radius: theme.joint_radius,
                    stroke,
                    fill: Some(theme.paper),
                })]
            }
            Mark::PitchCircle => {
                let stroke = Some(theme.stroke(theme.grey, theme.hair_width));
                vec![Item::Circle(Circle { centre: middle, radius: 1.5 * theme.joint_radius, stroke, fill: None })]
            }
            Mark::Dashes(ink) => vec![
                stroked(vec![line(-1.0, 1.0)], theme.stroke(theme.faded(ink), theme.hair_width)),
                stroked(vec![line(-1.0, -0.4), line(0.0, 0.6)], theme.stroke(ink, theme.curve_width)),
            ],
            Mark::Link(ink) => vec![stroked(vec![line(-1.0, 1.0)], theme.stroke(ink, theme.link_width))],
            Mark::Start(ink) => vec![motion_marks::start_item(middle, Vector::new(1.0, 0.0), ink, theme)],
            Mark::Tick(ink) => vec![
                stroked(vec![line(-1.0, 1.0)], theme.stroke(ink, theme.curve_width)),
                motion_marks::tick_item(middle, Vector::new(1.0, 0.0), ink, theme),
            ],
            Mark::Limit(ink) => {
                let radius = 0.5 * theme.joint_radius;
                vec![Item::Circle(Circle { centre: middle, radius, stroke: None, fill: Some(ink) })]
            }
            Mark::Light(ink) => vec![stroked(vec![line(-1.0, 1.0)], theme.stroke(theme.faded(ink), theme.fine_width))],
            Mark::Band(ink) => {
                vec![stroked(vec![line(-1.0, 1.0)], theme.stroke(theme.faded(ink), 3.0 * theme.curve_width))]
            }
            Mark::Ghost => vec![stroked(vec![line(-1.0, 1.0)], theme.stroke(theme.hairline, theme.fine_width))],
            Mark::Axis => {
                let lines = vec![line(-1.0, -0.4), line(-0.15, -0.05), line(0.2, 1.0)];
                vec![stroked(lines, theme.stroke(theme.grey, theme.hair_width))]
            }
            Mark::Pose => {
                Axes::new(along(-1.0) + Vector::new(0.0, 0.3 * half), 0.0, 1.8 * half).items(theme.ink, theme)
            }
            Mark::Line(stroke) => vec![stroked(vec![line(-1.0, 1.0)], stroke)],
            Mark::Place(ink) => vec![body::mark_item(middle, ink, theme)],
            Mark::ScaleBar => {
                let tick = Vector::new(0.0, 0.25 * theme.note_size);
                let end = |x: f64| Polyline { points: vec![along(x) - tick, along(x) + tick], is_closed: false };
                vec![stroked(vec![line(-1.0, 1.0), end(-1.0), end(1.0)], theme.stroke(theme.grey, theme.hair_width))]
            }
            Mark::Letter(letter) => {
                let at = middle + Vector::new(0.0, 0.32 * theme.note_size);
                let text = theme.text_line(letter, at, Anchor::Middle, theme.note_size, theme.grey);
                vec![Item::Text(Text { position: at, ..text.text })]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Paper;

    /// The lines of symbols are beside the folio where they have room there, and above its lines otherwise.
    #[test]
    fn symbols_and_folio_do_not_overlap() {
        let paper = Paper { width: 105.0, height: 148.0 };
        let theme = Theme::default().for_paper(paper);
        let page = Vector::new(paper.width, paper.height);
        let title = "An atlas with a title that takes several lines at the foot of its pages";
        let heading = Heading::new("Family").with_atlas_title(title);
        assert!(heading.folio_height(page, &theme) > 0.0);
        let symbol = |meaning: &str| Symbol { mark: Mark::Pivot, meaning: meaning.to_owned() };
        let folio_left = page.x - theme.border - theme.margin - heading.folio_width(page, &theme);
        let first_folio_line = foot_baseline(page, &theme) - heading.folio_height(page, &theme);
        for meaning in ["pivot", "longest straight portion, within ± 0.0005 of its length"] {
            let (lines, above) = at_foot(page, &heading, &[symbol("pivot"), symbol(meaning)], &theme);
            let is_wide = meaning.len() > 10;
            for (at, line) in &lines {
                let right = at.x + line.iter().map(|symbol| symbol.width(&theme) + gap(&theme)).sum::<f64>();
                assert!(right <= page.x, "{meaning}");
                assert!(above < at.y - theme.note_size, "{meaning}");
                assert_eq!(at.y < first_folio_line - theme.note_size, is_wide, "{meaning}");
                assert!(is_wide || right <= folio_left, "{meaning}");
            }
        }
    }
}
