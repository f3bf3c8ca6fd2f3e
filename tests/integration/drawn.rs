//! The curves on pages are those of `points.csv`, to 0.01 mm on paper; and edits of pages are found.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use coupler_atlas::record::{DrawnCurve, DrawnCurveError, SolvedCurve, read_drawn_curves};
use coupler_curves::family::Family;
use coupler_curves::geometry::{Point, Spline, SplineSegment, Vector, left_normal};
use coupler_curves::linkage::Linkage;
use coupler_curves::motion::{Circuit, Motion, Sampler};

use crate::support::folder::Atlas;
use crate::support::plan::plan;

/// The samples of a curve: its inputs and its positions in the plane.
#[derive(Default)]
struct Samples {
    inputs: Vec<f64>,
    positions: Vec<Point>,
    /// The linkage and its motion, solved again.
    solved: Option<Arc<(Linkage, Motion)>>,
}

impl Samples {
    fn pairs(&self) -> impl Iterator<Item = (f64, Point)> {
        self.inputs.iter().copied().zip(self.positions.iter().copied())
    }

    fn circuit(&self, drawn: &DrawnCurve) -> &Circuit {
        let (_, motion) = &**self.solved.as_ref().unwrap();
        &motion.circuits[drawn.circuit - 1]
    }

    fn after_last(&self, drawn: &DrawnCurve) -> Option<f64> {
        self.circuit(drawn).input_after_last()
    }

    /// How far a drawn curve strays from the curve between the samples.
    fn stray(&self, drawn: &DrawnCurve) -> Option<f64> {
        let (linkage, _) = &**self.solved.as_ref().unwrap();
        let circuit = self.circuit(drawn);
        let curve = SolvedCurve::new(linkage, circuit, linkage.traced[drawn.trace - 1], drawn.page_from_plane);
        drawn.max_stray(&self.positions, circuit.is_closed, |point, enough| curve.distance(point, enough))
    }
}

/// A page in SVG, and each of its curves with its samples.
struct Page {
    name: String,
    svg: Vec<u8>,
    curves: Vec<(DrawnCurve, Samples)>,
}

/// The curves of a family's `points.csv`.
fn recorded(folder: &Path) -> BTreeMap<[usize; 3], Samples> {
    let mut table = csv::Reader::from_path(folder.join("points.csv")).unwrap();
    let header = table.headers().unwrap().clone();
    let column = |names: &[&str]| header.iter().position(|name| names.contains(&name)).unwrap();
    let key = [column(&["cell"]), column(&["trace"]), column(&["circuit"])];
    let [input, x, y] = [column(&["input_deg", "input_length"]), column(&["x"]), column(&["y"])];
    let mut curves: BTreeMap<[usize; 3], Samples> = BTreeMap::new();
    for row in table.records() {
        let row = row.unwrap();
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let samples = curves.entry(key.map(|column| row[column].parse().unwrap())).or_default();
        samples.inputs.push(number(input));
        samples.positions.push(Point::new(number(x), number(y)));
    }
    curves
}

/// Solves the cells of a family that have samples.
fn solve(family: &Family, samples: &mut BTreeMap<[usize; 3], Samples>) {
    let sampler = Sampler::new(family.sampling);
    let mut solved: Option<(usize, Arc<(Linkage, Motion)>)> = None;
    for (&[cell, ..], samples) in samples {
        if solved.as_ref().is_none_or(|(number, _)| *number != cell) {
            let linkage = family.linkage(&family.cell(cell - 1)).unwrap();
            let motion = Motion::solve(&linkage, &sampler);
            solved = Some((cell, Arc::new((linkage, motion))));
        }
        samples.solved = solved.as_ref().map(|(_, solved)| solved.clone());
    }
}

