//! The columns of the table: what they contain, and how many of them fit.

use super::super::CouplerGridPage;
use super::super::theme::Theme;
use super::super::typography::format_fixed;
use super::numbers::{coordinate_decimals, is_rounded, significant_decimals};
use super::shown_curve::ShownCurve;
use crate::scene::Anchor;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::Input;
use coupler_curves::measure::{Measure, MeasureKey, MeasureSet, StraightCriterion};
use coupler_curves::solve::MeasuredCurve;
use coupler_curves::text::format_in_full;

/// The measures of columns and description, in addition to those of all pages.
pub const MEASURES: MeasureSet = MeasureSet::EMPTY
    .with(Measure::STRAIGHT_START)
    .with(Measure::STRAIGHT_INPUT)
    .with(Measure::STRAIGHT_10_LENGTH)
    .with(Measure::STRAIGHT_10_INPUT)
    .with(Measure::DWELL_RADIUS)
    .with(Measure::DWELL_START)
    .with(Measure::DWELL_INPUT)
    .with(Measure::CUSPS)
    .with(Measure::OUTPUT_SWING)
    .with(Measure::OUTPUT_STROKE)
    .with(Measure::TIME_RATIO);

/// Columns with a common head.
pub(super) struct ColumnGroup {
    /// The head over the heads of the columns; may be empty.
    pub title: String,
    pub columns: Vec<Column>,
}

/// A column of texts, which are aligned on the right.
pub(super) struct Column {
    pub head: &'static str,
    /// The text of each row.
    pub texts: Vec<String>,
    /// The distance of its right edge from that of the group's left.
    pub right: f64,
}

/// The gap between columns, and between groups, in ems.
const COLUMN_GAP: f64 = 0.8;
const GROUP_GAP: f64 = 1.35;

impl ColumnGroup {
    /// Keeps the rows with some indices only; widths are those of all.
    fn keep_rows(&mut self, rows: &[usize]) {
        for column in &mut self.columns {
            column.texts = rows.iter().filter_map(|&k| column.texts.get(k).cloned()).collect();
        }
    }

