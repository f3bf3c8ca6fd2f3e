//! The layouts of pages: panels, charts, coupler grids and overlays, composed to a [`Scene`], through plotters where the
//! feature is on.
//!
//! [`PanelPage`], [`ChartPage`], [`CouplerGridPage`] and [`OverlayPage`] say what is on a page; [`Options`] says what
//! all pages of an atlas have in common. Each has a function that composes it, such as [`compose_panels`].

mod answers;
mod area;
mod arrangement;
mod balanced_grid;
pub mod book;
#[cfg(feature = "plotters")]
mod chart;
mod chart_grid;
mod coupler_grid;
mod direction;
mod element;
mod figure;
mod heading;
mod key;
mod labels;
mod marks;
mod mechanism;
mod motion_marks;
mod overlay;
mod panel;
mod panels;
mod plot;
mod pose;
mod rect;
mod symbols;
mod theme;
mod typography;

#[cfg(feature = "plotters")]
pub use chart::compose_charts;
pub use figure::dash_period;
pub use heading::Heading;
pub use key::Key;
use marks::PAGE_MEASURES;
pub use marks::cell_facts;
pub use panel::{Panel, PoseChoice};
pub use theme::{CurveStyle, NamedTheme, Theme};

use crate::chart::{Chart, Series};
use crate::scene::Scene;
use coupler_curves::find::Placement;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::JointId;
use coupler_curves::measure::StraightCriterion;
use coupler_curves::solve::SolvedCell;

/// The size of the paper, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// The width.
    pub width: f64,
    /// The height.
    pub height: f64,
}

impl Paper {
    /// The papers that have a name, all in landscape format.
    pub const NAMED: [(&'static str, Paper); 4] = [
        ("letter", Paper { width: 279.4, height: 215.9 }),
        ("tabloid", Paper { width: 431.8, height: 279.4 }),
        ("a4", Paper { width: 297.0, height: 210.0 }),
        ("a3", Paper { width: 420.0, height: 297.0 }),
    ];

    /// The least and the greatest side of a page, in millimetres.
    pub const SIDE_RANGE: [f64; 2] = [50.0, 2000.0];
}

/// How a family's cells are laid out on pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A grid of panels, each with a cell's linkage and curves.
    Panels {
        /// The number of panels in a row.
        columns: usize,
        /// The number of rows.
        rows: usize,
    },
    /// A grid of charts, each of one quantity over all curves.
    Chart {
        /// The number of charts in a row.
        columns: usize,
        /// The number of rows.
        rows: usize,
    },
    /// A page for every ten traced points of a cell, as in the atlas of Hrones and Nelson.
    CouplerGrid,
}

impl Layout {
    /// The number of traced points on a page of a coupler grid.
    pub const POINTS_PER_PAGE: usize = 10;

    /// The name and a description of every layout.
    pub const ALL: [(&'static str, &'static str); 3] = [
        ("panels", "a grid of panels, each with a cell's linkage, its curves and its caption"),
        ("coupler-grid", "a page for every ten coupler points of a cell, drawn on the grid they lie on"),
        ("chart", "a grid of charts, each of one quantity over another, as the family's `chart` names them"),
    ];

    /// The most columns and rows of panels that fit on a page.
    pub fn max_panels(options: &Options) -> [usize; 2] {
        panels::max_grid(options.paper, &options.theme.for_paper(options.paper))
    }

    /// The most columns and rows of charts that fit on a page.
    pub fn max_charts(options: &Options) -> [usize; 2] {
        chart_grid::max_grid(options.paper, &options.theme.for_paper(options.paper))
    }

    /// The layout for `count` cells: as many on a page as can be read well, and each as large as the paper allows.
    pub fn for_panels(options: &Options, count: usize) -> Layout {
        let [columns, rows] = panels::grid_for(options.paper, &options.theme.for_paper(options.paper), count);
        Layout::Panels { columns, rows }
    }

    /// The layout for `count` charts: as many on a page as can be read well.
    pub fn for_charts(options: &Options, count: usize) -> Layout {
        let [columns, rows] = chart_grid::for_charts(options.paper, &options.theme.for_paper(options.paper), count);
        Layout::Chart { columns, rows }
    }

