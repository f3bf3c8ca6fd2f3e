//! A part of the page on which elements are drawn.
//!
//! There are two: one of plotters, on which charts are drawn too, and one that records into the scene itself, for builds
//! without plotters. Both round corners to the same hundredths of a millimetre.

#[cfg(feature = "plotters")]
mod plotters_area;
#[cfg(any(test, not(feature = "plotters")))]
mod scene_area;

#[cfg(feature = "plotters")]
pub(super) use plotters_area::{PlottersArea, whole_page};
#[cfg(not(feature = "plotters"))]
pub(super) use scene_area::whole_page;

use super::element::Element;
use crate::scene::{Group, Stroke};
use coupler_curves::geometry::{Point, Vector};

/// A part of the page. Its corners are at whole hundredths of a millimetre, and its origin is the upper left one.
pub(super) trait Area: Sized {
    /// The width and height in millimetres.
    fn size(&self) -> Vector;

    /// The area without margins above, below, to the left and to the right, in millimetres.
    fn without_margins(&self, margins: [f64; 4]) -> Self;

    /// The cells of a grid that divides the area, row by row. Their sizes differ by a hundredth of a millimetre where
    /// the area cannot be divided evenly.
    fn grid_cells(&self, rows: usize, columns: usize) -> Vec<Self>;

    /// Draws an element.
    fn record(&self, element: impl Element);

    /// Makes a group of what is drawn meanwhile; its own items are replaced.
    fn grouped(&self, group: Group, draw: impl FnOnce());

    /// Draws a rectangle by two opposite corners, which are rounded, as the width of the stroke is.
    fn record_rectangle(&self, corners: [Point; 2], stroke: Stroke);
}

