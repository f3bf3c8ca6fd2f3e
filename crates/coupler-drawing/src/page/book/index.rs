use std::cmp::Ordering;

use super::columns::{Entry, Row};
use super::index_entry::IndexValue;
use super::{Atlas, IndexEntry, Volume};

/// The most entries under a measure.
const MAX_ENTRIES: usize = 2000;

type RankedEntries<'g> = Vec<(&'g IndexEntry, IndexValue)>;

/// What the index of a volume says: of every measure what it is, and the geometries, the best first.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &Volume, found: &'a [IndexEntry]) -> Vec<Row<'a>> {
    let here = |(_, found): &(&IndexEntry, IndexValue)| volume.page_range().contains(&found.page);
    let ranked = |pick: fn(&IndexEntry) -> Option<IndexValue>, order: fn(f64, f64) -> Ordering| {
        let picked = found.iter().filter_map(|geometry| Some((geometry, pick(geometry)?)));
        let mut entries: RankedEntries = picked.filter(here).collect();
        entries.sort_by(|(_, a), (_, b)| order(a.value, b.value).then(a.page.cmp(&b.page)));
        entries
    };
    let greatest = |a: f64, b: f64| b.total_cmp(&a);
    let least = |a: f64, b: f64| a.total_cmp(&b);
    let sections = [
        Section {
            title: "By straightness",
            note: "the straight portion of the straightest curve, as a part of the length of the whole curve; the straightest \
                   first",
            unit: " %",
            scale: 100.0,
            decimals: 1,
            entries: ranked(|geometry| geometry.straightness, greatest),
        },
        Section {
            title: "By transmission angle",
            note: "the least angle between coupler and output link that the motion comes to; the greatest first",
            unit: "°",
            scale: 1.0,
            decimals: 1,
            entries: ranked(|geometry| geometry.transmission_angle, greatest),
        },
        Section {
            title: "By symmetry",
            note: "how far the most symmetrical curve is from its mirror image, as a part of its greatest extent; the nearest \
                   first",
            unit: " %",
            scale: 100.0,
            decimals: 2,
            entries: ranked(|geometry| geometry.asymmetry, least),
        },
    ];
    sections.iter().flat_map(|section| section.rows(atlas)).collect()
}

struct Section<'a> {
    title: &'static str,
    note: &'static str,
    /// What follows a value, and how often it is written.
    unit: &'static str,
    scale: f64,
    decimals: u32,
    entries: RankedEntries<'a>,
}

impl<'a> Section<'a> {
    /// Nothing, where there is no entry.
    fn rows(&self, atlas: &'a Atlas) -> Vec<Row<'a>> {
        let Section { title, note, unit, scale, decimals, ref entries } = *self;
        if entries.is_empty() {
            return Vec::new();
        }
        let mut rows = vec![Row::Heading { text: title.to_owned(), page: None }, Row::Note(note.to_owned())];
        if entries.len() > MAX_ENTRIES {
            rows.push(Row::Note(format!("the first {MAX_ENTRIES} of {}", entries.len())));
        }
        rows.extend(entries.iter().take(MAX_ENTRIES).map(|(geometry, found)| {
            let chapter = atlas.chapters.get(geometry.chapter);
            let (fine, decimals) = (f64::from(10_u32.pow(decimals)), decimals as usize);
            Row::Entry(Entry {
                family: chapter.filter(|_| atlas.chapters.len() > 1).map(|chapter| chapter.title),
                caption: &geometry.caption,
                symbols: chapter.map_or(&[], |chapter| chapter.symbols),
                // Without the sign of a zero that is rounded from below.
                value: format!("{:.decimals$}{unit}", (fine * scale * found.value).round() / fine + 0.0),
                curve: found.curve,
                page: found.page,
            })
        }));
        rows
    }
}
