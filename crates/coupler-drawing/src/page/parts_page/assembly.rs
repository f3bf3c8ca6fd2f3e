//! The view of the assembly: the linkage in its pose with the names of its joints, or with their numbers where the names are too long for it.

use super::super::Key;
use super::super::area::Area;
use super::super::figure::Figure;
use super::super::key::PinMarks;
use super::super::key_drawing::{self, needs_marks};
use super::super::rect::Rect;
use super::super::theme::Theme;
use crate::scene::Anchor;
use coupler_curves::geometry::Vector;

/// What is said under the assembly, which is as large as it fits, since the scale of the title block is that of the parts.
const NOT_TO_SCALE: &str = "assembly, not to scale";

/// The assembly of a page.
pub(super) struct Assembly<'a> {
    pub figure: &'a Figure<'a>,
    pub key: Option<&'a Key>,
}

impl Assembly<'_> {
    /// The names of the joints after their numbers, if a drawing of a width has only these.
    pub fn numbered_names(&self, width: f64, theme: &Theme) -> Option<String> {
        let key = self.key.filter(|key| needs_marks(key, width, theme))?;
        let names = key.joints.iter().enumerate().map(|(k, (name, _))| format!("{} {name}", k + 1));
        Some(names.collect::<Vec<_>>().join(" · "))
    }

    pub fn draw(&self, root: &impl Area, rect: Rect, theme: &Theme) {
        if let (Some(mechanism), Some(key)) = (self.figure.mechanisms.first(), self.key) {
            let (em, size) = (theme.note_size, rect.size);
            let foot = rect.corner + Vector::new(0.5 * size.x, size.y - 0.4 * em);
            root.record(
                theme.text_line(NOT_TO_SCALE, foot, Anchor::Middle, em, theme.text_ink(theme.grey)).fit_width(size.x),
            );
            let rect = Rect { size: size - Vector::new(0.0, 1.4 * em), ..rect };
            let marks = if needs_marks(key, rect.size.x, theme) { PinMarks::Numbers } else { PinMarks::Names };
            let key = Key { marks, ..key.clone() };
            let ink = |joint| self.figure.joint_ink(joint, theme);
            key_drawing::draw_linkage(root, rect, (mechanism, &key), self.figure.first_circuit(), ink, theme);
        }
    }
}