/// The areas with and without plotters make the same scenes.
#[cfg(feature = "plotters")]
#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::empty_scene::empty_scene;
    use crate::page::{Heading, Key, Layout, NamedTheme, Options, Panel, PanelPage, Paper, Theme};
    use crate::page::{compose_panels, panels};
    use crate::plate;
    use crate::scene::{Color, Scene};
    use coupler_curves::FourBar;
    use coupler_curves::catalogue;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::solve::{SolvedCell, Solver};

    const PAPERS: [Paper; 8] = {
        let [(_, letter), (_, tabloid), (_, a4), (_, a3), ..] = Paper::NAMED;
        let slip = Paper { width: 50.0, height: 2000.0 };
        let odd = Paper { width: 123.456, height: 98.765 };
        [letter, tabloid, a4, a3, plate::PAPER, slip, odd, Paper { width: 50.0, height: 50.0 }]
    };

    /// The options for a paper, each with another theme.
    fn options() -> impl Iterator<Item = Options> {
        let themes = Theme::NAMED.iter().cycle();
        let with_theme =
            |(paper, NamedTheme { theme, .. }): (Paper, &NamedTheme)| Options::for_paper(paper).with_theme(theme());
        PAPERS.into_iter().zip(themes).map(with_theme)
    }

    fn compose_without_plotters(page: &PanelPage, options: &Options) -> Scene {
        let theme = options.theme.for_paper(options.paper);
        let mut scene = empty_scene(page.heading.page_title(), options, &theme);
        panels::compose(&scene_area::whole_page(&mut scene), page, options, &theme);
        scene
    }

    /// Cells of several linkages, one of which cannot be assembled.
    fn solved_cells() -> Vec<(Family, SolvedCell)> {
        let four_bar = ["frame", "crank", "coupler", "rocker", "along", "across"];
        let lengths = [[2.0, 1.0, 2.5, 2.5, 5.0, 0.0], [4.0, 3.0, 2.0, 2.5, 1.0, 1.5], [9.0, 1.0, 2.0, 3.0, 1.0, 0.0]];
        let four_bars = lengths.map(|lengths| ("four-bar", four_bar.into_iter().zip(lengths).collect::<Vec<_>>()));
        let others = [("evans", vec![("p", 4.0), ("a", 4.5)]), ("jansen", Vec::new()), ("scotch-yoke", Vec::new())];
        let solve = |(id, values): (&str, Vec<(&str, f64)>)| {
            let values: Vec<(String, f64)> = values.iter().map(|(name, value)| (name.to_string(), *value)).collect();
            let family = Family::single_cell(catalogue::find(id).unwrap(), &values, Sampling::Samples(72)).unwrap();
            let solved = Solver::new(&family).solve(0).unwrap();
            (family, solved)
        };
        four_bars.into_iter().chain(others).map(solve).collect()
    }

    #[test]
    fn pages_of_panels_are_the_same() {
        let solved = solved_cells();
        let key = Key::new(&solved[0].0);
        assert!(solved.iter().any(|(_, cell)| !cell.motion.is_assembled()));
        for options in options() {
            let [most_columns, most_rows] = Layout::max_panels(&options);
            for [columns, rows] in [[1, 1], [2, 1], [5, 2], [3, 3], [1, 7]] {
                let layout = Layout::Panels { columns: columns.min(most_columns), rows: rows.min(most_rows) };
                let panel = |(family, solved)| {
                    let facts = crate::page::cell_facts(family, solved);
                    Panel::new(solved).with_caption("p = 2").with_note("a note").with_facts(facts)
                };
                let cells = solved.iter().map(|(family, solved)| (family, solved)).cycle();
                let panels = cells.take(layout.cells_per_page()).map(panel).collect();
                let heading = Heading::new("Panels").with_source("the source of the linkage").with_page(2, 3);
                let page = PanelPage { heading, layout, panels, scale: Default::default(), key: Some(&key) };
                let scene = compose_panels(&page, &options);
                assert!(scene.items.len() > 10);
                assert!(scene == compose_without_plotters(&page, &options), "{layout:?} on {:?}", options.paper);
            }
        }
    }

    #[test]
    fn plates_are_the_same() {
        let curve = FourBar { frame: 2.0, crank: 1.0, coupler: 2.5, rocker: 2.5 }.coupler_curve(5.0, 0.0).unwrap();
        let selected = curve.selected();
        let name = selected.name();
        let key = Key::for_cell(selected.family, &selected.solved.cell);
        for options in options() {
            for pose in [Default::default(), plate::moving_view(curve.linkage(), curve.circuit(), 1)] {
                let plate = plate::panel_page(&selected, &name, pose, &key);
                assert!(compose_panels(&plate, &options) == compose_without_plotters(&plate, &options));
            }
        }
    }

    /// Draws the border of each cell of a grid.
    fn draw_grid(root: &impl Area, margins: [f64; 4], [columns, rows]: [usize; 2]) {
        let cells = root.without_margins(margins).grid_cells(rows, columns);
        assert_eq!(cells.len(), columns * rows);
        for cell in cells {
            let stroke = Stroke { color: Color(1, 2, 3), width: 0.123, has_round_ends: false };
            cell.record_rectangle([Point::from(cell.size()), Point::new(0.004, 0.006)], stroke);
        }
    }

    #[test]
    fn grids_are_the_same() {
        for k in 0..200 {
            let part = f64::from(k) / 7.0;
            let paper = Paper { width: 150.0 + part, height: 120.0 - part / 2.0 };
            let (margins, grid) =
                ([1.0 + part, 2.345, 10.0 - part / 3.0, part], [1 + k as usize % 13, 1 + k as usize % 7]);
            let draw = |with_plotters: bool| {
                let options = Options::for_paper(paper);
                let mut scene = empty_scene("grid".to_owned(), &options, &options.theme);
                if with_plotters {
                    draw_grid(&plotters_area::whole_page(&mut scene), margins, grid);
                } else {
                    draw_grid(&scene_area::whole_page(&mut scene), margins, grid);
                }
                scene
            };
            assert_eq!(draw(true), draw(false));
        }
    }
}
