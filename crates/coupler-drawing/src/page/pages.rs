//! What is on a page, of each kind.

use super::guided_body::GuidedBody;
use super::heading::Heading;
use super::key::Key;
use super::layout::Layout;
use super::panel::Panel;
use super::plot::is_reduced;
use crate::chart::{Chart, Series};
use coupler_curves::geometry::Point;
use coupler_curves::geometry::Similarity;
use coupler_curves::linkage::JointId;
use coupler_curves::measure::StraightCriterion;
use coupler_curves::solve::SolvedCell;

/// The scale of the linkages on pages of panels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PanelScale {
    /// Each is as large as its panel.
    #[default]
    Panel,
    /// All of a page have the scale at which the largest one fits its panel.
    Page,
    /// All have this scale, in millimetres to a unit of length. One that does not fit is reduced, see [`reduced_scale`](crate::scene::Scene::reduced_scale).
    Fixed(f64),
}

impl PanelScale {
    /// The scale that is given, in millimetres to a unit.
    pub fn fixed(self) -> Option<f64> {
        match self {
            PanelScale::Fixed(scale) => Some(scale),
            PanelScale::Panel | PanelScale::Page => None,
        }
    }

    /// The scale that fits, if the one that is given is greater.
    pub(super) fn reduced(self, fitting: f64) -> Option<f64> {
        self.fixed().filter(|scale| is_reduced(*scale, fitting)).map(|_| fitting)
    }
}

/// A page of panels.
#[derive(Clone, Debug)]
pub struct PanelPage<'a> {
    /// The texts around the contents.
    pub heading: Heading<'a>,
    /// The number of columns and rows.
    pub layout: Layout,
    /// The panels, row by row.
    pub panels: Vec<Panel<'a>>,
    /// The scale of the linkages.
    pub scale: PanelScale,
    /// How the linkages are built; nothing is said if there is none.
    pub key: Option<&'a Key>,
}

/// A page of a coupler grid.
#[derive(Clone, Debug)]
pub struct CouplerGridPage<'a> {
    /// The texts around the contents.
    pub heading: Heading<'a>,
    /// The cell.
    pub panel: Panel<'a>,
    /// The scale of the linkage; the only one of a page is as large as its frame unless the scale is fixed.
    pub scale: PanelScale,
    /// The indices of the curves that are on this page.
    pub curve_indices: Vec<usize>,
    /// The coordinates along and across its base of each traced point, in their order, as the linkage gives them; `None` for one
    /// that has none.
    pub coordinates: &'a [Option<[f64; 2]>],
    /// The names of the links.
    pub labels: &'a [LinkLabel],
    /// How the linkage is built, if the lengths of its links do not say it.
    pub key: Option<&'a Key>,
    /// The criterion by which the straight portions were selected.
    pub straight_criterion: StraightCriterion,
}

/// The name of a link: a letter for its length, or the length itself.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkLabel {
    /// The indices of the joints at its ends.
    pub joints: [JointId; 2],
    /// The name.
    pub text: String,
}

/// A page of charts.
#[derive(Clone, Debug)]
pub struct ChartPage<'a> {
    /// The texts around the contents.
    pub heading: Heading<'a>,
    /// The number of columns and rows.
    pub layout: Layout,
    /// The quantities of all charts.
    pub chart: &'a Chart,
    /// The indices of the quantities `chart.y` that are on this page.
    pub quantity_range: std::ops::Range<usize>,
    /// The lines of all charts.
    pub series: &'a [Series],
    /// How the linkages are built, and one of them.
    pub key: Option<(&'a Key, &'a Panel<'a>)>,
}

/// A page on which a curve is overlaid on the same curve as it was recorded earlier.
#[derive(Clone, Debug)]
pub struct OverlayPage<'a> {
    /// The title.
    pub title: &'a str,
    /// The lines under the title.
    pub details: Vec<String>,
    /// The line at the foot.
    pub footer: &'a str,
    /// The recorded samples.
    pub recorded: Vec<Point>,
    /// The current samples.
    pub current: Vec<Point>,
    /// The current curve, as a finer polyline than its samples.
    pub current_path: Vec<Point>,
    /// Whether the curve is closed.
    pub is_closed: bool,
    /// The points with the greatest difference, to be marked.
    pub worst_points: Vec<Point>,
}

/// A page of the curves that are near a path, with the linkage of the first of them.
#[derive(Clone, Debug)]
pub struct AnswersPage<'a> {
    /// The title.
    pub title: &'a str,
    /// The lines under the title.
    pub details: Vec<String>,
    /// The points of the path.
    pub target: Vec<Point>,
    /// What the legend says of the path.
    pub target_label: String,
    /// The curves, the best first.
    pub curves: Vec<FoundCurve>,
    /// The body that they are to guide, behind the curves; of a path it has no poses.
    pub body: GuidedBody,
}

/// A curve that is near a path.
#[derive(Clone, Debug)]
pub struct FoundCurve {
    /// The solved linkage with this curve only.
    pub solved: SolvedCell,
    /// Where it is on the target. Its linkage is drawn only if it is in its own place.
    pub placement: Similarity,
    /// The positions of all joints, in which the linkage of the first curve is drawn.
    pub pose: Vec<Point>,
    /// What the legend says of it.
    pub label: String,
}

impl FoundCurve {
    /// Whether its linkage is in its own place, so that it can be drawn.
    pub(super) fn is_in_place(&self) -> bool {
        self.placement == Similarity::IDENTITY
    }
}
