//! An area that records into its scene itself.

use std::cell::RefCell;
use std::rc::Rc;

use super::super::element::Element;
use super::Area;
use crate::scene::pixel::{self, Pixel};
use crate::scene::{Group, Item, Path, Polyline, Scene, Stroke};
use coupler_curves::geometry::{Point, Vector};

/// A rectangle of the page, with the scene that all areas of the page share.
pub(in crate::page) struct SceneArea<'s> {
    scene: Rc<RefCell<&'s mut Scene>>,
    /// The upper left corner.
    start: Pixel,
    /// The lower right corner.
    end: Pixel,
}

/// The whole page as an area.
pub(in crate::page) fn whole_page(scene: &mut Scene) -> SceneArea<'_> {
    let end = (pixel::from_millimetres(scene.width), pixel::from_millimetres(scene.height));
    SceneArea { scene: Rc::new(RefCell::new(scene)), start: (0, 0), end }
}

impl SceneArea<'_> {
    /// Another rectangle of the same page.
    fn with_corners(&self, start: Pixel, end: Pixel) -> Self {
        SceneArea { scene: Rc::clone(&self.scene), start, end }
    }

    fn push(&self, item: Item) {
        self.scene.borrow_mut().items.push(item);
    }
}

impl Area for SceneArea<'_> {
    fn size(&self) -> Vector {
        pixel::to_millimetres((self.end.0 - self.start.0, self.end.1 - self.start.1)).coords
    }

    fn without_margins(&self, margins: [f64; 4]) -> Self {
        let [top, bottom, left, right] = margins.map(pixel::from_millimetres);
        self.with_corners((self.start.0 + left, self.start.1 + top), (self.end.0 - right, self.end.1 - bottom))
    }

    fn grid_cells(&self, rows: usize, columns: usize) -> Vec<Self> {
        let xs = even_breaks(self.start.0, self.end.0, columns);
        let ys = even_breaks(self.start.1, self.end.1, rows);
        let row =
            |y: &[i32]| -> Vec<Self> { xs.windows(2).map(|x| self.with_corners((x[0], y[0]), (x[1], y[1]))).collect() };
        ys.windows(2).flat_map(row).collect()
    }

    fn record(&self, element: impl Element) {
        self.push(element.into_item(pixel::to_millimetres(self.start).coords));
    }

    fn grouped(&self, group: Group, draw: impl FnOnce()) {
        let first = self.scene.borrow().items.len();
        draw();
        self.scene.borrow_mut().group_items(first, group);
    }

    fn record_rectangle(&self, corners: [Point; 2], stroke: Stroke) {
        let on_page = |corner: Point| {
            (self.start.0 + pixel::from_millimetres(corner.x), self.start.1 + pixel::from_millimetres(corner.y))
        };
        let [a, b] = corners.map(on_page);
        let (low, high) = ((a.0.min(b.0), a.1.min(b.1)), (a.0.max(b.0), a.1.max(b.1)));
        let points = [low, (high.0, low.1), high, (low.0, high.1)].map(pixel::to_millimetres).to_vec();
        let width = f64::from(pixel::from_millimetres(stroke.width)) / pixel::PER_MM;
        let polylines = vec![Polyline { points, is_closed: true }];
        self.push(Item::Path(Path { polylines, stroke: Some(Stroke { width, ..stroke }), fill: None }));
    }
}

/// The ends of `count` parts of a range whose lengths differ by one at most; the longer ones come first.
fn even_breaks(start: i32, end: i32, count: usize) -> Vec<i32> {
    let count = count as i32;
    let (part, rest) = ((end - start) / count, (end - start) % count);
    (0..=count).map(|k| start + k * part + k.min(rest)).collect()
}
