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
}

/// What fits a page that is divided in some way.
#[derive(Clone, Copy)]
pub(super) struct Fitting {
    pub views: bool,
    pub table: bool,
}

/// The parts of the page that the views leave to everything else, and of its height or width the part that the assembly takes at most.
const DIVISIONS: [[f64; 2]; 4] = [[0.3, 0.4], [0.36, 0.36], [0.43, 0.3], [0.5, 0.25]];

impl Sheet {
    /// The first division in which everything fits, or else the last in which the views do. `title_height` is the height of the title block in a width.
    pub fn best(
        contents: Rect,
        title_height: impl Fn(f64) -> f64,
        fitting: impl Fn(&Sheet) -> Fitting,
        theme: &Theme,
    ) -> Sheet {
        let sheet = |division| Sheet::divided(contents, division, &title_height, theme);
        let mut for_views = None;
        for division in DIVISIONS {
            let sheet = sheet(division);
            match fitting(&sheet) {
                Fitting { views: true, table: true } => return sheet,
                Fitting { views: true, table: false } => for_views = Some(sheet),
                Fitting { views: false, .. } => {}
            }
        }
        for_views.unwrap_or_else(|| sheet(DIVISIONS[0]))
    }

    /// In a column on the right of a wide page, or under the views of a high one, where the table and the title block are beside the assembly.
    fn divided(
        contents: Rect,
        [part, assembly_part]: [f64; 2],
        title_height: &impl Fn(f64) -> f64,
        theme: &Theme,
    ) -> Sheet {
        let gap = theme.margin;
        let rect = |x: f64, y: f64, w: f64, h: f64| Rect {
            corner: contents.corner + Vector::new(x, y),
            size: Vector::new(w, h.max(0.0)),
        };
        let (width, height) = (contents.size.x, contents.size.y);
        if width > height {
            let column = part * width;
            let (x, assembly, title) =
                (width - column, (0.75 * column).min(assembly_part * height), title_height(column));
            return Sheet {
                views: rect(0.0, 0.0, x - gap, height),
                assembly: rect(x, 0.0, column, assembly),
                table: rect(x, assembly + gap, column, height - assembly - title - 2.0 * gap),
                title: rect(x, height - title, column, title),
            };
        }
        let assembly = assembly_part * width;
        let (x, column) = (assembly + gap, width - assembly - gap);
        let title = title_height(column);
        let row = (part * height).max(title + gap);
        let y = height - row;
        Sheet {
            views: rect(0.0, 0.0, width, y - gap),
            assembly: rect(0.0, y, assembly, row),
            table: rect(x, y, column, row - title - gap),
            title: rect(x, height - title, column, title),
        }
    }
}
