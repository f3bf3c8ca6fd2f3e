//! The number of charts on a page.

use super::Paper;
use super::heading::margins;
use super::theme::Theme;
use coupler_curves::geometry::Vector;

/// The size of the contents of a page, in millimetres.
fn contents_size(paper: Paper, theme: &Theme) -> Vector {
    let [top, bottom, _] = margins(theme);
    Vector::new(paper.width - 2.0 * (theme.border + theme.margin), paper.height - top - bottom)
}

/// The most columns and rows of charts on a page: at its smallest, a chart is 18 ems of a caption wide and 12 high.
pub(super) fn max_grid(paper: Paper, theme: &Theme) -> [usize; 2] {
    max_in(contents_size(paper, theme), theme)
}

/// The most columns and rows of charts in contents of a size.
pub(super) fn max_in(contents: Vector, theme: &Theme) -> [usize; 2] {
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
