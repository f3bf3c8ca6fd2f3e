//! What stands where on a page: paper, theme and layouts, drawn through plotters onto a [`Scene`].

mod arrangement;
pub mod book;
mod chart;
mod coupler_grid;
mod element;
mod figure;
mod heading;
mod marks;
mod mechanism;
mod overlay;
mod panels;
mod plot;
mod pose;
mod theme;

pub use heading::Heading;
pub use marks::{PAGE_MEASURES, cell_facts};
pub use theme::{CurveStyle, NamedTheme, Theme};

use crate::chart::{Chart, Series};
use crate::scene::Scene;
use coupler_curves::geometry::Point;
use coupler_curves::solve::SolvedCell;

/// The size of the paper, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// Its width.
    pub width: f64,
    /// Its height.
    pub height: f64,
}

impl Paper {
    /// The papers with a name; all lie on their long side.
    pub const NAMED: [(&'static str, Paper); 4] = [
        ("letter", Paper { width: 279.4, height: 215.9 }),
        ("tabloid", Paper { width: 431.8, height: 279.4 }),
        ("a4", Paper { width: 297.0, height: 210.0 }),
        ("a3", Paper { width: 420.0, height: 297.0 }),
    ];

    /// The least and the greatest side a page may have.
    pub const SIDE_RANGE: [f64; 2] = [50.0, 2000.0];
}

/// How a family's cells are laid out on pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A grid of panels, each with a cell's linkage and curves.
    Panels {
        /// Panels in a row.
        columns: usize,
        /// Rows.
        rows: usize,
    },
    /// A grid of charts, each of one quantity over all curves.
    Chart {
        /// Charts in a row.
        columns: usize,
        /// Rows.
        rows: usize,
    },
    /// A page for each cell and ten traced points of it, as in the atlas of Hrones and Nelson.
    CouplerGrid,
}

impl Layout {
    /// How many traced points a page of a coupler grid shows.
    pub const POINTS_PER_PAGE: usize = 10;

    /// Every layout's name and what it shows.
    pub const ALL: [(&'static str, &'static str); 3] = [
        ("panels", "a grid of panels, each with a cell's linkage, its curves and its caption"),
        (
            "coupler-grid",
            "a page for each cell and ten of its coupler points, on the grid they stand on; then for the next ten",
        ),
        ("chart", "a grid of charts, each with one of the quantities that the family's `chart` names over another"),
    ];

    /// The most columns and rows of panels that a page has room for.
    pub fn max_panels(options: &Options) -> [usize; 2] {
        panels::max_grid(options.paper, &options.theme.for_paper(options.paper))
    }

    /// The most columns and rows of charts that a page has room for.
    pub fn max_charts(options: &Options) -> [usize; 2] {
        chart::max_grid(options.paper, &options.theme.for_paper(options.paper))
    }

    /// The layout in which that many charts show best: as many to a page as can well be read.
    pub fn for_charts(options: &Options, count: usize) -> Layout {
        let [columns, rows] = chart::balanced_grid(options.paper, &options.theme.for_paper(options.paper), count);
        Layout::Chart { columns, rows }
    }

    /// How many columns and rows a page has.
    pub fn grid(self) -> [usize; 2] {
        match self {
            Layout::Panels { columns, rows } | Layout::Chart { columns, rows } => [columns, rows],
            Layout::CouplerGrid => [1, 1],
        }
    }

    /// How many panels or charts a page holds.
    pub fn cells_per_page(self) -> usize {
        let [columns, rows] = self.grid();
        columns * rows
    }
}

/// What all pages of an atlas have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The paper.
    pub paper: Paper,
    /// The input a dash and its gap span, in degrees.
    pub dash_deg: f64,
    /// What they look like.
    pub theme: Theme,
}

impl Options {
    /// Those of a paper where nothing else is asked for: dashes of 5 degrees, ink on cream.
    pub fn for_paper(paper: Paper) -> Options {
        Options { paper, dash_deg: 5.0, theme: Theme::default() }
    }
}

/// A page to be composed.
#[derive(Clone, Debug)]
pub struct PanelPage<'a> {
    /// What stands round the contents.
    pub heading: Heading<'a>,
    /// How the cells are laid out.
    pub layout: Layout,
    /// The cells.
    pub panels: Vec<Panel<'a>>,
}

