//! Views side by side in rows.

use super::super::rect::Rect;
use super::super::theme::Theme;
use super::part_view::{PartView, Views};
use crate::scene::Item;
use coupler_curves::geometry::{Point, Vector};

/// The views of parts at a scale in rows of a rectangle; `None` if they do not fit.
pub(super) fn layout(parts: &Views, scale: f64, rect: Rect) -> Option<Vec<Vec<Item>>> {
    let views = parts.all(scale);
    let corners = corners(&sizes(&views), rect, parts.theme)?;
    Some(views.into_iter().zip(corners).map(|(view, corner)| view.placed(corner)).collect())
}

/// The sizes of views.
pub(super) fn sizes(views: &[PartView]) -> Vec<Vector> {
    views.iter().map(|view| view.size).collect()
}

/// The upper left corners of views of some sizes in rows of a rectangle, of which the highest are the first; `None` if they do not fit.
pub(super) fn corners(sizes: &[Vector], rect: Rect, theme: &Theme) -> Option<Vec<Point>> {
    let gap = 1.5 * theme.note_size;
    let mut by_height: Vec<usize> = (0..sizes.len()).collect();
    by_height.sort_by(|&a, &b| sizes[b].y.total_cmp(&sizes[a].y));
    let mut rows: Vec<(f64, Vec<usize>)> = Vec::new();
    for k in by_height {
        let width = sizes[k].x;
        if width > rect.size.x {
            return None;
        }
        match rows.iter_mut().find(|(filled, _)| filled + gap + width <= rect.size.x) {
            Some((filled, row)) => {
                *filled += gap + width;
                row.push(k);
            }
            None => rows.push((width, vec![k])),
        }
    }
    let height = rows.iter().map(|(_, row)| sizes[row[0]].y + gap).sum::<f64>() - gap;
    if height > rect.size.y {
        return None;
    }
    // What is left of the height is between the rows, and of the width between the views.
    let between = ((rect.size.y - height) / rows.len() as f64).min(4.0 * gap);
    let mut corners = vec![rect.corner; sizes.len()];
    let mut y = 0.0;
    for (width, row) in rows {
        let spare = ((rect.size.x - width) / row.len() as f64).min(4.0 * gap);
        let mut x = 0.0;
        for &k in &row {
            corners[k] += Vector::new(x, y);
            x += sizes[k].x + gap + spare;
        }
        y += sizes[row[0]].y + gap + between;
    }
    Some(corners)
}

/// The greatest scale up to one at which something fits, to one in a thousand; that one itself over a million if there is none.
pub(super) fn greatest(most: f64, fits: impl Fn(f64) -> bool) -> f64 {
    const STEPS: usize = 40;
    let mut high = most;
    let mut low = most;
    for _ in 0..STEPS {
        if fits(low) {
            break;
        }
        high = low;
        low /= 1.5;
    }
    while high / low > 1.001 {
        let middle = (low * high).sqrt();
        if fits(middle) { low = middle } else { high = middle }
    }
    low
}
