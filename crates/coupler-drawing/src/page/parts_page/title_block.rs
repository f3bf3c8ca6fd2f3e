//! The title block: what the page is of, its parameters, at which scale, in which unit, on which paper.

use super::super::area::Area;
use super::super::element::TextLine;
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
    /// The parameters of the cell, as far as they vary; may be empty.
    pub parameters: &'a str,
    /// The paper with a gutter.
    pub paper: Paper,
    /// Whether it is without what the page says at its head and at its foot.
    pub is_short: bool,
}

/// A label with its text.
struct Field {
    label: &'static str,
    text: String,
}

/// A field in its row.
struct Cell {
    label: &'static str,
    lines: Vec<String>,
    width: f64,
}

/// The height of a row with one line, in ems.
const ROW: f64 = 1.7;

/// The distance from a line of a row to the next, in ems.
const LEADING: f64 = 1.25;

impl TitleBlock<'_> {
    /// Its height in a width.
    pub fn height(&self, width: f64, theme: &Theme) -> f64 {
        self.rows(width, theme).iter().map(|row| row_height(row, theme)).sum()
    }

    /// Draws it with the scale of the views, in millimetres to a unit, if there are any.
    pub fn draw(&self, root: &impl Area, (rect, scale): (Rect, Option<f64>), theme: &Theme) {
        let size = theme.note_size;
        let far = rect.corner + rect.size;
        root.record_rectangle([rect.corner, far], theme.stroke(theme.ink, theme.fine_width));
        let scale = [scale.map_or("none".to_owned(), |scale| format_scale(scale, self.page.heading.unit))];
        let rule = |from: Point, by: Vector| {
            let stroke = theme.stroke(theme.grey, theme.hair_width);
            root.record(Item::Path(Path::stroked(vec![from, from + by], stroke)));
        };
        let mut corner = rect.corner;
        for (k, row) in self.rows(rect.size.x, theme).iter().enumerate() {
            let height = row_height(row, theme);
            if k > 0 {
                rule(corner, Vector::new(rect.size.x, 0.0));
            }
            let mut left = corner;
            for (column, cell) in row.iter().enumerate() {
                if column > 0 {
                    rule(left, Vector::new(0.0, height));
                }
                let mut at = left + Vector::new(0.5 * size, (ROW / 2.0 + 0.35) * size);
                let label = label_line(cell.label, theme).moved_to(at);
                at.x += indent(cell.label, theme);
                root.record(label);
                let lines = if cell.label == SCALE { &scale[..] } else { &cell.lines };
                for words in lines {
                    let line = theme.text_line(words, at, Anchor::Start, size, theme.ink);
                    let line = if cell.label == PARAMETERS { self.with_symbols(line) } else { line };
                    root.record(line.fit_width(cell.width - indent(cell.label, theme) - size));
                    at.y += LEADING * size;
                }
                left.x += cell.width;
            }
            corner.y += height;
        }
    }

    /// Its rows in a width: what is in one row as far as it fits, and a text that is wider in several lines.
    fn rows(&self, width: f64, theme: &Theme) -> Vec<Vec<Cell>> {
        let size = theme.note_size;
        let line = |text: &str| {
            let line = theme.text_line(text, Point::origin(), Anchor::Start, size, theme.ink);
            self.with_symbols(line)
        };
        let natural = |field: &Field| indent(field.label, theme) + line(&field.text).text.width() + size;
        let mut rows: Vec<Vec<Field>> = Vec::new();
        for fields in self.fields() {
            let mut row: Vec<Field> = Vec::new();
            for field in fields.into_iter().filter(|field| !field.text.is_empty()) {
                let before: f64 = row.iter().map(natural).sum();
                if !row.is_empty() && before + natural(&field) > width {
                    rows.push(std::mem::take(&mut row));
                }
                row.push(field);
            }
            rows.push(row);
        }
        let set = |row: Vec<Field>| {
            let spare = (width - row.iter().map(natural).sum::<f64>()) / row.len() as f64;
            let cell = |field: Field| {
                let width = natural(&field) + spare;
                let lines = line(&field.text).wrap((width - indent(field.label, theme) - size).max(size));
                Cell { label: field.label, lines, width }
            };
            row.into_iter().map(cell).collect()
        };
        rows.into_iter().filter(|row| !row.is_empty()).map(set).collect()
    }

    /// The fields, those together that may be in one row.
    fn fields(&self) -> [Vec<Field>; 5] {
        let heading = &self.page.heading;
        let field = |label, text: &str| Field { label, text: text.to_owned() };
        // The scale is known when the views are arranged; no statement of it is wider than these.
        let scales = [1234.0, 0.001_234].map(|scale| format_scale(scale, heading.unit));
        let [scale, other] = &scales;
        let load = self.page.key.and_then(|key| key.load.as_deref()).unwrap_or_default();
        let elsewhere = |label, text| if self.is_short { Vec::new() } else { vec![field(label, text)] };
        [
            elsewhere("title", heading.family_title),
            elsewhere("atlas", heading.atlas_title),
            vec![field(PARAMETERS, self.parameters)],
            vec![field("load", load)],
            vec![
                field("family", heading.family_id),
                field("number", &self.number.to_string()),
                field(SCALE, if other.len() > scale.len() { other } else { scale }),
                field("unit", heading.unit.map_or("its own", LengthUnit::symbol)),
                field("paper", &paper_name(self.paper)),
            ],
        ]
    }

    fn with_symbols(&self, line: TextLine) -> TextLine {
        line.with_italics(self.page.heading.symbols)
    }
}

const SCALE: &str = "scale";
const PARAMETERS: &str = "parameters";

fn label_line(label: &str, theme: &Theme) -> TextLine {
    theme.text_line(label, Point::origin(), Anchor::Start, theme.small_size(), theme.grey)
}

/// How far a text is from the label that it is after.
fn indent(label: &str, theme: &Theme) -> f64 {
    label_line(label, theme).text.width() + 0.5 * theme.note_size
}

fn row_height(row: &[Cell], theme: &Theme) -> f64 {
    let lines = row.iter().map(|cell| cell.lines.len()).max().unwrap_or_default();
    (ROW + LEADING * lines.saturating_sub(1) as f64) * theme.note_size
}

/// The name of a paper, or its size in millimetres.
fn paper_name(paper: Paper) -> String {
    let is_paper = |known: Paper| known == paper || (known.width, known.height) == (paper.height, paper.width);
    let name = Paper::NAMED.iter().find(|(_, known)| is_paper(*known)).map(|(name, _)| (*name).to_owned());
    name.unwrap_or_else(|| format!("{} × {} mm", paper.width, paper.height))
}
