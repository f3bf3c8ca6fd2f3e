//! The indexes of random linkages, kept in the user's cache folder.

use std::path::{Path, PathBuf};
use std::{fs, io};

use coupler_find::{Index, IndexPart, LinkageIndex, LinkageSampler, Workers, six_bar_spaces};
use etcetera::BaseStrategy;
use rayon::prelude::*;
use std::io::Write;

use crate::threads::{Interrupted, Threads};

/// The most curves of an index: half a gigabyte, and a second for a search.
pub const MAX_CURVES: usize = 8_000_000;

/// What a file of an index begins with.
const MAGIC: &[u8; 16] = b"coupler-atlas-ix";

/// The index of the first curves of the sequence: from the user's cache folder if it is there, and otherwise computed on all threads and
/// stored there if that is possible. A file that is damaged or of another version counts as missing.
pub fn load_index(count: usize) -> Index {
    let path = cache_path(&format!("four-bars-{}-{count}", Index::VERSION));
    if let Some(index) = path.as_deref().and_then(|path| read(path, count)) {
        return index;
    }
    let index = build(count);
    if let Some(path) = path {
        // Without a cache the next search takes a little longer.
        let _ = write(&path, &index.to_bytes());
    }
    index
}

/// The index of about so many curves of six-bars, whose input turns fully or not: from the user's cache folder as that of four-bars.
/// `report_part` receives which part of it is computed, from 0 to 1.
///
/// # Errors
/// The threads are interrupted.
pub fn load_six_bars(
    full_turn: bool,
    count: usize,
    threads: &Threads,
    mut report_part: impl FnMut(f64),
) -> Result<LinkageIndex, Interrupted> {
    /// The parts that are computed at once: the same on any number of threads.
    const AT_ONCE: usize = 8;
    let sampler = LinkageSampler::new(&six_bar_spaces(), full_turn);
    let input = if full_turn { "full-turn" } else { "any-input" };
    let path = cache_path(&format!("six-bars-{input}-{}-{count}", LinkageIndex::VERSION));
    if let Some(index) = path.as_deref().and_then(|path| read_six_bars(path, &sampler)) {
        return Ok(index);
    }
    let mut index = LinkageIndex::new(sampler.linkage_count());
    for (linkage, quota) in sampler.quotas(count).into_iter().enumerate() {
        let mut left = quota;
        let mut ranges = LinkageSampler::ranges(quota);
        while left > 0 {
            let next: Vec<_> = ranges.by_ref().take(AT_ONCE).collect();
            if next.is_empty() {
                break;
            }
            for part in threads.map(next, |range| sampler.part(linkage, range)) {
                left -= index.extend(part, left);
            }
            threads.proceed()?;
            let of_linkage = (quota - left) as f64 / quota as f64;
            report_part((linkage as f64 + of_linkage) / sampler.linkage_count() as f64);
        }
    }
    if let Some(path) = path {
        let _ = write(&path, &index.to_bytes());
    }
    Ok(index)
}

/// Where an index of a name is kept; `None` if the user has no folder for caches.
fn cache_path(name: &str) -> Option<PathBuf> {
    let folder = etcetera::choose_base_strategy().ok()?.cache_dir().join(env!("CARGO_PKG_NAME"));
    folder.is_absolute().then(|| folder.join(format!("{name}.index")))
}

fn build(count: usize) -> Index {
    /// Curves of a part, which takes some milliseconds.
    const PART: usize = 1000;
    let starts: Vec<usize> = (0..count).step_by(PART).collect();
    let parts: Vec<IndexPart> = starts.par_iter().map(|&from| Index::part(from..(from + PART).min(count))).collect();
    Index::from_parts(parts)
}

/// The file of an index: what it begins with, a checksum, the curves.
fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder)?;
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(MAGIC)?;
    file.write_all(&crc32fast::hash(bytes).to_le_bytes())?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

fn read(path: &Path, count: usize) -> Option<Index> {
    let length = MAGIC.len() + size_of::<u32>() + count * Index::BYTES_PER_CURVE;
    // A file of another size need not be read.
    fs::metadata(path).ok().filter(|metadata| metadata.len() == length as u64)?;
    let bytes = read_whole(path)?;
    has_right_curves(&bytes, count).then(|| Index::from_bytes(&bytes)).flatten()
}

/// The bytes of an index that is whole.
fn read_whole(path: &Path) -> Option<Vec<u8>> {
    let file = fs::read(path).ok()?;
    let (checksum, bytes) = file.strip_prefix(MAGIC)?.split_first_chunk()?;
    (u32::from_le_bytes(*checksum) == crc32fast::hash(bytes)).then(|| bytes.to_vec())
}

/// An index of six-bars some of whose curves, evenly spread, are those that are computed now.
fn read_six_bars(path: &Path, sampler: &LinkageSampler) -> Option<LinkageIndex> {
    /// The number of curves, which take about ten milliseconds.
    const MOST: usize = 60;
    /// A greater file is none of an index.
    const MOST_BYTES: u64 = (MAX_CURVES * LinkageIndex::BYTES_PER_CURVE) as u64 + 64;
    fs::metadata(path).ok().filter(|metadata| metadata.len() <= MOST_BYTES)?;
    let index = LinkageIndex::from_bytes(sampler.linkage_count(), &read_whole(path)?)?;
    let numbers: Vec<usize> = (0..MOST).map(|k| k * index.len() / MOST).collect();
    let is_right = !index.is_empty() && numbers.into_par_iter().all(|number| sampler.has(&index, number));
    is_right.then_some(index)
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
        write(&path, &index.to_bytes()).unwrap();
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
