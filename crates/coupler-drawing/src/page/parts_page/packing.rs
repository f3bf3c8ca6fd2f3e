//! Views side by side in rows.

use super::super::rect::Rect;
use super::part_view::{PartView, Views};
use crate::scene::Item;
use coupler_curves::geometry::Vector;

/// The views of parts at a scale in rows of a rectangle, the highest first; `None` if they do not fit.
pub(super) fn layout(parts: &Views, scale: f64, rect: Rect) -> Option<Vec<Vec<Item>>> {
    let mut views: Vec<PartView> = parts.groups.iter().map(|group| parts.view(group, scale)).collect();
    views.sort_by(|a, b| b.size.y.total_cmp(&a.size.y));
    let gap = 1.5 * parts.theme.note_size;
    let mut rows: Vec<(f64, f64, Vec<PartView>)> = Vec::new();
    for view in views {
        if view.size.x > rect.size.x {
            return None;
        }
        match rows.iter_mut().find(|(width, ..)| width + gap + view.size.x <= rect.size.x) {
            Some((width, _, row)) => {
                *width += gap + view.size.x;
                row.push(view);
            }
            None => rows.push((view.size.x, view.size.y, vec![view])),
        }
    }
    let height = rows.iter().map(|(_, height, _)| height + gap).sum::<f64>() - gap;
    if height > rect.size.y {
        return None;
    }
    // What is left of the height is between the rows, and of the width between the views.
    let between = ((rect.size.y - height) / rows.len() as f64).min(4.0 * gap);
    let mut out = Vec::new();
    let mut y = 0.0;
    for (width, height, row) in rows {
        let spare = ((rect.size.x - width) / row.len() as f64).min(4.0 * gap);
        let mut x = 0.0;
        for view in row {
            let step = view.size.x + gap + spare;
            out.push(view.placed(rect.corner + Vector::new(x, y)));
            x += step;
        }
        y += height + gap + between;
    }
    Some(out)
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