    /// The number of columns and rows of a page.
    pub fn grid(self) -> [usize; 2] {
        match self {
            Layout::Panels { columns, rows } | Layout::Chart { columns, rows } => [columns, rows],
            Layout::CouplerGrid => [1, 1],
        }
    }

    /// The measures that pages of the layout and the index of a book use, in addition to those in captions.
    pub fn measures(self) -> impl Iterator<Item = &'static str> {
        let further: &[&str] = if self == Layout::CouplerGrid { &coupler_grid::MEASURES } else { &[] };
        PAGE_MEASURES.iter().chain(further).copied()
    }

    /// What pages call the curves of a linkage that have numbers.
    pub fn curve_noun(self) -> &'static str {
        if self == Layout::CouplerGrid { "point" } else { "curve" }
    }

    /// The number of panels or charts on a page.
    pub fn cells_per_page(self) -> usize {
        let [columns, rows] = self.grid();
        columns * rows
    }
}

/// The options that all pages of an atlas have in common.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The paper.
    pub paper: Paper,
    /// The range of the input that a dash and its gap span, in degrees.
    pub dash_deg: f64,
    /// Colours, weights, sizes and typeface, for tabloid paper.
    pub theme: Theme,
}

impl Options {
    /// The default options on a paper: dashes of 5 degrees, ink on cream.
    pub fn for_paper(paper: Paper) -> Options {
        Options { paper, dash_deg: 5.0, theme: Theme::default() }
    }

    /// The options on another paper.
    pub fn with_paper(self, paper: Paper) -> Options {
        Options { paper, ..self }
    }

    /// The options with another range of the input for a dash and its gap, in degrees.
    pub fn with_dash_deg(self, dash_deg: f64) -> Options {
        Options { dash_deg, ..self }
    }

    /// The options with another theme.
    pub fn with_theme(self, theme: Theme) -> Options {
        Options { theme, ..self }
    }
}

/// The scale of the linkages on pages of panels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PanelScale {
    /// Each is as large as its panel.
    #[default]
    Panel,
    /// All of a page have the scale at which the largest one fits its panel.
    Page,
    /// All have this scale, in millimetres to a unit of length. One that does not fit is reduced.
    Fixed(f64),
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

/// The positions of all joints of a cell's linkage in the pose that is clearest to read; `None` if it has no curve.
pub fn clearest_pose(solved: &SolvedCell) -> Option<Vec<Point>> {
    let circuit = solved.circuit(solved.curves.first()?);
    Some(pose::clearest_pose(&solved.linkage, circuit))
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

/// Composes an overlay of a recorded and a current curve.
pub fn compose_overlay(page: &OverlayPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, page.title.to_owned());
    let mut scene = Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() };
    overlay::compose(&mut scene, page, &theme);
    scene
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
}

/// A curve that is near a path.
#[derive(Clone, Debug)]
pub struct FoundCurve {
    /// The solved linkage with this curve only.
    pub solved: SolvedCell,
    /// Where it is on the target. Its linkage is drawn only if it is in its own place.
    pub placement: Placement,
    /// The positions of all joints, in which the linkage of the first curve is drawn.
    pub pose: Vec<Point>,
    /// What the legend says of it.
    pub label: String,
}

/// Composes a page of curves that are near a path.
pub fn compose_answers(page: &AnswersPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, page.title.to_owned());
    let mut scene = Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() };
    answers::compose(&mut scene, page, &theme);
    scene
}

/// Composes a page of panels.
pub fn compose_panels(page: &PanelPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(&page.heading, options, &theme);
    panels::compose(&area::whole_page(&mut scene), page, options, &theme);
    scene
}

/// Composes a page of a coupler grid.
pub fn compose_coupler_grid(page: &CouplerGridPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(&page.heading, options, &theme);
    coupler_grid::compose(&mut scene, page, options, &theme);
    scene
}

fn empty_scene(heading: &Heading, options: &Options, theme: &Theme) -> Scene {
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, heading.page_title());
    Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() }
}
