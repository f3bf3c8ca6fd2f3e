//! The `chart` layout: a grid of charts, each of one quantity over all curves.
//!
//! plotters draws axes, ticks and grids; the lines are elements of this crate, which keep full precision.

mod figure;
mod line;
mod line_labels;
mod number;
mod scale;

use plotters::drawing::IntoDrawingArea;

use super::element::{Area, size};
use super::heading::margins;
use super::theme::Theme;
use super::{ChartPage, Paper};
use crate::scene::{Canvas, Group, Item, Scene};
use coupler_curves::geometry::Vector;
use figure::ChartFigure;

/// Draws a page of charts.
pub(super) fn compose(scene: &mut Scene, page: &ChartPage, theme: &Theme) {
    let [columns, rows] = page.layout.grid();
    page.heading.draw(&Canvas::new(scene).into_drawing_area(), theme);
    for (k, quantity_index) in page.quantity_range.clone().enumerate() {
        // The items that plotters records are collected in a group.
        let first_item = scene.items.len();
        let data = {
            let areas = chart_areas(scene, [columns, rows], theme);
            let Some(area) = areas.get(k) else { continue };
            let theme = theme.for_panel_size(size(area));
            let figures: Vec<ChartFigure> =
                page.quantity_range.clone().map(|index| ChartFigure::new(page, index, size(area), &theme)).collect();
            // The frames of all charts of a page have the same margin.
            let margin = figures.iter().map(ChartFigure::left_margin).fold(0.0, f64::max);
            figures[k].draw(area, margin, &theme)
        };
        let items = scene.items.split_off(first_item);
        let quantity = &page.chart.y[quantity_index];
        let title = format!("{} over {}", quantity.text, page.chart.x.text);
        let id = format!("{}-chart-{}", page.heading.family_id, quantity_index + 1);
        scene.items.push(Item::Group(Group { id, class: "chart", title, data, items }));
    }
}

/// The areas of the charts, row by row.
fn chart_areas<'s>(scene: &'s mut Scene, [columns, rows]: [usize; 2], theme: &Theme) -> Vec<Area<'s>> {
    let [top, bottom, _] = margins(theme).map(Canvas::to_pixels);
    // The charts are aligned with the title and the folio.
    let side = Canvas::to_pixels(theme.border + theme.margin);
    let root = Canvas::new(scene).into_drawing_area();
    root.margin(top, bottom, side, side).split_evenly((rows, columns))
}

/// The size of the contents of a page, in millimetres.
fn contents_size(paper: Paper, theme: &Theme) -> Vector {
    let [top, bottom, _] = margins(theme);
    Vector::new(paper.width - 2.0 * (theme.border + theme.margin), paper.height - top - bottom)
}

/// The most columns and rows of charts on a page: at its smallest, a chart is 18 ems of a caption wide and 12 high.
pub(super) fn max_grid(paper: Paper, theme: &Theme) -> [usize; 2] {
    let contents = contents_size(paper, theme);
    let em = theme.for_panel_size(Vector::zeros()).caption_size;
    let fit = |length: f64, least: f64| ((length / least).floor() as usize).max(1);
    [fit(contents.x, 18.0 * em), fit(contents.y, 12.0 * em)]
}

/// The columns and rows for `count` charts: at most six on a page, each about 1.5 times as wide as high.
pub(super) fn balanced_grid(paper: Paper, theme: &Theme, count: usize) -> [usize; 2] {
    const MAX_CHARTS: usize = 6;
    const ASPECT_RATIO: f64 = 1.5;
    let count = count.clamp(1, MAX_CHARTS);
    let contents = contents_size(paper, theme);
    let [most_columns, most_rows] = max_grid(paper, theme);
    let shapes = (1..=count.min(most_columns)).map(|columns| [columns, count.div_ceil(columns).min(most_rows)]);
    // The cost grows with the deviation from the aspect ratio and with the number of empty areas.
    let cost = |&[columns, rows]: &[usize; 2]| {
        let shape = (contents.x / columns as f64) / (contents.y / rows as f64) / ASPECT_RATIO;
        let empty = (columns * rows).saturating_sub(count) as f64 / count as f64;
        shape.max(1.0 / shape) * (1.0 + empty)
    };
    shapes.min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or([1, 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_of_charts_fits_the_paper_and_their_number() {
        let [letter, tabloid, ..] = Paper::NAMED.map(|(_, paper)| paper);
        let grid = |paper, count| balanced_grid(paper, &Theme::default().for_paper(paper), count);
        assert_eq!([1, 2, 4, 6, 40].map(|count| grid(tabloid, count)), [[1, 1], [2, 1], [2, 2], [3, 2], [3, 2]]);
        assert_eq!(grid(letter, 1), [1, 1]);
        let slip = Paper { width: 50.0, height: 2000.0 };
        assert_eq!(grid(slip, 3)[0], 1);
    }
}
