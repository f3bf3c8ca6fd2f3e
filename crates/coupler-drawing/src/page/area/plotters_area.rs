//! An area of plotters: it places elements, and inside it they keep full precision.

use std::cell::Cell;
use std::convert::Infallible;
use std::iter::{Once, once};

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Drawable, PointCollection, Rectangle};
use plotters::style::{RGBColor, ShapeStyle};
use plotters_backend::{BackendCoord, DrawingErrorKind};

use super::super::element::Element;
use super::Area;
use crate::scene::{Canvas, Color, Group, Scene, Stroke, pixel};
use coupler_curves::geometry::{Point, Vector};

/// An area of plotters, whose pixel is 1/100 mm.
pub(in crate::page) type PlottersArea<'s> = DrawingArea<Canvas<'s>, Shift>;

/// The whole page as an area.
pub(in crate::page) fn whole_page(scene: &mut Scene) -> PlottersArea<'_> {
    Canvas::new(scene).into_drawing_area()
}

impl Area for PlottersArea<'_> {
    fn size(&self) -> Vector {
        let (width, height) = self.dim_in_pixel();
        pixel::to_millimetres((width as i32, height as i32)).coords
    }

    fn without_margins(&self, margins: [f64; 4]) -> Self {
        let [top, bottom, left, right] = margins.map(pixel::from_millimetres);
        self.margin(top, bottom, left, right)
    }

    fn grid_cells(&self, rows: usize, columns: usize) -> Vec<Self> {
        self.split_evenly((rows, columns))
    }

    fn record(&self, element: impl Element) {
        on_canvas(self, |origin, canvas| canvas.record(element.into_item(pixel::to_millimetres(origin).coords)));
    }

    fn grouped(&self, group: Group, draw: impl FnOnce()) {
        let first = Cell::new(0);
        on_canvas(self, |_, canvas| first.set(canvas.scene().items.len()));
        draw();
        on_canvas(self, |_, canvas| canvas.scene().group_items(first.get(), group));
    }

    fn record_rectangle(&self, corners: [Point; 2], stroke: Stroke) {
        let Color(r, g, b) = stroke.color;
        let stroke_width = pixel::from_millimetres(stroke.width) as u32;
        let style = ShapeStyle { color: RGBColor(r, g, b).into(), filled: false, stroke_width };
        let corners = corners.map(|corner| (pixel::from_millimetres(corner.x), pixel::from_millimetres(corner.y)));
        self.draw(&Rectangle::new(corners, style)).expect("recording a scene does not fail");
    }
}

/// Does something with the canvas, given the origin of the area on it. It must not draw on an area, which would borrow the canvas twice.
fn on_canvas<'s>(area: &PlottersArea<'s>, work: impl FnOnce(BackendCoord, &mut Canvas<'s>)) {
    // A canvas cannot fail.
    area.draw(&AtOrigin(Cell::new(Some(work)))).expect("recording a scene does not fail");
}

/// What is done with the canvas, as an element for plotters that is anchored at the origin of the area it is drawn on.
struct AtOrigin<W>(Cell<Option<W>>);

impl<'a, W> PointCollection<'a, BackendCoord> for &'a AtOrigin<W> {
    type Point = BackendCoord;
    type IntoIter = Once<BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        once((0, 0))
    }
}

impl<'s, W: FnOnce(BackendCoord, &mut Canvas<'s>)> Drawable<Canvas<'s>> for AtOrigin<W> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut origin: I,
        canvas: &mut Canvas<'s>,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        if let Some((origin, work)) = origin.next().zip(self.0.take()) {
            work(origin, canvas);
        }
        Ok(())
    }
}
