//! An atlas as a book: its links, its order, and that no text in a manifest makes it fail.

use std::ops::Range;

use coupler_atlas::manifest::{self, Plan};
use coupler_atlas::sweep;
use coupler_curves::measure::Measure;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::book::{self, Atlas, CellEntry, Chapter, IndexEntry, PageFinisher, Volume};
use coupler_drawing::page::{self, Heading, Options, Panel, PanelPage, PanelScale, Paper};
use coupler_drawing::render::pdf::Book;
use coupler_drawing::scene::{PageLink, Scene, Shape, Text};

use super::reader::{Contents, Pdf};

use crate::support::plan::faultless_plan;

pub(super) const MANIFEST: &str = r#"
[atlas]
title = "Curves"
[[family]]
id = "rockers"
linkage = "four-bar"
title = "Crank-rockers"
panels = [2, 1]
sampling = { samples = 60 }
grid = { crank = 1, coupler = 3, rocker = [3, 3.25], frame = [3, 3.5] }
let = { along = 1.5, across = 1 }
[[family]]
id = "evans"
linkage = "evans"
title = "Evans’s"
panels = [1, 1]
sampling = { samples = 60 }
cases = [ { p = 2.00, s = 2.50, a = 2.50 }, { p = 3.00, s = 4.00, a = 4.00 } ]
"#;

pub(super) fn plan() -> Plan {
    faultless_plan(MANIFEST)
}

/// The solved cells of every family of a plan.
pub(super) fn solve_families(plan: &Plan) -> Vec<Vec<SolvedCell>> {
    let all = |planned: &manifest::PlannedFamily| {
        let mut found = Vec::new();
        let kept = sweep::kept_cells(&planned.family);
        let collect = |mut solved: Vec<SolvedCell>| -> Result<(), ()> {
            found.append(&mut solved);
            Ok(())
        };
        let groups = sweep::CellGroups {
            cells: &kept,
            first_group: 0,
            size: 1,
            work_bytes: 0,
            requested_measures: None,
            solve_known: None,
        };
        sweep::process_groups(&planned.family, groups, |_, solved| solved, collect).unwrap();
        found
    };
    plan.families.iter().map(all).collect()
}

fn caption(plan: &Plan, family: usize, solved: &SolvedCell) -> String {
    let [caption, _] = plan.families[family].family.format_captions(&solved.cell, solved.first_curve_values());
    caption
}

fn atlas<'p>(plan: &'p Plan, solved: &[Vec<SolvedCell>]) -> Atlas<'p> {
    let chapter = |(k, planned): (usize, &'p manifest::PlannedFamily)| {
        let cells_per_page = planned.layout.cells_per_page();
        let cell = |(at, solved)| CellEntry { caption: caption(plan, k, solved), page: at / cells_per_page + 1 };
        let cells: Vec<CellEntry> = solved[k].iter().enumerate().map(cell).collect();
        Chapter {
            title: &planned.family.title,
            symbols: &planned.family.names,
            curve_count: Some(solved[k].iter().map(|solved| solved.curves.len()).sum()),
            page_count: solved[k].len().div_ceil(cells_per_page),
            sections: cells.iter().map(|cell| (cell.clone(), cell.page)).collect(),
            cells,
        }
    };
    let chapters = plan.families.iter().enumerate().map(chapter).collect();
    Atlas::new(&plan.title, "coupler-atlas 1.0", chapters)
}

/// The pages of all families, and the index entries of their cells.
pub(super) fn pages(plan: &Plan, solved: &[Vec<SolvedCell>]) -> (Vec<Scene>, Vec<IndexEntry>) {
    let (mut scenes, mut entries) = (Vec::new(), Vec::new());
    for (k, planned) in plan.families.iter().enumerate() {
        for (at, group) in solved[k].chunks(planned.layout.cells_per_page()).enumerate() {
            let number = scenes.len() + 1;
            let panel = |solved: &'_ SolvedCell| caption(plan, k, solved);
            let captions: Vec<String> = group.iter().map(panel).collect();
            let entry = |(s, caption): (&SolvedCell, &String)| {
                IndexEntry::from_solved_cell((s, planned.layout), caption, |_| 0).placed(k, number)
            };
            entries.extend(group.iter().zip(&captions).map(entry));
            scenes.push(page::compose_panels(&panel_page(plan, k, at + 1, group), &plan.page));
        }
    }
    (scenes, entries)
}