/// All pages with curves that a manifest makes of some of its families, or of all. Every curve of `points.csv` is on one of them.
fn pages(manifest: &str, only: &[&str]) -> Vec<Page> {
    let plan = plan(manifest);
    let only = only.iter().flat_map(|family| ["--only", family]);
    let atlas =
        Atlas::rendered(manifest, &["-q", "--format", "svg", "-o", "out"].into_iter().chain(only).collect::<Vec<_>>());
    let mut pages = Vec::new();
    for family in fs::read_dir(atlas.out()).unwrap().map(|entry| entry.unwrap().path()) {
        if !family.join("points.csv").exists() {
            continue;
        }
        let mut samples = recorded(&family);
        let id = family.file_name().unwrap().to_string_lossy();
        solve(&plan.families.iter().find(|planned| planned.family.id == id).unwrap().family, &mut samples);
        let mut files: Vec<_> = fs::read_dir(&family).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.retain(|file| file.extension().is_some_and(|extension| extension == "svg"));
        files.sort();
        let count = pages.len();
        for file in files {
            let name = file.file_stem().unwrap().to_string_lossy().into_owned();
            let svg = fs::read(&file).unwrap();
            let drawn = read_drawn_curves(&svg).unwrap_or_else(|error| panic!("{name}: {error}"));
            let with_samples = |curve: DrawnCurve| {
                let samples = samples.remove(&[curve.cell, curve.trace, curve.circuit]);
                let samples = samples.unwrap_or_else(|| panic!("{name}: {} is drawn twice or not recorded", curve.id));
                (curve, samples)
            };
            let curves: Vec<_> = drawn.into_iter().map(with_samples).collect();
            if !curves.is_empty() {
                pages.push(Page { name, svg, curves });
            }
        }
        // The family of a chart records the samples of its curves, and draws none of them.
        assert!(samples.is_empty() || pages.len() == count, "{}: {:?} are not drawn", family.display(), samples.keys());
    }
    pages
}

const ATLAS: &str = include_str!("../../atlas.toml");

/// The pages of the atlas of this repository.
fn atlas() -> &'static [Page] {
    static PAGES: OnceLock<Vec<Page>> = OnceLock::new();
    PAGES.get_or_init(|| pages(ATLAS, &[]))
}

/// Some pages of the atlas of Hrones and Nelson.
fn hrones_nelson() -> &'static [Page] {
    static PAGES: OnceLock<Vec<Page>> = OnceLock::new();
    PAGES.get_or_init(|| {
        let manifest = include_str!("../../examples/hrones-nelson.toml");
        let all = manifest.lines().find(|line| line.starts_with("grid = ")).unwrap();
        pages(&manifest.replace(all, "grid = { A = [1.5, 4], B = [2.5, 3], C = [2.5, 4] }"), &[])
    })
}

fn curves() -> impl Iterator<Item = &'static (DrawnCurve, Samples)> {
    atlas().iter().chain(hrones_nelson()).flat_map(|page| &page.curves)
}

/// The distance that a comparison may find, in millimetres.
const TOLERANCE: f64 = 0.01;

#[test]
#[ignore = "thorough"]
fn curves_are_drawn_where_their_samples_are() {
    assert!(atlas().len() > 20 && hrones_nelson().len() > 20);
    for page in atlas().iter().chain(hrones_nelson()) {
        for (curve, samples) in &page.curves {
            let (sample, distance) = curve.furthest_sample(samples.pairs(), samples.after_last(curve)).unwrap();
            assert!(distance <= TOLERANCE, "{}: {} is {distance} mm off at {sample}", page.name, curve.id);
            assert_eq!(samples.stray(curve), None, "{}: {}", page.name, curve.id);
        }
    }
}

/// The normal of a polyline at one of its points; `None` at its ends and where it turns back.
fn normal(points: &[Point], k: usize) -> Option<Vector> {
    let [before, at, after] = points.get(k.checked_sub(1)?..=k + 1)? else { return None };
    let is_ahead = (at - before).dot(&(after - at)) > 0.9 * (at - before).norm() * (after - at).norm();
    left_normal(after - before).try_normalize(0.0).filter(|_| is_ahead)
}

