//! The index of random four-bars, kept in the user's cache folder.

use std::path::{Path, PathBuf};
use std::{fs, io};

use coupler_find::{Index, IndexPart};
use etcetera::BaseStrategy;
use rayon::prelude::*;
use std::io::Write;

/// The most curves of an index: half a gigabyte, and a second for a search.
pub const MAX_CURVES: usize = 8_000_000;

/// What a file of an index begins with.
const MAGIC: &[u8; 16] = b"coupler-atlas-ix";

/// The index of the first curves of the sequence: from the user's cache folder if it is there, and otherwise computed on all threads and
/// stored there if that is possible. A file that is damaged or of another version counts as missing.
pub fn load_index(count: usize) -> Index {
    let path = cache_path(count);
    if let Some(index) = path.as_deref().and_then(|path| read(path, count)) {
        return index;
    }
    let index = build(count);
    if let Some(path) = path {
        // Without a cache the next search takes a little longer.
        let _ = write(&path, &index);
    }
    index
}

/// Where an index is kept; `None` if the user has no folder for caches.
fn cache_path(count: usize) -> Option<PathBuf> {
    let folder = etcetera::choose_base_strategy().ok()?.cache_dir().join(env!("CARGO_PKG_NAME"));
    folder.is_absolute().then(|| folder.join(format!("four-bars-{}-{count}.index", Index::VERSION)))
}

fn build(count: usize) -> Index {
    /// Curves of a part, which takes some milliseconds.
    const PART: usize = 1000;
    let starts: Vec<usize> = (0..count).step_by(PART).collect();
    let parts: Vec<IndexPart> = starts.par_iter().map(|&from| Index::part(from..(from + PART).min(count))).collect();
    Index::from_parts(parts)
}

/// The file of an index: what it begins with, a checksum, the curves.
fn write(path: &Path, index: &Index) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder)?;
    let bytes = index.to_bytes();
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(MAGIC)?;
    file.write_all(&crc32fast::hash(&bytes).to_le_bytes())?;
    file.write_all(&bytes)?;
    file.persist(path)?;
    Ok(())
}

fn read(path: &Path, count: usize) -> Option<Index> {
    let length = MAGIC.len() + size_of::<u32>() + count * Index::BYTES_PER_CURVE;
    // A file of another size need not be read.
    fs::metadata(path).ok().filter(|metadata| metadata.len() == length as u64)?;
    let file = fs::read(path).ok()?;
    let (checksum, bytes) = file.strip_prefix(MAGIC)?.split_first_chunk()?;
    let is_whole = u32::from_le_bytes(*checksum) == crc32fast::hash(bytes);
    (is_whole && has_right_curves(bytes, count)).then(|| Index::from_bytes(bytes)).flatten()
}

/// Whether some curves of an index, evenly spread, are those that are computed now: a file may be whole and have other
/// contents, such as those of another program.
fn has_right_curves(bytes: &[u8], count: usize) -> bool {
    /// The number of curves, which take about a millisecond.
    const MOST: usize = 200;
    let numbers: Vec<usize> = (0..MOST.min(count)).map(|k| k * count / MOST.min(count)).collect();
    numbers.into_par_iter().all(|number| {
        let [begin, end] = [number, number + 1].map(|number| number * Index::BYTES_PER_CURVE);
        bytes.get(begin..end) == Some(&Index::from_parts([Index::part(number..number + 1)]).to_bytes()[..])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_is_read_back_and_a_damaged_one_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cache").join("some.index");
        let index = build(2345);
        assert!(index.to_bytes() == Index::with_count(2345).to_bytes());
        write(&path, &index).unwrap();
        assert!(read(&path, 2345).is_some_and(|other| other.to_bytes() == index.to_bytes()));
        assert!(read(&path, 2344).is_none());
        let whole = fs::read(&path).unwrap();
        for damaged in [&whole[..whole.len() - 1], &[&whole[..], b"x"].concat(), b"", &[0; 100]] {
            fs::write(&path, damaged).unwrap();
            assert!(read(&path, 2345).is_none());
        }
        let mut changed = whole.clone();
        changed[1000] ^= 1;
        fs::write(&path, changed).unwrap();
        assert!(read(&path, 2345).is_none());
        // Whole files with other curves: of another sequence, in another order, or none.
        let bytes = index.to_bytes();
        let shifted: Vec<u8> = bytes.iter().map(|byte| byte.wrapping_add(1)).collect();
        let reversed: Vec<u8> = bytes.chunks(Index::BYTES_PER_CURVE).rev().flatten().copied().collect();
        for other in [shifted, reversed, vec![0; bytes.len()]] {
            fs::write(&path, [MAGIC, &crc32fast::hash(&other).to_le_bytes()[..], &other[..]].concat()).unwrap();
            assert!(read(&path, 2345).is_none());
        }
    }
}