fn panel_page<'p>(plan: &'p Plan, family: usize, page: usize, group: &'p [SolvedCell]) -> PanelPage<'p> {
    let planned = &plan.families[family];
    let panel = |solved: &'p SolvedCell| {
        Panel::new(solved)
            .with_caption(caption(plan, family, solved))
            .with_facts(page::cell_facts(&planned.family, solved))
    };
    let (id, title, symbols) = (&planned.family.id, &planned.family.title, &planned.family.names);
    let heading =
        Heading::new(title).with_family_id(id).with_atlas_title(&plan.title).with_symbols(symbols).with_page(page, 9);
    PanelPage {
        heading,
        layout: planned.layout,
        panels: group.iter().map(panel).collect(),
        scale: PanelScale::Panel,
        key: None,
    }
}

/// The volumes of an atlas, with the number of pages before and after those of their families, and their bytes.
pub(super) fn volumes(plan: &Plan, max_pages: usize) -> Vec<(Volume, [usize; 2], Vec<u8>)> {
    let solved = solve_families(plan);
    let (scenes, entries) = pages(plan, &solved);
    let mut atlas = atlas(plan, &solved);
    atlas.index = entries;
    let write = |volume: Volume| {
        let page = panel_page(plan, 0, 1, &solved[0]);
        let front = book::compose_front_matter(&atlas, &volume, Some(&page), &plan.page);
        let back = book::compose_back_matter(&atlas, &volume, front.len(), &plan.page);
        let finisher = PageFinisher::new(&atlas, &volume, front.len(), &plan.page);
        let own = &scenes[volume.first_page - 1..volume.first_page - 1 + volume.page_count];
        let mut book = Book::new(atlas.title, atlas.program);
        for scene in &front {
            book.add_page(scene, book::page_number(&volume, front.len(), book.page_count())).unwrap();
        }
        for mut scene in own.iter().cloned() {
            let label = finisher.finish(&mut scene, book.page_count());
            book.add_page(&scene, label).unwrap();
        }
        for scene in &back {
            book.add_page(scene, book::page_number(&volume, front.len(), book.page_count())).unwrap();
        }
        let around = [front.len(), back.len()];
        (volume, around, book.finish(&book::outline(&atlas, &volume, front.len(), &plan.page)).unwrap())
    };
    atlas.volumes(max_pages, &plan.page).into_iter().map(write).collect()
}

/// The texts in a box of a page, which is given in points.
fn texts_in_box(contents: &Contents, [left, bottom, right, top]: [f64; 4], height: f64) -> Vec<&str> {
    let mm = 25.4 / 72.0;
    let (across, down): (Range<f64>, Range<f64>) =
        (left * mm..right * mm + 1e-3, (height - top) * mm..(height - bottom) * mm);
    let inside = |at: &[f64; 2]| at[0] > across.start - 1e-3 && at[0] < across.end && down.contains(&at[1]);
    contents.texts.iter().filter(|(_, at, _)| inside(at)).map(|(text, ..)| text.as_str()).collect()
}

#[test]
fn links_lead_to_the_page_with_the_number_next_to_them() {
    let plan = plan();
    for max_pages in [1000, 3, 1] {
        let mut followed = 0;
        for (volume, [front, index], bytes) in volumes(&plan, max_pages) {
            let pdf = Pdf::read(&bytes);
            assert_eq!(pdf.pages().len(), front + volume.page_count + index);
            let labels = pdf.labels();
            for page in (0..front).chain(front + volume.page_count..pdf.pages().len()) {
                let contents = pdf.contents(page);
                for (corners, to) in pdf.links(page) {
                    let words = texts_in_box(&contents, corners, 792.0);
                    let number = words.iter().rev().find_map(|word| word.parse::<usize>().ok()).unwrap();
                    assert_eq!(to, number - volume.first_page + front, "{words:?}");
                    assert_eq!(labels[to], format!("<</Type/PageLabel/S/D/St{number}>>"));
                    // The page has its number under its border.
                    let linked = pdf.contents(to);
                    let last = linked.texts.last().unwrap();
                    assert!(last.0 == number.to_string() && last.1[1] > 270.0, "{last:?}");
                    followed += 1;
                }
            }
        }
        // Two families, six geometries and the index twice in the contents, and at least six geometries by straightness and
        // six by transmission angle; in volumes of one page only what is in the same volume.
        let least = if max_pages == 1000 { 22 } else { 12 };
        assert!(followed >= least, "{followed} links in volumes of {max_pages} pages");
    }
}