#[test]
fn a_sample_that_is_moved_is_found() {
    let mut moved = 0;
    for (curve, samples) in curves() {
        let [period, drawn] = curve.dash;
        let is_inside = |input: f64| (0.05 * drawn..0.95 * drawn).contains(&input.rem_euclid(period));
        for k in (0..samples.inputs.len()).filter(|&k| is_inside(samples.inputs[k])).step_by(7) {
            let Some(normal) = normal(&samples.positions, k) else { continue };
            let place = |(i, (input, at)): (usize, (f64, Point))| {
                (input, if i == k { at + normal * (0.02 / curve.page_from_plane.scale()) } else { at })
            };
            let found = curve.furthest_sample(samples.pairs().enumerate().map(place), samples.after_last(curve));
            let is_found = found.is_some_and(|(at, distance)| at == k && distance > TOLERANCE);
            assert!(is_found, "{}: sample {k}: {found:?}", curve.id);
            moved += 1;
        }
    }
    assert!(moved > 1_000, "{moved}");
}

/// A spline of a drawn curve: of its hairline, or a dash.
fn spline_mut(curve: &mut DrawnCurve, k: usize) -> &mut Spline {
    let whole = curve.hairline.len();
    if k < whole { &mut curve.hairline[k] } else { &mut curve.dashes[k - whole] }
}

/// The drawn curve with one segment of a spline bent so that its middle is moved by a distance in millimetres; `None` if
/// the segment is too short for that.
fn bent(curve: &DrawnCurve, k: usize, segment: usize, distance: f64) -> Option<DrawnCurve> {
    let mut edited = curve.clone();
    let spline = spline_mut(&mut edited, k);
    let (start, end) = spline.segments_with_starts().nth(segment).map(|(start, segment)| (start, segment.end()))?;
    let normal = left_normal(end - start).try_normalize(0.2)?;
    let third = (end - start) / 3.0;
    let [b, c] = match spline.segments[segment] {
        SplineSegment::Line(_) => [start + third, end - third],
        SplineSegment::Cubic([b, c, _]) => [b, c],
    };
    // The weights of both control points are 3/8 in the middle.
    let by = normal * (distance * 4.0 / 3.0);
    spline.segments[segment] = SplineSegment::Cubic([b + by, c + by, end]);
    Some(edited)
}

/// The numbers of the splines of a drawn curve and of their segments.
fn segments(curve: &DrawnCurve) -> impl Iterator<Item = (usize, usize)> {
    let splines = curve.hairline.iter().chain(&curve.dashes).enumerate();
    splines.flat_map(|(k, spline)| (0..spline.segments.len()).map(move |segment| (k, segment)))
}

#[test]
#[ignore = "thorough"]
fn a_segment_that_is_bent_is_found() {
    let mut moved = 0;
    for (curve, samples) in curves() {
        for (k, segment) in segments(curve).step_by(7) {
            let Some(edited) = bent(curve, k, segment, 0.05) else { continue };
            let is_off =
                edited.furthest_sample(samples.pairs(), samples.after_last(curve)).is_some_and(|(_, d)| d > TOLERANCE);
            assert!(is_off || samples.stray(&edited).is_some(), "{}: segment {segment} of spline {k}", curve.id);
            moved += 1;
        }
    }
    assert!(moved > 1_000, "{moved}");
}

