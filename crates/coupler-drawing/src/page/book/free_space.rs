//! Where nothing is drawn on a page.

use crate::scene::{Item, Scene, Shape};
use coupler_curves::geometry::{Point, Vector};

/// The squares of a page, of a millimetre, in which something is drawn.
pub(super) struct FreeSpace {
    columns: usize,
    rows: usize,
    /// The number of squares with something in them that are above and to the left of each corner.
    sums: Vec<u32>,
}

impl FreeSpace {
    /// The space of a page.
    pub fn of_page(scene: &Scene) -> FreeSpace {
        let [columns, rows] = [scene.width, scene.height].map(|side| side.floor().max(0.0) as usize);
        let mut is_used = vec![false; columns * rows];
        let mut mark = |low: Point, high: Point| {
            let range = |low: f64, high: f64, count: usize| {
                low.floor().max(0.0) as usize..(high.floor() + 1.0).clamp(0.0, count as f64) as usize
            };
            for row in range(low.y, high.y, rows) {
                for column in range(low.x, high.x, columns) {
                    is_used[row * columns + column] = true;
                }
            }
        };
        for shape in scene.items.iter().flat_map(Item::shapes) {
            mark_shape(&shape, &mut mark);
        }
        let mut sums = vec![0; (columns + 1) * (rows + 1)];
        for row in 0..rows {
            for column in 0..columns {
                let at = |row: usize, column: usize| row * (columns + 1) + column;
                sums[at(row + 1, column + 1)] = sums[at(row, column + 1)] + sums[at(row + 1, column)]
                    - sums[at(row, column)]
                    + u32::from(is_used[row * columns + column]);
            }
        }
        FreeSpace { columns, rows, sums }
    }

    /// The upper left corner of a free square inside the border, at this distance from the edges: the one nearest to it, and of those the uppermost
    /// and rightmost.
    #[cfg(feature = "pdf")]
    pub fn square(&self, side: f64, border: f64) -> Option<Point> {
        let count = side.ceil() as usize;
        // The border has a line of its own.
        let first = border.ceil() as usize + 1;
        let [last_column, last_row] = [self.columns, self.rows].map(|length| length.checked_sub(first + count));
        let (last_column, last_row) = (last_column?, last_row?);
        let places = (first..=last_row).flat_map(|row| (first..=last_column).rev().map(move |column| (row, column)));
        let from_edge = |&(row, column): &(usize, usize)| {
            (row - first).min(last_row - row).min(column - first).min(last_column - column)
        };
        let is_free = |&(row, column): &(usize, usize)| self.used([row, column], [row + count, column + count]) == 0;
        let (row, column) = places.filter(is_free).min_by_key(from_edge)?;
        Some(Point::new(column as f64, row as f64))
    }

    /// The number of squares with something in them from a row and column up to others.
    fn used(&self, [top, left]: [usize; 2], [bottom, right]: [usize; 2]) -> u32 {
        let at = |row: usize, column: usize| self.sums[row * (self.columns + 1) + column];
        at(bottom, right) + at(top, left) - at(top, right) - at(bottom, left)
    }

    /// The number of squares with something in them that a square with a centre meets.
    pub fn used_around(&self, centre: Point, half: f64) -> u32 {
        let index = |x: f64, count: usize| x.clamp(0.0, count as f64) as usize;
        let [top, left] = [index((centre.y - half).floor(), self.rows), index((centre.x - half).floor(), self.columns)];
        let bottom = index((centre.y + half).floor() + 1.0, self.rows);
        self.used([top, left], [bottom, index((centre.x + half).floor() + 1.0, self.columns)])
    }
}

/// Marks the rectangles that a shape is in.
fn mark_shape(shape: &Shape, mark: &mut impl FnMut(Point, Point)) {
    /// Of the polylines of curves, in millimetres.
    const FLATNESS: f64 = 0.2;
    match shape {
        Shape::Path(path) => {
            for line in &path.polylines {
                mark_line(&line.points, mark);
                if let (true, [first, .., last]) = (line.is_closed, &line.points[..]) {
                    mark_line(&[*last, *first], mark);
                }
                if path.fill.is_some() {
                    mark_bounds(&line.points, mark);
                }
            }
        }
        Shape::Curve(curve) => curve.splines.iter().for_each(|spline| mark_line(&spline.flatten(FLATNESS), mark)),
        Shape::Circle(circle) => {
            let reach = Vector::repeat(circle.radius);
            mark(circle.centre - reach, circle.centre + reach);
        }
        Shape::Text(text) => mark_bounds(&text.corners(), mark),
    }
}

/// Marks the steps of a line, each of at most half a millimetre.
fn mark_line(points: &[Point], mark: &mut impl FnMut(Point, Point)) {
    const STEP: f64 = 0.5;
    for ends in points.windows(2) {
        let along = ends[1] - ends[0];
        let count = (along.norm() / STEP).ceil().clamp(1.0, 1e4) as usize;
        for k in 0..=count {
            let at = ends[0] + along * (k as f64 / count as f64);
            mark(at, at);
        }
    }
}

fn mark_bounds(points: &[Point], mark: &mut impl FnMut(Point, Point)) {
    let Some(first) = points.first() else { return };
    let (low, high) = points.iter().fold((*first, *first), |(low, high), point| (low.inf(point), high.sup(point)));
    mark(low, high);
}