#[test]
fn volumes_divide_the_pages_and_number_them_throughout() {
    let plan = plan();
    let volumes = volumes(&plan, 3);
    let ranges: Vec<Range<usize>> = volumes.iter().map(|(volume, ..)| volume.page_range()).collect();
    assert_eq!(ranges, [1..4, 4..5]);
    let labels = |k: usize| Pdf::read(&volumes[k].2).labels();
    let label = |label: &str| format!("<</Type/PageLabel/S/{}>>", label.replace(' ', "/St"));
    assert_eq!(labels(0), ["r 1", "r 2", "D 1", "D 2", "D 3"].map(label));
    // Odd numbers are on right-hand pages, so that there is a blank page; the back matter is in the last volume.
    assert_eq!(labels(1), ["r 1", "r 2", "r 3", "D 4", "D 5"].map(label));
    let outline: Vec<(usize, String, usize)> = Pdf::read(&volumes[1].2).outline();
    let titles: Vec<(usize, &str, usize)> =
        outline.iter().map(|(depth, title, page)| (*depth, title.as_str(), *page)).collect();
    let caption = "p = 3.00, r = 1.00, s = 4.00, a = 4.00";
    let expected =
        [(0, "Curves", 0), (0, "Contents", 1), (0, "Evans’s", 3), (1, caption, 3), (0, "Index of geometries", 4)];
    assert_eq!(titles, expected);
    let first = Pdf::read(&volumes[0].2).contents(0);
    assert!(first.texts.iter().any(|(says, ..)| says == "volume 1 of 2, pages 1–3"));
}

#[test]
fn every_page_of_an_atlas_is_in_one_volume() {
    for (pages, max_pages) in [(0, 5), (1, 5), (5, 5), (6, 5), (11, 5), (7, 0), (780, 1000)] {
        let chapters = vec![chapter("A", pages, Vec::new())];
        let atlas = Atlas::new("T", "p", chapters);
        let volumes = atlas.volumes(max_pages, &options(Paper::NAMED[1].1));
        let all: Vec<usize> = volumes.iter().flat_map(Volume::page_range).collect();
        assert_eq!(all, (1..=pages).collect::<Vec<_>>());
        assert!(
            volumes
                .iter()
                .zip(1..)
                .all(|(v, k)| v.number == k && v.volume_count == volumes.len() && v.page_count <= max_pages.max(1))
        );
    }
}

/// A chapter whose contents list its cells one by one.
fn chapter(title: &str, pages: usize, cells: Vec<CellEntry>) -> Chapter<'_> {
    let sections = cells.iter().map(|cell| (cell.clone(), cell.page)).collect();
    Chapter { title, symbols: &[], curve_count: None, page_count: pages, cells, sections }
}

fn options(paper: Paper) -> Options {
    Options::for_paper(paper)
}

/// All texts of a page, in order.
fn texts(scene: &Scene) -> Vec<String> {
    placed_texts(scene).map(|text| text.words()).collect()
}

/// The texts of a page, with their places.
fn placed_texts(scene: &Scene) -> impl Iterator<Item = &Text> {
    scene.shapes().into_iter().filter_map(|shape| if let Shape::Text(text) = shape { Some(text) } else { None })
}

