//! The number of charts on a page.

use super::Paper;
use super::balanced_grid::balanced_grid;
use super::heading::contents_size;
use super::key_division::{self, Beside};
use super::theme::Theme;
use coupler_curves::geometry::Vector;

/// The least width and height of a chart, in ems of a caption.
const LEAST: [f64; 2] = [18.0, 12.0];

/// The most columns and rows of charts on a page.
pub(super) fn max_grid(paper: Paper, theme: &Theme) -> [usize; 2] {
    max_in(contents_size(paper, theme), theme)
}

/// The most columns and rows of charts in contents of a size.
pub(super) fn max_in(contents: Vector, theme: &Theme) -> [usize; 2] {
    let em = theme.for_panel_size(Vector::zeros()).caption_size;
    let fit = |length: f64, least: f64| ((length / least).floor() as usize).max(1);
    [fit(contents.x, LEAST[0] * em), fit(contents.y, LEAST[1] * em)]
}

/// Charts beside a key.
pub(super) fn beside_key(grid: [usize; 2]) -> Beside {
    Beside { grid, least: LEAST, least_on_small_paper: LEAST }
}

/// The columns and rows for `count` charts: at most six on a page, each about 1.5 times as wide as high, so that the key has room.
pub(super) fn for_charts(paper: Paper, theme: &Theme, count: usize) -> [usize; 2] {
    const MAX_CHARTS: usize = 6;
    const ASPECT_RATIO: f64 = 1.5;
    let contents = contents_size(paper, theme);
    let charts = key_division::beside(contents, beside_key([1, 1]), theme);
    balanced_grid(contents, max_in(charts, theme), count.min(MAX_CHARTS), ASPECT_RATIO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_of_charts_fits_the_paper_and_their_number() {
        let [letter, tabloid, ..] = Paper::NAMED.map(|(_, paper)| paper);
        let grid = |paper, count| for_charts(paper, &Theme::default().for_paper(paper), count);
        assert_eq!([1, 2, 4, 6, 40].map(|count| grid(tabloid, count)), [[1, 1], [2, 1], [2, 2], [3, 2], [3, 2]]);
        assert_eq!(grid(letter, 1), [1, 1]);
        let slip = Paper { width: 50.0, height: 2000.0 };
        assert_eq!(grid(slip, 3)[0], 1);
    }
}
