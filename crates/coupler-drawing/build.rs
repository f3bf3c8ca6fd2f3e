//! Compresses the embedded fonts: they are half as large, and few runs use more than two of them.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "fonts")]
    fonts::compress()?;
    Ok(())
}

#[cfg(feature = "fonts")]
mod fonts {
    use std::fs;
    use std::io::{self, Write};
    use std::path::Path;

    use flate2::Compression;
    use flate2::write::ZlibEncoder;

    /// Writes the fonts, each compressed, into a folder for `include_bytes`.
    pub fn compress() -> Result<(), Box<dyn std::error::Error>> {
        let faces = [
            ("serif-regular", dejavu::serif::regular()),
            ("serif-italic", dejavu::serif::italic()),
            ("serif_condensed-regular", dejavu::serif_condensed::regular()),
            ("serif_condensed-italic", dejavu::serif_condensed::italic()),
            ("sans-regular", dejavu::sans::regular()),
            ("sans-oblique", dejavu::sans::oblique()),
            ("sans_condensed-regular", dejavu::sans_condensed::regular()),
            ("sans_condensed-oblique", dejavu::sans_condensed::oblique()),
            ("sans_mono-regular", dejavu::sans_mono::regular()),
            ("sans_mono-oblique", dejavu::sans_mono::oblique()),
        ];
        let folder = std::env::var("OUT_DIR")?;
        for (name, bytes) in faces {
            fs::write(Path::new(&folder).join(format!("{name}.zlib")), compressed(bytes)?)?;
        }
        Ok(())
    }

    fn compressed(bytes: &[u8]) -> io::Result<Vec<u8>> {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes)?;
        encoder.finish()
    }
}