#[test]
fn the_index_lists_the_best_first() {
    let plan = plan();
    let solved = solve_families(&plan);
    let (_, entries) = pages(&plan, &solved);
    let mut atlas = atlas(&plan, &solved);
    atlas.index = entries;
    let [volume] = atlas.volumes(1000, &plan.page).try_into().unwrap();
    let lines: Vec<String> = book::compose_back_matter(&atlas, &volume, 2, &plan.page).iter().flat_map(texts).collect();
    let section = |from: &str, to: &str, unit: &str| -> Vec<f64> {
        let begin = lines.iter().position(|line| line == from).unwrap();
        let end = lines.iter().position(|line| line == to).unwrap_or(lines.len());
        lines[begin..end].iter().filter_map(|line| line.strip_suffix(unit)?.parse().ok()).collect()
    };
    let angles = section("By transmission angle", "By symmetry", "°");
    let least = |solved: &SolvedCell| {
        let number = |key| solved.curves[0].measure(key).unwrap();
        let worst = number(Measure::MU_WORST);
        assert_eq!(worst, number(Measure::MU_MIN).min(180.0 - number(Measure::MU_MAX)));
        worst
    };
    let mut expected: Vec<f64> = solved.iter().flatten().map(least).collect();
    expected.sort_by(|a, b| b.total_cmp(a));
    assert_eq!(angles.len(), expected.len());
    // Written to a tenth of a degree.
    assert!(angles.iter().zip(&expected).all(|(a, b)| (a - b).abs() <= 0.05 + 1e-9), "{angles:?} {expected:?}");
    let percentages = section("By straightness", "By transmission angle", " %");
    assert!(percentages.len() == 6 && percentages.is_sorted_by(|a, b| a >= b), "{percentages:?}");
    assert!(percentages[5] > 0.0 && percentages[0] < 100.0, "{percentages:?}");
    // Evans linkages with s = a are symmetrical by theorem 2, two other geometries have curves that nearly are, and two have none.
    let residuals = section("By symmetry", "", " %");
    assert!(residuals.len() == 4 && residuals.is_sorted(), "{residuals:?}");
    assert!(residuals[..2] == [0.0, 0.0] && residuals[2] > 0.0 && residuals[3] <= 1.0, "{residuals:?}");
}

#[test]
fn a_small_index_has_the_dimensions_whole_and_its_marks_are_not_cut_off() {
    let plan = plan();
    let solved = solve_families(&plan);
    let title = "Linkages with a long title, as they are in the thesis and in the tables of its appendices";
    let mut atlas = atlas(&plan, &solved);
    atlas.chapters.iter_mut().for_each(|chapter| chapter.title = title);
    atlas.index = pages(&plan, &solved).1;
    atlas.tabs = (1..=3).map(|k| book::Tab { number: Some(k), label: "gears".to_owned(), first_page: k }).collect();
    let a6 = options(Paper { width: 105.0, height: 148.0 });
    let [volume] = atlas.volumes(1000, &a6).try_into().unwrap();
    let back = book::compose_back_matter(&atlas, &volume, 2, &a6);
    let lines: Vec<String> = back.iter().flat_map(texts).collect();
    for (k, solved) in solved.iter().enumerate().flat_map(|(k, all)| all.iter().map(move |solved| (k, solved))) {
        let whole = caption(&plan, k, solved);
        assert!(lines.join(" ").replace('\u{2003}', " ").contains(&whole), "{whole}: {lines:?}");
    }
    for (k, mut scene) in back.into_iter().enumerate() {
        PageFinisher::new(&atlas, &volume, 2, &a6).finish(&mut scene, k);
        // The height of letters is beside the baseline of those that are turned, and above that of the folio.
        let marks = placed_texts(&scene).filter(|text| text.words().ends_with("gears"));
        let distances: Vec<f64> =
            marks.map(|text| text.position.x.min(105.0 - text.position.x) - 0.76 * text.size).collect();
        assert!(distances.len() == 3 && distances.iter().all(|distance| *distance > 2.0 - 1e-9), "{distances:?}");
    }
}

#[test]
fn long_titles_are_broken_into_lines() {
    let title = "An atlas of the straight-line and dwell linkages that are driven by cranks, with all their cognates and limits";
    let family = "Linkages that are driven by cranks, with their limits, cognates and a longer title than most";
    let cell = CellEntry { caption: "p = 1".to_owned(), page: 1 };
    let atlas = Atlas::new(title, "p", vec![chapter(family, 1, vec![cell])]);
    for (_, paper) in Paper::NAMED {
        let front = book::compose_front_matter(&atlas, &atlas.volumes(9, &options(paper))[0], None, &options(paper));
        for (scene, whole) in front.iter().zip([title, family]) {
            let lines: Vec<String> = texts(scene).into_iter().filter(|line| line != "1").collect();
            assert!(!lines.contains(&whole.to_owned()) && lines.join(" ").contains(whole), "{lines:?}");
        }
        // Every line of the title is a link to the page, whose number is printed once.
        assert!(front[1].links.len() >= 3 && texts(&front[1]).iter().filter(|line| *line == "1").count() == 2);
    }
}

