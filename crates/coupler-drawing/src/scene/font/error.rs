//! Why a file cannot be used as a font.

/// Why a file cannot be used as a font.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FontFileError {
    /// It is not a font.
    #[error("it is not a font in OpenType or TrueType format")]
    NotAFont,
    /// Its glyphs are images, or it has none.
    #[error("its glyphs have no outlines")]
    NoOutlines,
}
