//! The degrees of freedom of a drawing.

use super::Drawing;

/// How many degrees of freedom a linkage has, by the number of its links and joints (Gruebler, Kutzbach). A part that is rigid by itself, and another that
/// is loose, may make up for each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Mobility {
    /// The links, the frame among them.
    links: usize,
    /// The pins, of which a joint of n links has n - 1.
    pins: usize,
    /// The joints that slide on lines.
    slides: usize,
}

impl Mobility {
    pub fn of(drawing: &Drawing) -> Mobility {
        let pins = drawing.links_at.iter().map(|links| links.len().saturating_sub(1)).sum();
        Mobility { links: drawing.links.len(), pins, slides: drawing.slides.len() }
    }

    /// The degrees of freedom.
    pub fn degrees(self) -> isize {
        3 * (self.links as isize - 1) - 2 * self.pins as isize - self.slides as isize
    }

    /// The count in words: "3 (4 links - 1) - 2 · 4 pins = 1".
    pub fn in_words(self) -> String {
        let slides = match self.slides {
            0 => String::new(),
            1 => " - 1 slide".to_owned(),
            slides => format!(" - {slides} slides"),
        };
        format!("3 · ({} links - 1) - 2 · {} pins{slides} = {}", self.links, self.pins, self.degrees())
    }
}