#[test]
#[ignore = "thorough"]
fn a_dash_that_is_removed_or_ends_elsewhere_is_found() {
    for (curve, samples) in curves().step_by(7) {
        assert_eq!(curve.furthest_dash_end(curve), 0.0);
        for k in (0..curve.dashes.len()).step_by(11) {
            let [mut without, mut longer] = [curve.clone(), curve.clone()];
            let dash = without.dashes.remove(k);
            let length = (dash.end() - dash.start).norm();
            if length < 0.2 {
                continue;
            }
            assert!(without.furthest_dash_end(curve) > TOLERANCE, "{}: dash {k}", curve.id);
            // On the curve, and so not seen by its samples.
            let next = &curve.dashes[(k + 1) % curve.dashes.len()];
            longer.dashes[k].segments.push(SplineSegment::Line(dash.end() + (next.start - dash.end()) * 0.3));
            if (next.start - dash.end()).norm() > 0.2 {
                assert!(longer.furthest_dash_end(curve) > TOLERANCE, "{}: dash {k}", curve.id);
            }
        }
        let sparse = DrawnCurve { dashes: Vec::new(), ..curve.clone() };
        assert_eq!(sparse.furthest_dash_end(curve), f64::INFINITY);
        assert_eq!(sparse.furthest_sample(samples.pairs(), samples.after_last(curve)).unwrap().1, f64::INFINITY);
    }
}

/// Curves with few samples: of a full turn, of rockers between limits, one of them near a change point, and of an
/// actuator.
const COARSE: &str = r#"[atlas]
title = "Coarse samples"
[[family]]
id = "turn"
linkage = "evans"
sampling = { samples = 12 }
cases = [{ p = 2, a = 2.59 }, { p = 1.61, r = 1.76, a = 4.62, s = 4.82, k = 1.46 }]
[[family]]
id = "rockers"
linkage = "four-bar"
sampling = { samples = 12 }
cases = [
    { frame = 4, crank = 3, coupler = 2, rocker = 3.4, along = 1, across = 0.7 },
    { frame = 4, crank = 3, coupler = 2, rocker = 3.0001, along = 1, across = 0.7 },
]
[[family]]
id = "few"
linkage = "watt"
sampling = { samples = 3 }
cases = [{ p = 8, r = 4, a = 2.5 }]
[[family]]
id = "actuator"
linkage = "linear-actuator"
sampling = { samples = 12, spacing = "arc" }
cases = [{ g = 2, r = 1, e = 0.2 }]
"#;

#[test]
#[ignore = "thorough"]
fn a_detour_between_coarse_samples_is_found() {
    let (mut moved, mut missed) = (0, 0);
    for page in pages(COARSE, &[]) {
        for (curve, samples) in &page.curves {
            assert_eq!(samples.stray(curve), None, "{}", curve.id);
            for (k, segment) in segments(curve).step_by(3) {
                let Some(edited) = bent(curve, k, segment, 0.05) else { continue };
                let stray = samples.stray(&edited).unwrap_or(0.0);
                assert!(stray <= 0.06, "{}: {stray} at segment {segment} of spline {k}", curve.id);
                moved += 1;
                // Where the path turns back, the bent segment may be on its other part.
                missed += usize::from(stray < 0.02);
            }
        }
    }
    assert!(moved > 130 && 100 * missed < moved, "{missed} of {moved}");
}

/// A page of the atlas.
fn page_named(name: &str) -> &'static Page {
    static PAGES: OnceLock<Vec<Page>> = OnceLock::new();
    let pages = PAGES.get_or_init(|| pages(ATLAS, &["evans", "scotch-yoke"]));
    pages.iter().find(|page| page.name == name).unwrap()
}

/// A page with some curves.
fn page() -> &'static Page {
    page_named("evans-001")
}

fn read(svg: &str) -> Result<Vec<DrawnCurve>, DrawnCurveError> {
    read_drawn_curves(svg.as_bytes())
}

