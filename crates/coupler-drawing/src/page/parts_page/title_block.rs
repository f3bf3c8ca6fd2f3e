//! The title block: what the page is of, at which scale, in which unit, on which paper.

use super::super::area::Area;
use super::super::rect::Rect;
use super::super::scales::format_scale;
use super::super::theme::Theme;
use super::super::{PanelPage, Paper};
use crate::scene::{Anchor, Item, Path};
use coupler_curves::family::LengthUnit;
use coupler_curves::geometry::{Point, Vector};

/// What is in the title block.
pub(super) struct TitleBlock<'a> {
    pub page: &'a PanelPage<'a>,
    /// The number of the cell.
    pub number: usize,
    /// The scale of the views, in millimetres to a unit.
    pub scale: f64,
    pub paper: Paper,
}

/// The height of a row, in ems.
const ROW: f64 = 1.7;

impl TitleBlock<'_> {
    /// Its height.
    pub fn height(theme: &Theme) -> f64 {
        4.0 * ROW * theme.note_size
    }

    pub fn draw(&self, root: &impl Area, rect: Rect, theme: &Theme) {
        let size = theme.note_size;
        let far = rect.corner + rect.size;
        root.record_rectangle([rect.corner, far], theme.stroke(theme.ink, theme.fine_width));
        let heading = &self.page.heading;
        let unit = heading.unit.map_or("its own", LengthUnit::symbol);
        let rows = [
            vec![("title", heading.family_title.to_owned())],
            vec![("atlas", heading.atlas_title.to_owned())],
            vec![("family", heading.family_id.to_owned()), ("number", self.number.to_string())],
            vec![
                ("scale", format_scale(self.scale, heading.unit)),
                ("unit", unit.to_owned()),
                ("paper", paper_name(self.paper)),
            ],
        ];
        for (k, row) in rows.iter().enumerate() {
            let y = rect.corner.y + ROW * size * (k as f64 + 0.5) + 0.35 * size;
            let width = rect.size.x / row.len() as f64;
            for (column, (label, text)) in row.iter().enumerate() {
                let x = rect.corner.x + width * column as f64 + 0.5 * size;
                let label = theme.text_line(label, Point::new(x, y), Anchor::Start, theme.small_size(), theme.grey);
                let indent = label.text.width() + 0.5 * size;
                root.record(label);
                let value = theme.text_line(text, Point::new(x + indent, y), Anchor::Start, size, theme.ink);
                root.record(value.fit_width(width - indent - size));
                if column > 0 {
                    let top = Point::new(rect.corner.x + width * column as f64, rect.corner.y + ROW * size * k as f64);
                    let rule = vec![top, top + Vector::new(0.0, ROW * size)];
                    root.record(Item::Path(Path::stroked(rule, theme.stroke(theme.grey, theme.hair_width))));
                }
            }
            if k > 0 {
                let left = Point::new(rect.corner.x, rect.corner.y + ROW * size * k as f64);
                let rule = vec![left, left + Vector::new(rect.size.x, 0.0)];
                root.record(Item::Path(Path::stroked(rule, theme.stroke(theme.grey, theme.hair_width))));
            }
        }
    }
}

/// The name of a paper, or its size in millimetres.
fn paper_name(paper: Paper) -> String {
    let is_paper = |known: Paper| known == paper || (known.width, known.height) == (paper.height, paper.width);
    let name = Paper::NAMED.iter().find(|(_, known)| is_paper(*known)).map(|(name, _)| (*name).to_owned());
    name.unwrap_or_else(|| format!("{} × {} mm", paper.width, paper.height))
}
