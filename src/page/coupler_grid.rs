//! The `coupler-grid` layout: a linkage, and ten coupler points of it on their grid.

use plotters::drawing::IntoDrawingArea;

use super::theme::Theme;
use super::{GridSheet, Options};
use crate::scene::{Canvas, Scene};

pub(super) fn compose(scene: &mut Scene, sheet: &GridSheet, _options: &Options, theme: &Theme) {
    let root = Canvas::new(scene).into_drawing_area();
    sheet.heading.draw(&root, theme);
}