#[test]
fn a_dash_that_is_moved_in_the_file_is_found() {
    let text = std::str::from_utf8(&page().svg).unwrap();
    let (curve, samples) = &page().curves[2];
    for (distance, is_right) in [(0.0, true), (0.05, false)] {
        let mut data = String::new();
        for (k, spline) in curve.dashes.iter().enumerate() {
            let by = Vector::repeat(if k == 5 { distance } else { 0.0 });
            let Point { coords: start, .. } = spline.start + by;
            write!(data, "M{:.3},{:.3}", start.x, start.y).unwrap();
            for segment in &spline.segments {
                let points: Vec<String> =
                    segment.points().iter().map(|p| p + by).map(|p| format!("{:.4},{:.4}", p.x, p.y)).collect();
                write!(data, "{}{}", if points.len() == 1 { 'L' } else { 'C' }, points.join(" ")).unwrap();
            }
        }
        let group = text.find(&format!("id=\"{}\"", curve.id)).unwrap();
        let hairline = group + text[group..].find(" d=\"").unwrap() + 4;
        let from = hairline + text[hairline..].find(" d=\"").unwrap() + 4;
        let to = from + text[from..].find('"').unwrap();
        let edited = read(&format!("{}{data}{}", &text[..from], &text[to..])).unwrap();
        let edited = edited.iter().find(|edited| edited.id == curve.id).unwrap();
        let (_, found) = edited.furthest_sample(samples.pairs(), samples.after_last(curve)).unwrap();
        let stray = samples.stray(edited);
        assert_eq!(found <= TOLERANCE && stray.is_none(), is_right, "{distance}: {found}, {stray:?}");
    }
}

/// On the page of scotch yokes, the way back has no dashes.
#[test]
fn stretches_without_dashes_are_read_from_the_page() {
    let page = page_named("scotch-yoke-001");
    let (curve, samples) = &page.curves[0];
    assert_eq!(curve.dashed_travel.as_deref(), Some(&[[0.0, 180.0]][..]));
    assert_eq!(curve.dashes.len(), 36);
    let undashed = DrawnCurve { dashed_travel: None, ..curve.clone() };
    // The dashes of the way there do not cover the samples on the way back, which are in gaps of the former.
    assert!(undashed.furthest_sample(samples.pairs(), samples.after_last(curve)).unwrap().1 > TOLERANCE);
    let text = std::str::from_utf8(&page.svg).unwrap();
    for (edited, is_valid) in
        [("0 180", true), ("", true), ("0", false), ("180 0", false), ("0 180 x 190", false), ("0 inf", false)]
    {
        let page = read(&text.replacen("data-drawn=\"0 180\"", &format!("data-drawn=\"{edited}\""), 1));
        let message = "of curve `scotch-yoke-1-1-1` is not pairs of rising numbers";
        assert_eq!(page.is_ok(), is_valid, "{edited}");
        assert!(page.is_ok() || page.unwrap_err().to_string().contains(message));
    }
}

#[test]
fn the_attributes_of_a_page_describe_how_it_was_drawn() {
    let text = std::str::from_utf8(&page().svg).unwrap();
    let (curve, _) = &page().curves[0];
    assert_eq!((curve.id.as_str(), curve.cell, curve.trace, curve.circuit), ("evans-1-1-1", 1, 1, 1));
    assert_eq!(curve.dash, [5.0, 3.0]);
    let similarity = curve.page_from_plane;
    let Point { coords: at, .. } = similarity.origin();
    let facts = format!("data-scale=\"{}\" data-origin=\"{} {}\" data-dash=\"5 3\">", similarity.scale(), at.x, at.y);
    assert!(text.contains(&format!(
        "<g id=\"evans-1-1-1\" class=\"curve\" data-cell=\"1\" data-trace=\"1\" data-circuit=\"1\" {facts}"
    )));
    assert_eq!(text.matches("data-scale").count(), page().curves.len());
}

