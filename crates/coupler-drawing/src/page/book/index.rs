use std::cmp::Ordering;

use super::columns::{Entry, Row};
use super::geometry::Found;
use super::{Atlas, Geometry, Volume};

/// The most entries under a measure.
const MOST: usize = 2000;

type Entries<'g> = Vec<(&'g Geometry, Found)>;

/// What the index of a volume says: of every measure what it is, and the geometries, the best first.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &Volume, found: &'a [Geometry]) -> Vec<Row<'a>> {
    let here = |(_, found): &(&Geometry, Found)| volume.range().contains(&found.page);
    let ranked = |pick: fn(&Geometry) -> Option<Found>, order: fn(f64, f64) -> Ordering| {
        let picked = found.iter().filter_map(|geometry| Some((geometry, pick(geometry)?)));
        let mut entries: Entries = picked.filter(here).collect();
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
            entries: ranked(|geometry| geometry.straight, greatest),
        },
        Section {
            title: "By transmission angle",
            note: "the least angle between coupler and output link that the motion comes to; the greatest first",
            unit: "°",
            scale: 1.0,
            decimals: 1,
            entries: ranked(|geometry| geometry.transmission, greatest),
        },
        Section {
            title: "By symmetry",
            note: "how far the most symmetrical curve is from its mirror image, as a part of its greatest extent; the nearest \
                   first",
            unit: " %",
            scale: 100.0,
            decimals: 2,
            entries: ranked(|geometry| geometry.symmetry, least),
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
    entries: Entries<'a>,
}

impl<'a> Section<'a> {
    /// Nothing, where there is no entry.
    fn rows(&self, atlas: &'a Atlas) -> Vec<Row<'a>> {
        let Section { title, note, unit, scale, decimals, ref entries } = *self;
        if entries.is_empty() {
            return Vec::new();
        }
        let mut rows = vec![Row::Heading { text: title.to_owned(), page: None }, Row::Note(note.to_owned())];
        if entries.len() > MOST {
            rows.push(Row::Note(format!("the first {MOST} of {}", entries.len())));
        }
        rows.extend(entries.iter().take(MOST).map(|(geometry, found)| {
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
