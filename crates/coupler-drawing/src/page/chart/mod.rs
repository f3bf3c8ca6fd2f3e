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
use super::heading::margins;
use super::key_drawing;
use super::rect::Rect;
use super::symbols::{self, Mark, Symbol};
use super::theme::Theme;
use super::{ChartPage, Options, chart_grid, empty_scene};
use crate::chart::PointSource;
use crate::scene::{Group, Scene};
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
    let size = area::whole_page(scene).size();
    let bottom = margin + page.heading.folio_height(size, theme);
    // The charts are aligned with the title and the folio.
    let side = theme.border + theme.margin;
    let above =
        |bottom: f64| Rect { corner: Point::new(side, top), size: Vector::new(size.x - 2.0 * side, bottom - top) };
    // What the lines have is known after they are drawn.
    let all_features = LineFeatures { has_marks: page.chart.point_source == PointSource::Curves, has_gaps: true };
    let foot = |features| symbols::at_foot(size, &page.heading, &page_symbols(page, features, theme), theme);
    let mut contents = above(size.y - bottom);
    let mut charts = contents;
    if let Some((rect, beside)) = page.key.and_then(|_| key_rect(above(foot(all_features).1), page, theme)) {
        contents = above(foot(all_features).1);
        charts = beside;
        draw_key(&area::whole_page(scene), rect, page, theme);
    }
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
        let quantity = &page.chart.y[quantity_index];
        let title = format!("{} over {}", quantity.title, page.chart.x.title);
        let id = format!("{}-chart-{}", page.heading.family_id, quantity_index + 1);
        let description = format!("Chart: {title}");
        scene.group_items(first_item, Group { id, class: "chart", title, description, data, ..Group::default() });
    }
    if charts.size != contents.size {
        for (at, line) in foot(features).0 {
            symbols::draw(&area::whole_page(scene), &line, at, theme);
        }
    }
}

/// The symbols of the key, and of the lines of the charts.
fn page_symbols(page: &ChartPage, features: LineFeatures, theme: &Theme) -> Vec<Symbol> {
    let figure = page.key.and_then(|(_, panel)| Some((panel, Figure::from_panel(panel)?)));
    let Some((panel, figure)) = figure else { return Vec::new() };
    let ink = figure.first_ink(theme);
    let mut symbols = symbols::of_joints(panel.solved_cell, ink);
    symbols.extend(symbols::of_chains(&panel.solved_cell.linkage, theme));
    let mut add = |mark: Mark, meaning: &str| symbols.push(Symbol { mark, meaning: meaning.to_owned() });
    if features.has_marks {
        add(Mark::Limit(ink), "mark: a linkage of the family; lines between marks are computed, too");
    }
    if features.has_gaps {
        add(Mark::Letter("–  –"), "a gap: no value, or a jump");
    }
    symbols
}

/// The rectangles of the key and of the charts next to it, if there is a linkage and they do not become too small.
fn key_rect(contents: Rect, page: &ChartPage, theme: &Theme) -> Option<(Rect, Rect)> {
    let [columns, rows] = page.layout.grid();
    let (charts, rect) = key_drawing::divide(contents, theme);
    let [most_columns, most_rows] = chart_grid::max_in(charts.size, theme);
    let has_figure = page.key.is_some_and(|(_, panel)| Figure::from_panel(panel).is_some());
    (has_figure && columns <= most_columns && rows <= most_rows).then_some((rect?, charts))
}

/// Draws the key of the linkages.
fn draw_key(root: &impl Area, rect: Rect, page: &ChartPage, theme: &Theme) {
    if let Some((key, panel)) = page.key {
        let figure = Figure::from_panel(panel);
        key_drawing::draw(root, rect.inset(0.5 * theme.margin), key, &figure.iter().collect::<Vec<_>>(), theme);
    }
}