#[test]
fn an_edited_page_reads_the_same_or_has_an_error() {
    let text = std::str::from_utf8(&page().svg).unwrap();
    let all = read(text).unwrap();
    for same in [
        format!("\u{feff}{text}"),
        text.replace('\n', "\r\n"),
        format!("<?xml version=\"1.0\"?><!-- a comment -->{text}<!-- and another -->"),
        text.replace("class=\"curve\"", "class='&#99;urve'").replace("data-dash=\"5 3\"", "data-dash='\r\n5 &#x33; '"),
    ] {
        assert_eq!(read(&same).as_ref(), Ok(&all));
    }
    let group = "<g id=\"evans-1-1-1\"";
    let first = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    for (edited, message) in [
        (String::new(), "it is not an SVG page"),
        ("words".to_owned(), "it is not an SVG page"),
        (first("<svg", "<html").replace("</svg>", "</html>"), "it is not an SVG page"),
        (format!("{text}{text}"), "it is not an SVG page"),
        (format!("<!DOCTYPE svg [<!ENTITY a \"b\">]>{text}"), "it has a document type, which pages do not have"),
        (first("<rect", "<style>g{transform:scale(2)}</style><rect"), "it has a style sheet, which pages do not have"),
        (first("mm\" viewBox", "cm\" viewBox"), "its viewBox is not its width and height in millimetres"),
        (first("data-cell=\"1\" ", ""), "curve `evans-1-1-1` has no data-cell"),
        (
            first("data-trace=\"1\"", "data-trace=\"-1\""),
            "data-trace=\"-1\" of curve `evans-1-1-1` is not a whole number",
        ),
        (
            first("data-dash=\"5 3\"", "data-dash=\"5\""),
            "data-dash=\"5\" of curve `evans-1-1-1` is not two positive numbers, the second not above the first",
        ),
        (
            first("data-dash=\"5 3\"", "data-dash=\"5 3 1\""),
            "data-dash=\"5 3 1\" of curve `evans-1-1-1` is not two positive numbers, the second not above the first",
        ),
        (
            first("data-scale=\"", "data-scale=\"inf\" data-x=\""),
            "data-scale=\"inf\" of curve `evans-1-1-1` is not a positive number",
        ),
        (first("data-origin=\"", "data-origin=\"a "), "is not two numbers"),
        (
            first(group, &format!("{group} transform=\"scale(2)\"")),
            "curve `evans-1-1-1`, or an element around it, has a transform",
        ),
        (
            first(group, &format!("{group} style=\"display:none\"")),
            "curve `evans-1-1-1`, or an element around it, has a style",
        ),
        (
            first("<svg ", "<svg transform=\"scale(2)\" "),
            "curve `evans-1-1-1`, or an element around it, has a transform",
        ),
        (
            first("<rect", "<g transform=\"scale(2)\"><rect").replace("</svg>", "</g></svg>"),
            "curve `evans-1-1-1`, or an element around it, has a transform",
        ),
        (
            first("<rect", "<defs><rect").replace("</svg>", "</defs></svg>"),
            "curve `evans-1-1-1` contains or is inside <defs>",
        ),
        (
            first("data-dash=\"5 3\">", "data-dash=\"5 3\"><polyline points=\"0 0 9 9\"/>"),
            "curve `evans-1-1-1` contains or is inside <polyline>",
        ),
        (first(group, &format!("{group} id=\"b\"")), "an attribute is repeated"),
        (first("data-cell=\"1\" ", "data-cell=\"&one;\" "), "is not well-formed XML"),
    ] {
        match read(&edited) {
            Ok(_) => panic!("{message}"),
            Err(error) => assert!(error.to_string().contains(message), "{error}\n{message}"),
        }
    }
    assert_eq!(read_drawn_curves(b"\xff\xfe<\0s\0v\0g\0"), Err(DrawnCurveError::NotUtf8));
}

/// Panics if a part of a page is read as one, or one with a changed byte makes the reader panic: every so many bytes.
fn assert_no_panic([end_step, change_step]: [usize; 2]) {
    let svg = &page().svg;
    // Everything but the last line break is needed.
    for end in (0..svg.len() - 1).step_by(end_step).chain([svg.len() - 2]) {
        assert!(read_drawn_curves(&svg[..end]).is_err(), "{end}");
    }
    for at in (0..svg.len()).step_by(change_step) {
        for flip in [1, 2, 0x10, 0x20, 0x80] {
            let mut flipped = svg.clone();
            flipped[at] ^= flip;
            // Some characters may differ; every page is read or rejected.
            let _ = read_drawn_curves(&flipped);
        }
    }
}

