//! The index: geometries by straightness, transmission angle and symmetry.

use std::cmp::Ordering;
use std::collections::HashSet;

use super::columns::{Entry, Row, Target};
use super::index_entry::IndexValue;
use super::reference::figure_words;
use super::{Atlas, IndexEntry};

/// The most entries of a section.
const MAX_ENTRIES: usize = 2000;

type RankedEntries<'g> = Vec<(&'g IndexEntry, &'g IndexValue)>;

/// The rows of the index: for every measure its definition and the geometries, the best first.
pub(super) fn rows<'a>(atlas: &'a Atlas) -> Vec<Row<'a>> {
    let index_entries = &atlas.index;
    let greatest_first = |a: f64, b: f64| b.total_cmp(&a);
    let least_first = |a: f64, b: f64| a.total_cmp(&b);
    let ranked = |pick: fn(&IndexEntry) -> Option<&IndexValue>, order: fn(f64, f64) -> Ordering| {
        let picked = index_entries.iter().filter_map(|geometry| Some((geometry, pick(geometry)?)));
        let mut entries: RankedEntries = picked.collect();
        entries.sort_by(|(_, a), (_, b)| order(a.value, b.value).then(a.page.cmp(&b.page)));
        entries
    };
    // Each linkage once, whatever its points.
    let mut seen = HashSet::new();
    let mut by_transmission_angle = ranked(|geometry| geometry.transmission_angle.as_ref(), greatest_first);
    by_transmission_angle.retain(|(geometry, _)| seen.insert((geometry.chapter, geometry.linkage)));
    let sections = [
        Section {
            title: "By straightness",
            note: "the straight portion of the straightest curve, in percent of the length of the curve; the \
                   straightest first",
            unit: " %",
            scale: 100.0,
            decimals: 1,
            entries: ranked(|geometry| geometry.straightness.as_ref(), greatest_first),
        },
        Section {
            title: "By transmission angle",
            note: "the least angle between coupler and output link over the motion; the greatest first",
            unit: "°",
            scale: 1.0,
            decimals: 1,
            entries: by_transmission_angle,
        },
        Section {
            title: "By symmetry",
            note: "the deviation of the most symmetrical curve from its mirror image, in percent of its greatest \
                   extent; the least first; without curves that are nearly circles",
            unit: " %",
            scale: 100.0,
            decimals: 2,
            entries: ranked(|geometry| geometry.asymmetry.as_ref(), least_first),
        },
    ];
    sections.iter().flat_map(|section| section.rows(atlas)).collect()
}

/// Keeps those of many index entries, each with anything else, that a section of the index can list.
pub fn keep_listed<T>(entries: &mut Vec<(T, IndexEntry)>) {
    let mut is_kept = vec![false; entries.len()];
    let mut keep_first = |pick: fn(&IndexEntry) -> Option<f64>| {
        let picked = entries.iter().enumerate().filter_map(|(k, (_, entry))| Some((pick(entry)?, k)));
        let mut ranked: Vec<(f64, usize)> = picked.collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ranked.iter().take(MAX_ENTRIES).for_each(|(_, k)| is_kept[*k] = true);
    };
    keep_first(|entry| entry.straightness.as_ref().map(|best| -best.value));
    keep_first(|entry| entry.transmission_angle.as_ref().map(|best| -best.value));
    keep_first(|entry| entry.asymmetry.as_ref().map(|best| best.value));
    let mut kept = is_kept.into_iter();
    entries.retain(|_| kept.next().unwrap_or(false));
}

/// A section of the index: the geometries in the order of one measure.
struct Section<'a> {
    title: &'static str,
    note: &'static str,
    /// The unit, written after a value.
    unit: &'static str,
    /// The factor from the measure to the unit.
    scale: f64,
    decimals: u32,
    entries: RankedEntries<'a>,
}

impl<'a> Section<'a> {
    /// The rows of the section; none if it has no entry.
    fn rows(&self, atlas: &'a Atlas) -> Vec<Row<'a>> {
        let Section { title, note, unit, scale, decimals, ref entries } = *self;
        if entries.is_empty() {
            return Vec::new();
        }
        let mut rows = vec![Row::Heading { text: title.to_owned(), page: None }, Row::Note(note.to_owned())];
        if entries.len() > MAX_ENTRIES {
            rows.push(Row::Note(format!("the first {MAX_ENTRIES}")));
        }
        rows.extend(entries.iter().take(MAX_ENTRIES).map(|(geometry, best)| {
            let chapter = atlas.chapters.get(geometry.chapter);
            let (fine, decimals) = (f64::from(10_u32.pow(decimals)), decimals as usize);
            Row::Entry(Entry {
                family: chapter.filter(|_| atlas.chapters.len() > 1).map(|chapter| chapter.title),
                caption: &geometry.caption,
                symbols: chapter.map_or(&[], |chapter| chapter.symbols),
                // Adding 0 removes the sign of a negative zero.
                values: vec![format!("{:.decimals$}{unit}", (fine * scale * best.value).round() / fine + 0.0)],
                curve: best.curve.iter().cloned().chain(figure_words(geometry.figure)).collect::<Vec<_>>().join(", "),
                page: Target::Page(best.page),
                last_page: None,
            })
        }));
        rows
    }
}
