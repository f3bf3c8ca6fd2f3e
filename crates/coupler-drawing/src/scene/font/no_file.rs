//! In place of font files, in builds without the feature `fonts`.

/// A font file; builds without the feature `fonts` have none.
#[derive(Debug, PartialEq, Eq, Hash)]
pub enum FontFile {}

impl FontFile {
    /// Whether the font has a character.
    pub fn has(&self, _: char) -> bool {
        match *self {}
    }
}
