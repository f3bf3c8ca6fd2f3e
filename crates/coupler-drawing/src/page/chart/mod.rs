//! The `chart` layout: a grid of charts, each of one quantity over all curves.
//!
//! plotters draws axes, ticks and grids; the lines are elements of this crate, which keep full precision.

mod coinciding;
mod figure;
mod legend;
mod line;
mod line_labels;
mod number;
mod scale;

use super::area::{self, Area, PlottersArea};
use super::empty_scene::empty_scene;
use super::figure::Figure;
use super::heading::{self, margins};
use super::rect::Rect;
use super::symbols::{self, Mark, Symbol};
use super::theme::Theme;
use super::{ChartPage, Options, Paper, chart_grid};
use super::{key_division, key_drawing};
use crate::chart::PointSource;
use crate::scene::{Group, Scene};
use coupler_curves::geometry::{Point, Vector};
use figure::{ChartFigure, LineFeatures};
use legend::MOST_LABELS;

/// Composes a page of charts.
pub fn compose_charts(page: &ChartPage, options: &Options) -> Scene {
    let theme = options.theme.for_paper(options.paper);
    let mut scene = empty_scene(page.heading.page_title(), options, &theme);
    draw_charts(&mut scene, page, options, &theme);
    scene
}

fn draw_charts(scene: &mut Scene, page: &ChartPage, options: &Options, theme: &Theme) {
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
    let key = page.key.and_then(|(key, panel)| Some((key, Figure::from_panel(panel)?)));
    let foot = |features, notes: &[String], has_key: bool| {
        let mut symbols = key.as_ref().map_or(Vec::new(), |(_, figure)| page_symbols(figure, features, has_key, theme));
        symbols.extend(notes.iter().map(|note| Symbol { mark: Mark::Letter("…"), meaning: note.clone() }));
        symbols::at_foot(size, &page.heading, &symbols, theme)
    };
    let grid = chart_grid::beside_key(page.layout.grid());
    // The charts, and the key, which may have no room, in contents of a size.
    let divided = |contents: Rect, theme: &Theme| match page.key {
        Some((key, _)) if key_division::has_room(contents.size, grid, Some(key), theme) => {
            let (charts, key) = key_division::divide(contents, grid, key, theme);
            (charts, Some(key))
        }
        _ => (contents, None),
    };
    let omitted_in = |contents: Rect, theme: &Theme| omitted_labels(page, divided(contents, theme).0.size, theme);
    let mut notes = Vec::new();
    let mut contents = if key.is_some() { above(foot(all_features, &notes, true).1) } else { above(size.y - bottom) };
    let has_key = divided(contents, theme).1.is_some();
    if let (Some((key, _)), false) = (&key, has_key) {
        notes.push(key_division::left_out_note(contents.size, grid, key, options));
    }
    if page.series.len() <= MOST_LABELS && omitted_in(contents, theme) > 0 {
        let taken = heading::contents_size(options.paper, theme) - contents.size;
        let has_room = |paper: &Paper| {
            let theme = &options.theme.for_paper(*paper);
            let size = heading::contents_size(*paper, theme) - taken;
            omitted_in(Rect { corner: Point::origin(), size }, theme) == 0
        };
        notes.extend(
            options
                .paper
                .larger()
                .find(has_room)
                .map(|paper| format!("all lines have their labels on paper of {} × {} mm", paper.width, paper.height)),
        );
    }
    if !notes.is_empty() {
        contents = above(foot(all_features, &notes, has_key).1);
    }
    let (charts, key_rect) = divided(contents, theme);
    if let (Some((key, figure)), Some(rect)) = (&key, key_rect) {
        key_drawing::draw(&area::whole_page(scene), rect, key, &[figure], theme);
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
            // The frames of all charts of a page have the same margins.
            let margins = figures.iter().map(|figure| [figure.left_margin(), figure.legend_height()]);
            let margins = margins.fold([0.0, 0.0], |[a, b]: [f64; 2], [left, legend]| [a.max(left), b.max(legend)]);
            let (data, of_chart) = figures[k].draw(area, margins, &theme);
            features = features.or(of_chart);
            data
        };
        let quantity = &page.chart.y[quantity_index];
        let title = format!("{} over {}", quantity.title, page.chart.x.title);
        let id = format!("{}-chart-{}", page.heading.family_id, quantity_index + 1);
        let description = format!("Chart: {title}");
        scene.group_items(first_item, Group { id, class: "chart", title, description, data, ..Group::default() });
    }
    for (at, line) in foot(features, &notes, has_key).0 {
        symbols::draw(&area::whole_page(scene), &line, at, theme);
    }
}

/// The greatest number of lines of a chart without labels, for which charts of a size have no room.
fn omitted_labels(page: &ChartPage, charts: Vector, theme: &Theme) -> usize {
    let [columns, rows] = page.layout.grid();
    let size = Vector::new(charts.x / columns as f64, charts.y / rows as f64);
    let theme = &theme.for_panel_size(size);
    let omitted = page.quantity_range.clone().map(|index| ChartFigure::new(page, index, size, theme).omitted);
    omitted.max().unwrap_or(0)
}

/// The symbols of the key with a figure, if it is drawn, and of the lines of the charts.
fn page_symbols(figure: &Figure, features: LineFeatures, has_key: bool, theme: &Theme) -> Vec<Symbol> {
    let solved = figure.panel.solved_cell;
    let ink = figure.first_ink(theme);
    let mut symbols = Vec::new();
    if has_key {
        symbols.extend(symbols::of_joints(solved, ink));
        symbols.extend(symbols::of_chains(&solved.linkage, theme));
    }
    let mut add = |mark: Mark, meaning: &str| symbols.push(Symbol { mark, meaning: meaning.to_owned() });
    if features.has_marks {
        add(Mark::Limit(ink), "mark: a linkage of the family; lines between marks are computed, too");
    }
    if features.has_gaps {
        add(Mark::Letter("–  –"), "a gap: no value, or a jump");
    }
    symbols
}