    /// A group with the columns that have a text in some row; `None` if there is none.
    fn new(
        title: impl Into<String>,
        columns: impl IntoIterator<Item = (&'static str, Vec<String>)>,
        theme: &Theme,
    ) -> Option<ColumnGroup> {
        let mut right = 0.0;
        let mut columns: Vec<Column> = columns
            .into_iter()
            .filter(|(_, texts)| texts.iter().any(|text| !text.is_empty() && text != MISSING))
            .map(|(head, texts)| {
                let widest = texts.iter().map(|text| width(text, theme)).fold(width(head, theme), f64::max);
                right += if right > 0.0 { COLUMN_GAP * theme.note_size } else { 0.0 } + widest;
                Column { head, texts, right }
            })
            .collect();
        let title = title.into();
        // A title that is wider than its columns spreads them.
        let spare = (width(&title, theme) - right).max(0.0) / columns.len().max(1) as f64;
        (1..).zip(&mut columns).for_each(|(k, column)| column.right += f64::from(k) * spare);
        (!columns.is_empty()).then_some(ColumnGroup { title, columns })
    }

    pub fn width(&self) -> f64 {
        self.columns.last().map_or(0.0, |column| column.right)
    }

    /// Its width with the gap before it.
    fn width_with_gap(&self, theme: &Theme) -> f64 {
        self.width() + GROUP_GAP * theme.note_size
    }
}

/// In place of a value that does not exist.
const MISSING: &str = "–";

fn width(text: &str, theme: &Theme) -> f64 {
    theme.text_line(text, Point::origin(), Anchor::Start, theme.note_size, theme.grey).text.width()
}

/// The groups of columns that fit a width, with the left edge of each; those of less importance are left out first.
///
/// `first` is the width of the swatches. The graphs, which follow the columns, have at least `graph_width`, and are left
/// out only together with all but the first two groups; the last result is their left edge.
pub(super) fn fitting_columns(
    groups: [Option<ColumnGroup>; GROUP_COUNT],
    first: f64,
    whole: f64,
    graph_width: f64,
    theme: &Theme,
) -> (Vec<(f64, ColumnGroup)>, Option<f64>) {
    let gap = GROUP_GAP * theme.note_size;
    // The numbers are next to their swatches.
    let mut left = first - 0.7 * gap;
    let mut placed = Vec::new();
    let mut has_graphs = false;
    for (k, group) in groups.into_iter().enumerate() {
        if k == GROUPS_BEFORE_GRAPHS {
            has_graphs = left + gap + graph_width <= whole;
        }
        let Some(group) = group else { continue };
        let reserved = if has_graphs { gap + graph_width } else { 0.0 };
        let width = group.width_with_gap(theme);
        if left + width + reserved > whole {
            break;
        }
        placed.push((left + gap, group));
        left += width;
    }
    (placed, has_graphs.then_some(left + gap))
}

/// The number of groups, in the order of their importance: the number, the coordinates, the straight portions to two
/// tolerances, the circular portion, the cusps.
pub(super) const GROUP_COUNT: usize = 6;

/// The groups that are more important than the graphs.
const GROUPS_BEFORE_GRAPHS: usize = 3;

/// The groups of columns for the curves of a page, which are those of all pages of its cell; `None` where no curve has a value.
pub(super) fn column_groups(page: &CouplerGridPage, theme: &Theme) -> [Option<ColumnGroup>; GROUP_COUNT] {
    let curves = page.panel.solved_cell.curves.iter();
    let all: Vec<ShownCurve> = curves.map(|curve| ShownCurve { curve, point_index: 0 }).collect();
    groups_of_curves(page, &all, theme).map(|group| {
        let mut group = group?;
        group.keep_rows(&page.curve_indices);
        Some(group)
    })
}

fn groups_of_curves(page: &CouplerGridPage, shown: &[ShownCurve], theme: &Theme) -> [Option<ColumnGroup>; GROUP_COUNT] {
    let solved = page.panel.solved_cell;
    let has_circuits = solved.motion.circuits.len() > 1;
    let number = |s: &ShownCurve| match has_circuits {
        true => format!("{}/{}", s.curve.trace, s.curve.circuit),
        false => s.curve.trace.to_string(),
    };
    let coordinates: Vec<Option<[f64; 2]>> = shown.iter().map(|s| coordinates_of(page, s)).collect();
    let coordinate = |k: usize, [exact, rounded]: [&'static str; 2]| {
        let values: Vec<f64> = coordinates.iter().flatten().map(|pair| pair[k]).collect();
        let decimals = coordinate_decimals(&values);
        let head = if values.iter().any(|value| is_rounded(*value, decimals)) { rounded } else { exact };
        let text = |pair: [f64; 2]| format_fixed(pair[k], decimals);
        (head, coordinates.iter().map(|pair| pair.map_or(String::new(), text)).collect())
    };
    let lengths = |key: MeasureKey<f64>| -> Vec<String> {
        let values: Vec<Option<f64>> = shown.iter().map(|s| finite(s.curve, key)).collect();
        let decimals = significant_decimals(values.iter().flatten().copied(), 4);
        values.iter().map(|value| value.map_or(MISSING.to_owned(), |value| format_fixed(value, decimals))).collect()
    };
    let inputs = |key: MeasureKey<f64>| {
        // The lengths of an actuator have no common order of magnitude.
        if solved.linkage.input() == Input::Length {
            return lengths(key);
        }
        let text = |value: f64| format!("{value:.1}{}", solved.linkage.input().unit_sign());
        shown.iter().map(|s| finite(s.curve, key).map_or(MISSING.to_owned(), text)).collect()
    };
    let counts = |key: MeasureKey<f64>| {
        let text = |value: f64| format_fixed(value, 0);
        shown.iter().map(|s| finite(s.curve, key).map_or(MISSING.to_owned(), text)).collect()
    };
    [
        ColumnGroup::new("", [("point", shown.iter().map(number).collect())], theme),
        ColumnGroup::new("", [coordinate(0, ["along", "≈ along"]), coordinate(1, ["across", "≈ across"])], theme),
        ColumnGroup::new(
            straight_title(page.straight_criterion),
            [
                ("length", lengths(Measure::STRAIGHT_LENGTH)),
                ("from", inputs(Measure::STRAIGHT_START)),
                ("over", inputs(Measure::STRAIGHT_INPUT)),
            ],
            theme,
        ),
        ColumnGroup::new(
            straight_title(StraightCriterion::Tolerance(0.01)),
            [("length", lengths(Measure::STRAIGHT_10_LENGTH)), ("over", inputs(Measure::STRAIGHT_10_INPUT))],
            theme,
        ),
        ColumnGroup::new(
            DWELL_TITLE,
            [
                ("radius", lengths(Measure::DWELL_RADIUS)),
                ("from", inputs(Measure::DWELL_START)),
                ("over", inputs(Measure::DWELL_INPUT)),
            ],
            theme,
        ),
        ColumnGroup::new("", [("cusps", counts(Measure::CUSPS))], theme),
    ]
}

/// The head over the columns of straight portions.
pub(super) fn straight_title(criterion: StraightCriterion) -> String {
    match criterion {
        StraightCriterion::Tolerance(tolerance) => format!("straight to {} %", percent(tolerance)),
        StraightCriterion::Input(_) | StraightCriterion::Length(_) => "straightest".to_owned(),
    }
}

/// The head over the columns of circular portions.
pub(super) const DWELL_TITLE: &str = "dwell on an arc";

/// A tolerance in percent.
pub(super) fn percent(tolerance: f64) -> String {
    format_in_full(100.0 * tolerance)
}

/// A measure of a curve, if it is a finite number.
pub(super) fn finite(curve: &MeasuredCurve, key: MeasureKey<f64>) -> Option<f64> {
    curve.measure(key).filter(|value| value.is_finite())
}

/// The coordinates of a point on its link, as the linkage gives them.
pub(super) fn coordinates_of(page: &CouplerGridPage, shown: &ShownCurve) -> Option<[f64; 2]> {
    page.coordinates.get(shown.curve.trace.checked_sub(1)?).copied().flatten()
}
