//! Grids in which a number of drawings is large.

use coupler_curves::geometry::Vector;

/// The columns and rows for `count` drawings in contents of a size, each about `aspect_ratio` times as wide as high; at most `most` columns and
/// rows.
pub(super) fn balanced_grid(
    contents: Vector,
    [most_columns, most_rows]: [usize; 2],
    count: usize,
    aspect_ratio: f64,
) -> [usize; 2] {
    let count = count.max(1);
    let shapes = (1..=count.min(most_columns)).map(|columns| [columns, count.div_ceil(columns).min(most_rows)]);
    // The cost grows with the deviation from the aspect ratio and with the number of empty areas.
    let cost = |&[columns, rows]: &[usize; 2]| {
        let shape = (contents.x / columns as f64) / (contents.y / rows as f64) / aspect_ratio;
        let empty = (columns * rows).saturating_sub(count) as f64 / count as f64;
        shape.max(1.0 / shape) * (1.0 + empty)
    };
    shapes.min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or([1, 1])
}
