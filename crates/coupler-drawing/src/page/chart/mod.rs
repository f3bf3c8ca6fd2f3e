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
use super::figure::Figure;
use super::heading::{foot_baseline, margins};
use super::key::{self, Key};
use super::rect::Rect;
use super::symbols::{self, Mark, Symbol};
use super::theme::Theme;
use super::{ChartPage, Options, Panel, chart_grid, empty_scene};
use crate::scene::{Group, Item, Scene};
use coupler_curves::geometry::{Point, Vector};
use figure::{ChartFigure, LineFeatures};

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
    let [_, margin, _] = margins(theme);
    let bottom = margin + page.heading.folio_height(area::whole_page(scene).size(), theme);
    // The charts are aligned with the title and the folio.
    let side = theme.border + theme.margin;
    let size = area::whole_page(scene).size();
    let contents = Rect { corner: Point::new(side, top), size: size - Vector::new(2.0 * side, top + bottom) };
    let charts = match page.key {
        Some((key, panel)) => draw_key(&area::whole_page(scene), contents, (key, panel), page, theme),
        None => contents,
    };
    let far = charts.corner + charts.size;
    let margins = [charts.corner.y, size.y - far.y, charts.corner.x, size.x - far.x];
    let mut features = LineFeatures::default();
    for (k, quantity_index) in page.quantity_range.clone().enumerate() {
        // The items that plotters records are collected in a group.
        let first_item = scene.items.len();
        let data = {
            let areas: Vec<PlottersArea> = area::whole_page(scene).without_margins(margins).grid_cells(rows, columns);
            let Some(area) = areas.get(k) else { continue };
            let theme = theme.for_panel_size(area.size());
            let figures: Vec<ChartFigure> =
                page.quantity_range.clone().map(|index| ChartFigure::new(page, index, area.size(), &theme)).collect();
            // The frames of all charts of a page have the same margin.
            let margin = figures.iter().map(ChartFigure::left_margin).fold(0.0, f64::max);
            let (data, of_chart) = figures[k].draw(area, margin, &theme);
            features = features.or(of_chart);
            data
        };
        let items = scene.items.split_off(first_item);
        let quantity = &page.chart.y[quantity_index];
        let title = format!("{} over {}", quantity.title, page.chart.x.title);
        let id = format!("{}-chart-{}", page.heading.family_id, quantity_index + 1);
        scene.items.push(Item::Group(Group { id, class: "chart", title, data, items }));
    }
    if let (Some((_, panel)), true) = (page.key, charts.size != contents.size) {
        draw_symbols(&area::whole_page(scene), contents.corner.x, panel, features, theme);
    }
}

/// Draws the symbols of a key, and of the lines of the charts, at the foot.
fn draw_symbols(root: &impl Area, left: f64, panel: &Panel, features: LineFeatures, theme: &Theme) {
    let Some(figure) = Figure::from_panel(panel) else { return };
    let ink = figure.first_ink(theme);
    let mut symbols = symbols::of_joints(panel.solved_cell, ink);
    let mut add = |mark: Mark, meaning: &str| symbols.push(Symbol { mark, meaning: meaning.to_owned() });
    if features.has_marks {
        add(Mark::Limit(ink), "mark: a linkage of the family; lines between marks are computed, too");
    }
    if features.has_gaps {
        add(Mark::Letter("–  –"), "a gap: no value, or a jump");
    }
    symbols::draw(root, &symbols, Point::new(left, foot_baseline(root.size(), theme)), theme);
}

/// Draws the key of the linkages next to the charts, if they do not become too small; the
/// part of the contents that is left to the charts.
fn draw_key(root: &impl Area, contents: Rect, (key, panel): (&Key, &Panel), page: &ChartPage, theme: &Theme) -> Rect {
    let [columns, rows] = page.layout.grid();
    let (charts, rect) = key::divide(contents, theme);
    let [most_columns, most_rows] = chart_grid::max_in(charts.size, theme);
    let (Some(rect), Some(figure)) = (rect, Figure::from_panel(panel)) else { return contents };
    if columns > most_columns || rows > most_rows {
        return contents;
    }
    key::draw(root, rect.inset(0.5 * theme.margin), key, Some(&figure), theme);
    charts
}
