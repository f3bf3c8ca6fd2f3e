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
use crate::scene::{Canvas, Color, Scene, Stroke, pixel};
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
        // A canvas cannot fail, and no element draws on an area, which would borrow it twice.
        self.draw(&AtOrigin(Cell::new(Some(element)))).expect("recording a scene does not fail");
    }

    fn record_rectangle(&self, corners: [Point; 2], stroke: Stroke) {
        let Color(r, g, b) = stroke.color;
        let stroke_width = pixel::from_millimetres(stroke.width) as u32;
        let style = ShapeStyle { color: RGBColor(r, g, b).into(), filled: false, stroke_width };
        let corners = corners.map(|corner| (pixel::from_millimetres(corner.x), pixel::from_millimetres(corner.y)));
        self.draw(&Rectangle::new(corners, style)).expect("recording a scene does not fail");
    }
}

/// An element for plotters, anchored at the origin of the area it is drawn on, until it is drawn.
struct AtOrigin<E>(Cell<Option<E>>);

impl<'a, E> PointCollection<'a, BackendCoord> for &'a AtOrigin<E> {
    type Point = BackendCoord;
    type IntoIter = Once<BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        once((0, 0))
    }
}

impl<'s, E: Element> Drawable<Canvas<'s>> for AtOrigin<E> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut origin: I,
        canvas: &mut Canvas<'s>,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        if let Some((origin, element)) = origin.next().zip(self.0.take()) {
            canvas.record(element.into_item(pixel::to_millimetres(origin).coords));
        }
        Ok(())
    }
}