/// A cell of a page.
#[derive(Clone, Debug)]
pub struct Panel<'a> {
    /// The line under it.
    pub caption: String,
    /// A smaller line under that; may be empty.
    pub note: String,
    /// What is known of the cell, as [`cell_facts`] has it; may be empty.
    pub facts: [String; 2],
    /// The cell.
    pub solved_cell: &'a SolvedCell,
    /// The pose its linkage is drawn in.
    pub pose: PoseChoice,
    /// The links that are drawn in the ink of a curve, by their places in the linkage, and which; the others in black.
    pub link_inks: Vec<(usize, usize)>,
}

/// The pose a linkage is drawn in; a pose is the places of all its joints.
#[derive(Clone, Debug, Default)]
pub enum PoseChoice {
    /// The clearest of the first circuit.
    #[default]
    Clearest,
    /// This one.
    Fixed(Vec<Point>),
    /// All of these one after the other, again and again.
    Animated {
        /// The poses at equal steps of time, the first once more at the end.
        poses: Vec<Vec<Point>>,
        /// How long it takes from the first to the last.
        seconds: f64,
    },
}

/// A page of a coupler grid to be composed.
#[derive(Clone, Debug)]
pub struct CouplerGridPage<'a> {
    /// What stands round the contents.
    pub heading: Heading<'a>,
    /// The cell.
    pub panel: Panel<'a>,
    /// Which of its curves are on this page, by their places.
    pub curve_indices: Vec<usize>,
    /// The letters of its links.
    pub labels: &'a [LinkLabel],
}

/// What a link is called: a letter for its length, or the length itself.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkLabel {
    /// The joints at its ends, by their places in the linkage.
    pub joints: [usize; 2],
    /// Its letter.
    pub text: String,
}

/// The places of all joints of a cell's linkage in the pose in which it is seen best; `None` where it has no curve.
pub fn clearest_pose(solved: &SolvedCell) -> Option<Vec<Point>> {
    let circuit = solved.circuit(solved.curves.first()?);
    Some(pose::clearest_pose(&solved.linkage, circuit))
}

/// A page of charts to be composed.
#[derive(Clone, Debug)]
pub struct ChartPage<'a> {
    /// What stands round the contents.
    pub heading: Heading<'a>,
    /// How the charts are laid out.
    pub layout: Layout,
    /// What the charts show.
    pub chart: &'a Chart,
    /// Which of its quantities are on this page, by their places.
    pub quantity_range: std::ops::Range<usize>,
    /// The lines of all charts.
    pub series: &'a [Series],
}

/// A page to be composed on which a curve lies over one that was recorded.
#[derive(Clone, Debug)]
pub struct OverlayPage<'a> {
    /// What stands at its head.
    pub title: &'a str,
    /// What stands under that.
    pub details: Vec<String>,
    /// What stands at its foot.
    pub footer: &'a str,
    /// The recorded samples.
    pub recorded: Vec<Point>,
    /// The present samples.
    pub current: Vec<Point>,
    /// The present curve between its samples.
    pub current_path: Vec<Point>,
    /// Whether it comes back to where it began.
    pub is_closed: bool,
    /// The places that are furthest from where they were.
    pub worst_points: Vec<Point>,
}

/// Draws a curve over one that was recorded.
pub fn compose_overlay(sheet: &OverlayPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, sheet.title.to_owned());
    let mut scene = Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() };
    overlay::compose(&mut scene, sheet, &theme);
    scene
}

/// Draws a page of panels.
pub fn compose_panels(sheet: &PanelPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(&sheet.heading, options, &theme);
    let [columns, rows] = sheet.layout.grid();
    panels::compose(&mut scene, sheet, (columns, rows), options, &theme);
    scene
}

/// Draws a page of a coupler grid.
pub fn compose_coupler_grid(sheet: &CouplerGridPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(&sheet.heading, options, &theme);
    coupler_grid::compose(&mut scene, sheet, options, &theme);
    scene
}

/// Draws a page of charts.
pub fn compose_charts(sheet: &ChartPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(&sheet.heading, options, &theme);
    chart::compose(&mut scene, sheet, &theme);
    scene
}

fn empty_scene(heading: &Heading, options: &Options, theme: &Theme) -> Scene {
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, heading.page_title());
    Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() }
}
