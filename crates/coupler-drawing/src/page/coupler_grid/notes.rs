//! The notes of a page, which explain its table and graphs, and the numbers that the table has rounded.

use super::super::CouplerGridPage;
use super::super::area::Area;
use super::super::marks::driver;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::typography::format_fixed;
use super::columns::{DWELL_TITLE, coordinates_of, percent, straight_title};
use super::graphs::{Graphs, POOR_TRANSMISSION};
use super::numbers::{coordinate_decimals, is_rounded};
use super::shown_curve::ShownCurve;
use super::table::Table;
use crate::scene::Anchor;
use coupler_curves::expression::displayed_name;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Input, JointId, JointKind};
use coupler_curves::measure::StraightCriterion;
use coupler_curves::solve::SolvedCell;
use coupler_curves::text::format_in_full;

/// The distance of lines, in ems.
const LEADING: f64 = 1.4;

/// The space before a note, in ems.
const NOTE_GAP: f64 = 0.3;

/// The notes of a page, wrapped to a width: those on the table before those on the graphs, which explain themselves better.
pub(super) struct Notes {
    /// The lines of each note.
    notes: Vec<Vec<String>>,
}

impl Notes {
    /// The notes on what the table and the graphs show.
    pub fn new(
        page: &CouplerGridPage,
        shown: &[ShownCurve],
        (table, graphs): (&Table, Option<&Graphs>),
        width: f64,
        theme: &Theme,
    ) -> Notes {
        let solved = page.panel.solved_cell;
        let mut notes = Vec::new();
        notes.extend(coordinates_note(page, shown));
        // A second group is to another tolerance, with the same meaning.
        let criteria = [page.straight_criterion, StraightCriterion::Tolerance(0.01)];
        let has_column = |criterion: &&StraightCriterion| table.has_group(&straight_title(**criterion));
        notes.extend(criteria.iter().find(has_column).map(|criterion| straight_note(*criterion)));
        if table.has_group(DWELL_TITLE) {
            notes.push(
                "dwell on an arc: the portion that takes the most input of those within 0.05 % of the curve's extent \
                 of a circle; the far end of a link of that radius dwells"
                    .to_owned(),
            );
        }
        if let Some(graphs) = graphs {
            notes.extend(transmission_note(graphs));
            notes.push(match solved.linkage.input() {
                Input::Length => format!("speed: of the point, relative to that of the {}", driver(&solved.linkage)),
                Input::Angle { .. } => {
                    "speed: of the point per radian of input, in crank lengths: that of the crank pin is 1".to_owned()
                }
            });
        }
        Notes { notes: notes.iter().map(|note| text_line(note, Point::origin(), theme).wrap(width)).collect() }
    }

    /// The height of all notes, in millimetres.
    pub fn height(&self, theme: &Theme) -> f64 {
        let lines: usize = self.notes.iter().map(Vec::len).sum();
        theme.note_size * (LEADING * lines as f64 + NOTE_GAP * self.notes.len() as f64)
    }

    /// Draws the notes at the head of a frame, as many as fit whole.
    pub fn draw(&self, area: &impl Area, frame: Rect, page: &CouplerGridPage, theme: &Theme) {
        let bottom = frame.corner.y + frame.size.y * (1.0 + 1e-9);
        let step = LEADING * theme.note_size;
        let mut at = frame.corner;
        for note in &self.notes {
            at.y += NOTE_GAP * theme.note_size;
            if at.y + step * note.len() as f64 > bottom {
                break;
            }
            for line in note {
                at.y += step;
                area.record(text_line(line, at, theme).with_italics(page.heading.symbols).fit_width(frame.size.x));
            }
        }
    }
}

fn text_line(text: &str, at: Point, theme: &Theme) -> super::super::element::TextLine {
    theme.text_line(text, at, Anchor::Start, theme.note_size, theme.grey)
}

fn transmission_note(graphs: &Graphs) -> Option<String> {
    let angles = graphs.transmission.as_ref()?;
    let unit = graphs.range.unit();
    let [least, greatest] =
        angles.extremes.map(|[input, angle]| format!("{angle:.1}° at {}{unit}", format_rounded(input)));
    let good = 180.0 - POOR_TRANSMISSION;
    Some(format!(
        "transmission angle μ: least {least} of input, greatest {greatest}; the bands are below {POOR_TRANSMISSION}° and \
         above {good}°"
    ))
}

/// An input, with a decimal if it is not a whole number.
pub(super) fn format_rounded(input: f64) -> String {
    let text = format_fixed(input, 1);
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// What the coordinates of points are, and those in full that the table has rounded.
fn coordinates_note(page: &CouplerGridPage, shown: &[ShownCurve]) -> Option<String> {
    let linkage = &page.panel.solved_cell.linkage;
    let name = |joint: JointId| displayed_name(&linkage.joints[joint].name);
    let pairs: Vec<[f64; 2]> = shown.iter().filter_map(|s| coordinates_of(page, s)).collect();
    let is_foot = |joint: JointId| matches!(linkage.joints[joint].kind, JointKind::Slot { .. });
    let base = |s: &ShownCurve| match linkage.joints[s.curve.joint].kind {
        JointKind::Rigid { base, .. } if !base.into_iter().any(is_foot) => Some(base),
        _ => None,
    };
    let first = shown.first().filter(|_| !pairs.is_empty())?;
    let meaning = match base(first).filter(|first| shown.iter().all(|s| base(s) == Some(*first))) {
        Some(base) => {
            let [from, to] = base.map(name);
            format!("along, across: coordinates on the link, from {from} towards {to} and to the left of that line")
        }
        // The base of a point on a body that slides is in the list of joints.
        None => "along, across: coordinates on the link, along its line and to the left of it".to_owned(),
    };
    let rounded: Vec<String> =
        [0, 1].into_iter().flat_map(|k| rounded_in_full(pairs.iter().map(|pair| pair[k]))).collect();
    Some(if rounded.is_empty() { meaning } else { format!("{meaning}; in full: {}", rounded.join(", ")) })
}

/// The numbers of a column in full that it does not show in full, without repetition.
fn rounded_in_full(values: impl Iterator<Item = f64>) -> Vec<String> {
    let values: Vec<f64> = values.collect();
    let decimals = coordinate_decimals(&values);
    let mut texts: Vec<String> = Vec::new();
    for text in values.iter().copied().filter(|value| is_rounded(*value, decimals)).map(format_in_full) {
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    texts
}

fn straight_note(criterion: StraightCriterion) -> String {
    match criterion {
        StraightCriterion::Tolerance(tolerance) => format!(
            "straight to {0} %: the longest portion in a strip no wider than {0} % of its length; from and over: the input at which it begins, and that it \
             takes",
            percent(tolerance)
        ),
        StraightCriterion::Input(span) => {
            format!("straightest: the portion in the narrowest strip that takes {} of input", format_in_full(span))
        }
        StraightCriterion::Length(length) => {
            format!("straightest: the portion in the narrowest strip that is {} long", format_in_full(length))
        }
    }
}

/// The inputs of a list, with their unit.
pub(super) fn format_inputs(solved: &SolvedCell, inputs: &[f64]) -> String {
    let texts: Vec<String> = inputs
        .iter()
        .map(|&input| format!("{}{}", format_rounded(input), solved.linkage.input().unit_sign()))
        .collect();
    match texts.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => texts.concat(),
    }
}