#[test]
#[ignore = "thorough"]
fn no_changed_page_makes_the_reader_panic() {
    assert_no_panic([97, 89]);
}

#[test]
fn no_page_makes_the_reader_panic() {
    assert_no_panic([389, 499]);
    let page = |inside: &str| read(&format!("<svg width=\"1mm\" height=\"1mm\" viewBox=\"0 0 1 1\">{inside}</svg>"));
    let nested = format!("{}{}", "<g>".repeat(100_000), "</g>".repeat(100_000));
    assert_eq!(page(&nested), Ok(Vec::new()));
    assert!(page(&"<g>".repeat(100_000)).is_err());
    let long = "9".repeat(10_000_000);
    assert_eq!(page(&format!("<g id=\"{long}\"/>")), Ok(Vec::new()));
    let attributes: String = (0..500_000).fold(String::new(), |all, k| all + &format!(" a{k}=\"\""));
    assert_eq!(page(&format!("<g{attributes}/>")), Ok(Vec::new()));
    let curve = |data: &str| {
        let facts = "data-cell=\"1\" data-trace=\"1\" data-circuit=\"1\" data-scale=\"1\" data-origin=\"0 0\" data-dash=\"5 3\"";
        page(&format!("<g id=\"a\" class=\"curve\" {facts}><path d=\"{data}\"/></g>"))
    };
    let at = Point::new;
    let line = Spline { start: at(0.0, 0.0), segments: vec![SplineSegment::Line(at(1.0, 0.0))] };
    assert_eq!(curve("M0 0h1").unwrap()[0].hairline, [line]);
    let cubic = Spline {
        start: at(1.0, 1.0),
        segments: vec![SplineSegment::Cubic([at(2.0, 1.0), at(2.0, 2.0), at(1.0, 2.0)])],
    };
    for data in ["M1 1C2 1 2 2 1 2", "m1 1c1 0 1 1 0 1"] {
        assert_eq!(curve(data).unwrap()[0].hairline, std::slice::from_ref(&cubic));
    }
    // Curves so long that they would take millions of chords, or whose coordinates overflow.
    let too_many = Err(DrawnCurveError::TooManyPoints { max_points: 2_000_000 });
    assert_eq!(curve(&format!("M0 0{}", "c1e9 1 1 1e9 1 1".repeat(100))), too_many);
    assert_eq!(curve(&format!("M0 0{}", "q1e8 1 1 1".repeat(1_000))), too_many);
    for data in ["M0 0C1e308 1e308 -1e308 1e308 1e308 0", "M0 0c1e308 0 0 0 1e308 0 1e308 0 0 0 1e308 0"] {
        match curve(data) {
            Ok(curves) => {
                let samples = || (0..9).map(|k| (f64::from(k), Point::new(f64::from(k), 0.0)));
                let places: Vec<Point> = samples().map(|(_, place)| place).collect();
                let _ = curves[0].furthest_sample(samples(), Some(0.0));
                let _ = curves[0].max_stray(&places, true, |_, _| 0.0);
                let _ = curves[0].furthest_dash_end(&curves[0]);
            }
            Err(error) => assert!(error.to_string().len() < 200),
        }
    }
    assert_eq!(curve(&long), Err(DrawnCurveError::NotSplines { curve: "a".to_owned() }));
    assert_eq!(curve(&format!("M0 0h{long}")), Err(DrawnCurveError::NotSplines { curve: "a".to_owned() }));
    assert_eq!(curve("M0 0A1e9 1 0 0 0 1 1"), Err(DrawnCurveError::NotSplines { curve: "a".to_owned() }));
    assert_eq!(
        curve(&format!("M0 0{}", "h1".repeat(2_000_001))),
        Err(DrawnCurveError::TooManyPoints { max_points: 2_000_000 })
    );
    let error = page(&format!("<g id=\"{long}\" class=\"curve\"/>")).unwrap_err().to_string();
    assert!(error.len() < 200, "{}", error.len());
}
