//! The layouts of pages: panels, charts, coupler grids and overlays, composed to a [`Scene`], through plotters where the
//! feature is on.
//!
//! [`PanelPage`], [`ChartPage`], [`CouplerGridPage`] and [`OverlayPage`] say what is on a page; [`Options`] says what
//! all pages of an atlas have in common. Each has a function that composes it, such as [`compose_panels`].

mod answers;
mod area;
mod arrangement;
mod balanced_grid;
mod body;
pub mod book;
mod caption_form;
#[cfg(feature = "plotters")]
mod chart;
mod chart_grid;
mod coupler_grid;
mod direction;
mod element;
mod empty_scene;
mod extents;
mod figure;
mod guided_body;
mod heading;
mod key;
mod key_division;
mod key_drawing;
mod labels;
mod layout;
mod marks;
mod mechanism;
mod motion_marks;
mod options;
mod overlay;
mod pages;
mod panel;
mod panel_texts;
mod panels;
mod paper;
mod parts_page;
mod plot;
mod pose;
mod rect;
mod scales;
mod symbols;
mod theme;
mod tolerance_band;
mod typography;

#[cfg(feature = "plotters")]
pub use chart::compose_charts;
pub use figure::dash_period;
pub use guided_body::{BodyFrame, BodyPlaces, GuidedBody};
pub use heading::Heading;
pub use key::Key;
pub use layout::{Layout, circuit_words};
pub use marks::cell_facts;
pub use options::Options;
pub use pages::{AnswersPage, ChartPage, CouplerGridPage, FoundCurve, LinkLabel, OverlayPage, PanelPage, PanelScale};
pub use panel::{Panel, PoseChoice};
pub use paper::Paper;
pub use scales::{format_scale, usual_scale_below};
pub use theme::{CurveStyle, NamedTheme, Theme};

use crate::scene::Scene;
use coupler_curves::geometry::Point;
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::SolvedCell;
use empty_scene::empty_scene;
use marks::PAGE_MEASURES;

impl Layout {
    /// The most columns and rows of panels that fit on a page.
    pub fn max_panels(options: &Options) -> [usize; 2] {
        panels::max_grid(options.paper, &options.theme.for_paper(options.paper))
    }

    /// The most columns and rows of charts that fit on a page.
    pub fn max_charts(options: &Options) -> [usize; 2] {
        chart_grid::max_grid(options.paper, &options.theme.for_paper(options.paper))
    }

    /// The layout for `count` cells whose pages have a heading and a key: as many on a page as can be read well, and each as large as the paper
    /// allows.
    pub fn for_panels(options: &Options, count: usize, heading: &Heading, key: &Key) -> Layout {
        let theme = &options.theme.for_paper(options.paper);
        let [columns, rows] = panels::grid_for(options.paper, theme, count, heading, key);
        Layout::Panels { columns, rows }
    }

    /// The layout for `count` charts: as many on a page as can be read well.
    pub fn for_charts(options: &Options, count: usize) -> Layout {
        let [columns, rows] = chart_grid::for_charts(options.paper, &options.theme.for_paper(options.paper), count);
        Layout::Chart { columns, rows }
    }

    /// The measures that pages of the layout and the index of a book use, in addition to those in captions.
    pub fn measures(self) -> MeasureSet {
        PAGE_MEASURES | if self == Layout::CouplerGrid { coupler_grid::MEASURES } else { MeasureSet::EMPTY }
    }
}

/// The positions of all joints of a cell's linkage in the pose that is clearest to read; `None` if it has no curve.
pub fn clearest_pose(solved: &SolvedCell) -> Option<Vec<Point>> {
    let circuit = solved.circuit(solved.curves.first()?);
    Some(pose::clearest_pose(&solved.linkage, circuit))
}

/// Composes an overlay of a recorded and a current curve.
pub fn compose_overlay(page: &OverlayPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, page.title.to_owned());
    let mut scene =
        Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new(), reduced_scale: None };
    overlay::compose(&mut scene, page, &theme);
    scene
}

/// Composes a page of curves that are near a path.
pub fn compose_answers(page: &AnswersPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let Paper { width, height } = options.paper;
    let (paper, typeface, title) = (theme.paper, theme.typeface, page.title.to_owned());
    let mut scene =
        Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new(), reduced_scale: None };
    answers::compose(&mut scene, page, &theme);
    scene
}

/// Composes a page of panels.
pub fn compose_panels(page: &PanelPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(page.heading.page_title(), options, &theme);
    let root = area::whole_page(&mut scene);
    let fitting_scale = match page.layout {
        Layout::Drawing => parts_page::compose(&root, page, options, &theme),
        _ => panels::compose(&root, page, options, &theme),
    };
    drop(root);
    Scene { reduced_scale: page.scale.reduced(fitting_scale), ..scene }
}

/// Composes a page of a coupler grid.
pub fn compose_coupler_grid(page: &CouplerGridPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(page.heading.page_title(), options, &theme);
    let fitting_scale = coupler_grid::compose(&mut scene, page, options, &theme);
    Scene { reduced_scale: page.scale.reduced(fitting_scale), ..scene }
}