#[test]
fn the_contents_have_ranges_of_pages_and_the_outline_some_of_many_cells() {
    let cell = |k: usize| CellEntry { caption: format!("p = {k}"), page: k / 15 + 1 };
    let sections = vec![
        (CellEntry { caption: "p = 0 to 14999".to_owned(), page: 1 }, 1000),
        (CellEntry { caption: "p = 15000 to 29999".to_owned(), page: 1001 }, 2000),
    ];
    let many = Chapter { sections, ..chapter("Many", 2000, (0..30_000).map(cell).collect()) };
    let atlas = Atlas::new("T", "p", vec![many]);
    let options = options(Paper::NAMED[1].1);
    let volumes = atlas.volumes(1500, &options);
    for (volume, ranges) in volumes.iter().zip([&["1–1000", "1001–2000"][..], &["1001–2000"]]) {
        let front = book::compose_front_matter(&atlas, volume, None, &options);
        let lines: Vec<String> = front.iter().flat_map(texts).filter(|line| line.contains('–')).collect();
        let found: Vec<&String> = lines.iter().filter(|line| !line.contains("volume")).collect();
        assert_eq!(found, ranges, "{lines:?}");
    }
    let volume = Volume { page_count: 2000, volume_count: 1, ..volumes[0] };
    let front = book::compose_front_matter(&atlas, &volume, None, &options);
    // The first cell of every second page is in the outline.
    let children = &book::outline(&atlas, &volume, front.len(), &options)[2].children;
    assert_eq!(children.len(), 1000);
    assert_eq!((children[1].title.as_str(), children[1].page_index), ("p = 30", front.len() + 2));
    let links: Vec<usize> = front.iter().flat_map(|scene| &scene.links).filter_map(PageLink::page_index).collect();
    assert_eq!(links, [front.len(), front.len(), front.len() + 1000]);
}

#[test]
fn no_text_and_no_paper_make_a_book_fail() {
    let unusual_texts = ["", "<&>\"", "שלום", "漢字", "\u{0}\n", &"very long words ".repeat(60), &"x".repeat(400)];
    for paper in [Paper { width: 50.0, height: 50.0 }, Paper { width: 50.0, height: 2000.0 }, Paper::NAMED[2].1] {
        let options = options(paper);
        for text in unusual_texts {
            let cell = CellEntry { caption: text.to_owned(), page: 1 };
            let empty = chapter(text, 0, Vec::new());
            let chapters = vec![chapter(text, 1, vec![cell; 40]), empty, chapter(text, 1, Vec::new())];
            let atlas = Atlas::new(text, text, chapters);
            for volume in atlas.volumes(1, &options) {
                let front = book::compose_front_matter(&atlas, &volume, None, &options);
                let back = book::compose_back_matter(&atlas, &volume, front.len(), &options);
                assert!(back.is_empty(), "no cell was measured");
                let mut book = Book::new(text, text);
                for scene in &front {
                    assert!(
                        scene.links.iter().all(|link| link.page_index().unwrap() < front.len() + volume.page_count)
                    );
                    book.add_page(scene, book::page_number(&volume, front.len(), book.page_count())).unwrap();
                }
                let blank = Scene { items: Vec::new(), links: Vec::new(), ..front[0].clone() };
                book.add_page(&blank, book::page_number(&volume, front.len(), book.page_count())).unwrap();
                book.finish(&book::outline(&atlas, &volume, front.len(), &options)).unwrap();
            }
        }
    }
    let none = Atlas::new("T", "p", Vec::new());
    let options = options(Paper::NAMED[0].1);
    let front = book::compose_front_matter(&none, &none.volumes(10, &options)[0], None, &options);
    assert_eq!(front.len(), 2, "no contents are listed, and a blank page follows the title");
}
