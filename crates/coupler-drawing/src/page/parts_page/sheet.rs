//! Where on the page the views, the assembly, the table and the title block are.

use super::super::rect::Rect;
use super::super::theme::Theme;
use coupler_curves::geometry::Vector;

/// The rectangles of a page.
pub(super) struct Sheet {
    pub views: Rect,
    pub assembly: Rect,
    pub table: Rect,
    pub title: Rect,
    /// Whether the title block is without what the page says elsewhere.
    pub is_title_short: bool,
}

/// What fits a page that is divided in some way.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Fitting {
    pub views: bool,
    /// The number of rows of the table.
    pub rows: usize,
}

/// A way to divide a page.
#[derive(Clone, Copy)]
struct Division {
    /// The part of the page that the views leave to everything else, and of its height or width the part that the assembly takes at most.
    parts: [f64; 2],
    /// Whether everything else is in a column on the right of the views, with the assembly over the table, and not in a row under them.
    is_column: bool,
    /// Whether the title block is across the foot of the page, and not under the table.
    is_title_across: bool,
    is_title_short: bool,
}

impl Division {
    /// All of them: first as most pages are, a column on a wide page and a row on a high one.
    fn all(is_wide: bool) -> impl Iterator<Item = Division> {
        const PARTS: [[f64; 2]; 4] = [[0.3, 0.4], [0.36, 0.36], [0.43, 0.3], [0.5, 0.25]];
        let with = move |[is_turned, is_title_across, is_title_short]: [bool; 3]| {
            let is_column = is_wide != is_turned;
            PARTS.into_iter().map(move |parts| Division { parts, is_column, is_title_across, is_title_short })
        };
        let across = [[false, false], [false, true], [true, false], [true, true]];
        let kinds = [false, true]
            .into_iter()
            .flat_map(move |is_short| across.map(|[turned, across]| [turned, across, is_short]));
        kinds.flat_map(with)
    }
}

impl Sheet {
    /// The first division in which all of `most` fits, or else that in which the most does; `None` if there is no room for it in any. `title_height` is
    /// the height of the title block, which may be short, in a width, and `fitting` is `None` where a table has no room.
    pub fn best(
        contents: Rect,
        most: Fitting,
        title_height: impl Fn(f64, bool) -> f64,
        fitting: impl Fn(&Sheet) -> Option<Fitting>,
        theme: &Theme,
    ) -> Option<(Sheet, Fitting)> {
        let mut best: Option<(Sheet, Fitting)> = None;
        for division in Division::all(contents.size.x > contents.size.y) {
            let Some(sheet) = Sheet::divided(contents, division, &title_height, theme) else { continue };
            let Some(fitting) = fitting(&sheet) else { continue };
            if best.as_ref().is_none_or(|(_, other)| fitting > *other) {
                best = Some((sheet, fitting));
            }
            if fitting == most {
                break;
            }
        }
        best
    }

    /// `None` if something has no room.
    fn divided(
        contents: Rect,
        division: Division,
        title_height: &impl Fn(f64, bool) -> f64,
        theme: &Theme,
    ) -> Option<Sheet> {
        /// The least width and height of the views and of the assembly, in ems of a note.
        const LEAST: f64 = 7.0;
        let Division { parts: [part, assembly_part], is_column, is_title_across, is_title_short } = division;
        let gap = theme.margin;
        let rect = |x: f64, y: f64, w: f64, h: f64| Rect {
            corner: contents.corner + Vector::new(x, y),
            size: Vector::new(w, h),
        };
        let (width, whole) = (contents.size.x, contents.size.y);
        let title_height = |width: f64| title_height(width, is_title_short);
        let height = if is_title_across { whole - title_height(width) - gap } else { whole };
        let (views, assembly, x) = if is_column {
            let x = (1.0 - part) * width;
            let assembly = (0.75 * part * width).min(assembly_part * height);
            (rect(0.0, 0.0, x - gap, height), rect(x, 0.0, width - x, assembly), x)
        } else {
            let assembly = assembly_part * width;
            let y = (1.0 - part) * height;
            (rect(0.0, 0.0, width, y - gap), rect(0.0, y, assembly, height - y), assembly + gap)
        };
        let title = if is_title_across {
            rect(0.0, height + gap, width, whole - height - gap)
        } else {
            let title = title_height(width - x);
            rect(x, height - title, width - x, title)
        };
        let top = if is_column { assembly.size.y + gap } else { views.size.y + gap };
        let bottom = if is_title_across { height } else { height - title.size.y - gap };
        let table = rect(x, top, width - x, bottom - top);
        let has_room = [views, assembly].iter().all(|rect| rect.size.min() >= LEAST * theme.note_size);
        (has_room && table.size.min() > 0.0).then_some(Sheet { views, assembly, table, title, is_title_short })
    }
}
