//! The `chart` layout: a grid of charts, each of one quantity over all curves.
//!
//! plotters draws axes, ticks and grids; the lines are elements of this crate, which keep full precision.

mod coinciding;
mod figure;
mod line;
mod line_labels;
mod number;
mod scale;

use super::area::{self, Area, PlottersArea};
use super::heading::margins;
use super::theme::Theme;
use super::{ChartPage, Options, empty_scene};
use crate::scene::{Group, Item, Scene};
use figure::ChartFigure;

/// Composes a page of charts.
pub fn compose_charts(page: &ChartPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(&page.heading, options, &theme);
    draw_charts(&mut scene, page, &theme);
    scene
}

fn draw_charts(scene: &mut Scene, page: &ChartPage, theme: &Theme) {
    let [columns, rows] = page.layout.grid();
    let top = page.heading.draw(&area::whole_page(scene), theme);
    for (k, quantity_index) in page.quantity_range.clone().enumerate() {
        // The items that plotters records are collected in a group.
        let first_item = scene.items.len();
        let data = {
            let areas = chart_areas(scene, top, [columns, rows], theme);
            let Some(area) = areas.get(k) else { continue };
            let theme = theme.for_panel_size(area.size());
            let figures: Vec<ChartFigure> =
                page.quantity_range.clone().map(|index| ChartFigure::new(page, index, area.size(), &theme)).collect();
            // The frames of all charts of a page have the same margin.
            let margin = figures.iter().map(ChartFigure::left_margin).fold(0.0, f64::max);
            figures[k].draw(area, margin, &theme)
        };
        let items = scene.items.split_off(first_item);
        let quantity = &page.chart.y[quantity_index];
        let title = format!("{} over {}", quantity.title, page.chart.x.title);
        let id = format!("{}-chart-{}", page.heading.family_id, quantity_index + 1);
        scene.items.push(Item::Group(Group { id, class: "chart", title, data, items }));
    }
}

/// The areas of the charts below the heading, row by row.
fn chart_areas<'s>(
    scene: &'s mut Scene,
    top: f64,
    [columns, rows]: [usize; 2],
    theme: &Theme,
) -> Vec<PlottersArea<'s>> {
    let [_, bottom, _] = margins(theme);
    // The charts are aligned with the title and the folio.
    let side = theme.border + theme.margin;
    area::whole_page(scene).without_margins([top, bottom, side, side]).grid_cells(rows, columns)
}
