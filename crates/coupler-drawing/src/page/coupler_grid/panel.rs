//! The panel of a page: the key and the description of its linkage, the table of its points, graphs and notes.

use super::super::CouplerGridPage;
use super::super::area::Area;
use super::super::key::{Key, PinMarks};
use super::super::key_drawing;
use super::super::mechanism::PosedMechanism;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::description::Description;
use super::graphs::{self, Graphs};
use super::key;
use super::layout::{self, PanelLayout};
use super::notes::Notes;
use super::shown_curve::ShownCurve;
use super::table::Table;
use crate::scene::Group;
use coupler_curves::geometry::Vector;

/// The contents of a panel of a width.
pub(super) struct PanelContents<'a> {
    page: &'a CouplerGridPage<'a>,
    shown: &'a [ShownCurve<'a>],
    pub width: f64,
    /// How the linkage is built, if the lengths of its links do not say it.
    key: Option<Key>,
    description: Description,
    table: Table,
}

impl<'a> PanelContents<'a> {
    pub fn new(page: &'a CouplerGridPage, width: f64, shown: &'a [ShownCurve], theme: &Theme) -> PanelContents<'a> {
        let marked = |key: &Key| {
            let needs_marks = key_drawing::needs_marks(key, 0.5 * width, &key_theme(theme));
            Key { marks: if needs_marks { PinMarks::Letters } else { PinMarks::Names }, ..key.clone() }
        };
        let key = page.key.map(marked);
        let description = Description::new(page, key.as_ref(), PanelLayout::description_width(width, theme), theme);
        PanelContents { page, shown, width, key, description, table: Table::new(page, width, theme) }
    }

    /// The height of the key, the description and the table, at least.
    pub fn least_height(&self, theme: &Theme) -> f64 {
        PanelLayout::least_height(self.description.height(), self.table.least_height(theme), theme)
    }

    /// Draws the panel in a frame of its width.
    pub fn draw(&self, area: &impl Area, panel: Rect, mechanism: &PosedMechanism, theme: &Theme) {
        let &PanelContents { page, shown, ref table, ref description, .. } = self;
        let em = theme.note_size;
        let graphs = table.graph_left().map(|left| (left, Graphs::new(page.panel.solved_cell, shown)));
        let strip_left = graphs.as_ref().filter(|(_, graphs)| graphs.transmission.is_some()).map(|(left, _)| *left);
        let notes_width = strip_left.map_or(panel.size.x, |left| left - (graphs::NUMBERS_WIDTH + 1.0) * em);
        let notes = Notes::new(page, shown, (table, graphs.as_ref().map(|(_, graphs)| graphs)), notes_width, theme);
        let strip_height = strip_left.map_or(0.0, |_| layout::STRIP_HEIGHT * em);
        let heights = [description.height(), notes.height(theme).max(strip_height)];
        let parts = PanelLayout::new(panel, table, heights, theme);

        self.draw_key_with_description(area, parts.key, mechanism, theme);

        let rows = table.draw(area, parts.table, parts.row_height, shown, theme);
        if let Some((left, graphs)) = &graphs {
            let strip = Rect {
                corner: parts.foot.corner + Vector::new(*left, 0.5 * em),
                size: Vector::new(panel.size.x - left, (parts.foot.size.y - em).max(0.0)),
            };
            let group =
                Group::figure("graphs", "Graphs over the input: the speed of each point, and the transmission angle");
            let strip = (parts.foot.size.y >= strip_height).then_some(strip);
            area.grouped(group, || graphs.draw(area, &rows, strip, shown, theme));
        }
        let notes_frame = Rect { size: Vector::new(notes_width, parts.foot.size.y), ..parts.foot };
        notes.draw(area, notes_frame, page, theme);
    }

    /// Draws the key, and next to it the description. Where that has too little space, it is drawn alone, with the names of joints, as it
    /// says all that the key does.
    fn draw_key_with_description(&self, area: &impl Area, frame: Rect, mechanism: &PosedMechanism, theme: &Theme) {
        let PanelContents { page, key, description, .. } = self;
        if description.height() > frame.size.y * (1.0 + 1e-9) {
            let key = key.as_ref().map(|key| Key { marks: PinMarks::Names, ..key.clone() });
            let alone = Description::new(page, key.as_ref(), frame.size.x, theme);
            return alone.draw(area, frame, page, key.as_ref(), theme);
        }
        let key_width = (0.5 * frame.size.x).min(1.8 * frame.size.y);
        self.draw_key(area, Rect { size: Vector::new(key_width, frame.size.y), ..frame }, mechanism, theme);
        let after_key = Vector::new(key_width + theme.note_size, 0.0);
        let beside = Rect { corner: frame.corner + after_key, size: frame.size - after_key };
        description.draw(area, beside, page, key.as_ref(), theme);
    }

    fn draw_key(&self, area: &impl Area, frame: Rect, mechanism: &PosedMechanism, theme: &Theme) {
        let PanelContents { page, shown, .. } = *self;
        match &self.key {
            None => {
                let group = Group::figure("key", "Key: the linkage with the names and lengths of its links");
                area.grouped(group, || key::draw(area, frame, page, mechanism, shown, theme));
            }
            Some(key) => {
                let circuit = shown.first().map_or(0, |s| s.curve.circuit - 1);
                let circuit = &page.panel.solved_cell.motion.circuits[circuit];
                let ink = |_| theme.ink;
                key_drawing::draw_linkage(area, frame, (mechanism, key), circuit, ink, &key_theme(theme));
            }
        }
    }
}

/// The theme of a key whose joints are described next to it.
fn key_theme(theme: &Theme) -> Theme {
    Theme { caption_size: 1.1 * theme.note_size, ..theme.clone() }
}
