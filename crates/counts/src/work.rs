//! What is counted.

use std::hint::black_box;
use std::sync::Arc;

use coupler_atlas::manifest::{self, Plan};
use coupler_atlas::output::{self, PageShardSource};
use coupler_atlas::shard;
use coupler_atlas::shard::Division;
use coupler_curves::FourBar;
use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{AssemblyMode, DyadSet};
use coupler_curves::measure::MeasureSet;
use coupler_curves::motion::{
    DyadSigns, InputColumns, JointPositions, Sampler, find_circuits, place_leading_joints, poses_in_columns,
};
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_curves::template::ParameterKind;
use coupler_drawing::render::pdf::Book;
use coupler_drawing::scene::{PageNumber, Scene};
use coupler_find::{CurveFitOptions, CurveFitter, Index, Options, PathKind, Search, Target};

#[expect(dead_code, reason = "others need normally distributed numbers")]
#[path = "../../coupler-find/tests/random/mod.rs"]
mod random;

use random::Random;

use super::composed::{coupler_grid, panels};

/// A benchmark: its name, and what prepares its work, which is not counted.
pub type Benchmark = (&'static str, fn() -> Box<dyn FnMut()>);

/// All of them. A number in a name is how many of a thing are made, solved or drawn.
pub const ALL: [Benchmark; 17] = [
    ("positions of 36000 coupler points", || positions(1)),
    ("positions of 36000 times 10 coupler points", || positions(10)),
    ("positions of 3600 six-bars of Stephenson II", group_positions),
    ("10 circuits of eight-bars of class III", group_circuits),
    ("60 four-bars, all measures", || measures("four-bar", 60, MeasureSet::ALL)),
    ("60 four-bars, without portions", || measures("four-bar", 60, without(&PORTIONS))),
    ("60 four-bars, without portions and symmetry", || {
        measures("four-bar", 60, without(&[&PORTIONS[..], &["symmetry"]].concat()))
    }),
    ("20 slider-cranks, all measures", || measures("slider-crank", 20, MeasureSet::ALL)),
    ("20 six-bars, all measures", || measures("watt-six-bar", 20, MeasureSet::ALL)),
    ("a page of a coupler grid, SVG", || page(COUPLER_GRID, "svg")),
    ("a page of a coupler grid, PNG", || page(COUPLER_GRID, "png")),
    ("a composed page of a coupler grid, PDF", || {
        let plan = plan(COUPLER_GRID);
        let solved = Solver::new(&plan.families[0].family).solve(0).expect("a cell");
        pdf(coupler_grid(&plan, &solved))
    }),
    ("a page of panels, SVG", || page(PANELS, "svg")),
    ("a composed page of panels, PDF", || {
        let plan = plan(PANELS);
        let solver = Solver::new(&plan.families[0].family);
        let solved: Vec<SolvedCell> = (0..12).filter_map(|k| solver.solve(k)).collect();
        pdf(vec![panels(&plan, &solved)])
    }),
    ("a sweep of 10000 cells with six measures", sweep),
    ("a look-up in 100000 curves", look_up),
    ("a fit of a curve, and a quick search", fit),
];

/// How the names of measures begin that need the straight and circular portions.
const PORTIONS: [&str; 3] = ["straight", "dwell", "too_close"];

/// A page of ten curves with one measure, as of the atlas of Hrones and Nelson.
const COUPLER_GRID: &str = r#"
[atlas]
title = "A page"
[page]
paper = "tabloid"
[[family]]
id = "page"
title = "A page of ten curves"
linkage = "hrones-nelson"
layout = "coupler-grid"
scale = "30 mm"
sampling = { samples = 72 }
measures = ["length"]
cases = [{ A = 2.5, B = 3.5, C = 3 }]
"#;

/// A page of twelve panels.
const PANELS: &str = r#"
[atlas]
title = "A page"
[[family]]
id = "page"
title = "A page of panels"
measures = ["length"]
linkage = "four-bar"
layout = "panels"
panels = [3, 4]
grid = { frame = [4], along = [1.5], across = [2], crank = [1, 1.25, 1.5], coupler = [3, 3.5], rocker = [3, 3.5] }
"#;

/// The positions of a four-bar, a hundred times at 360 inputs.
fn positions(points: usize) -> Box<dyn FnMut()> {
    const SAMPLES: usize = 360;
    let mut family = family("four-bar", &[("frame", 4.0), ("crank", 1.0), ("coupler", 3.0), ("rocker", 3.5)]);
    let values = family.cell(0).values;
    let template = Arc::make_mut(&mut family.template);
    let point = template.joints[template.joints.len() - 1].clone();
    template.joints.extend((1..points).map(|_| point.clone()));
    let linkage = template.linkage(&values).expect("a four-bar");
    let joints = linkage.joints.len();
    let turn = Sampler::new(Sampling::Samples(SAMPLES)).full_turn().to_vec();
    let inputs = InputColumns::from_values(linkage.input(), turn.iter().map(|at| at.value));
    let mut out = JointPositions::new(joints, SAMPLES);
    let signs = DyadSigns::new(AssemblyMode::default(), DyadSet::EMPTY);
    Box::new(move || {
        for _ in 0..100 {
            place_leading_joints(black_box(&linkage), joints, inputs.as_slices(), &signs, &mut out, 0..SAMPLES);
            black_box(&mut out);
        }
    })
}

/// The positions of a six-bar that no dyads place, ten times at 360 inputs.
fn group_positions() -> Box<dyn FnMut()> {
    let family = family("stephenson-ii-six-bar", &[]);
    let linkage = family.template.linkage(&family.cell(0).values).expect("a six-bar");
    let circuits = find_circuits(&linkage).circuits;
    let turn = Sampler::new(Sampling::Samples(360)).full_turn().to_vec();
    let inputs = InputColumns::from_values(linkage.input(), turn.iter().map(|at| at.value));
    Box::new(move || {
        for _ in 0..10 {
            black_box(poses_in_columns(black_box(&linkage), &circuits[0].passes[0], &inputs));
        }
    })
}

/// The circuits of an eight-bar that no dyads place, with proof that there is no other near them.
fn group_circuits() -> Box<dyn FnMut()> {
    let family = family("eight-bar-class-iii", &[]);
    let linkage = family.template.linkage(&family.cell(0).values).expect("an eight-bar");
    Box::new(move || {
        for _ in 0..10 {
            black_box(find_circuits(black_box(&linkage)));
        }
    })
}

/// The measures but those whose names begin with some words.
fn without(words: &[&str]) -> MeasureSet {
    MeasureSet::of(|measure| !words.iter().any(|word| measure.name.starts_with(word)))
}

/// Linkages with random lengths, around their defaults, each solved and measured.
fn measures(linkage: &str, count: usize, measured: MeasureSet) -> Box<dyn FnMut()> {
    let template = catalogue::find(linkage).expect("a linkage of the catalogue");
    let example = |name: &str| if name == "frame" { 4.0 } else { 2.0 };
    let required = template.parameters.iter().filter(|parameter| parameter.default.is_none());
    let required: Vec<(&str, f64)> =
        required.map(|parameter| (parameter.name.as_str(), example(&parameter.name))).collect();
    let base = family(linkage, &required).cell(0).values;
    let mut random = Random(47);
    let mut next = || {
        let varied = template.parameters.iter().zip(&base).map(|(parameter, value)| match parameter.kind {
            ParameterKind::Length => (parameter.name.as_str(), value * random.between(0.6, 1.6)),
            _ => (parameter.name.as_str(), *value),
        });
        family(linkage, &varied.collect::<Vec<_>>())
    };
    let is_assembled = |family: &Family| {
        Solver::new(family).measuring(MeasureSet::EMPTY).solve(0).is_some_and(|solved| !solved.curves.is_empty())
    };
    let families: Vec<Family> = std::iter::repeat_with(&mut next).filter(is_assembled).take(count).collect();
    Box::new(move || {
        for family in &families {
            black_box(Solver::new(family).measuring(measured).solve(0));
        }
    })
}

fn family(linkage: &str, values: &[(&str, f64)]) -> Family {
    let values: Vec<(String, f64)> = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let template = catalogue::find(linkage).expect("a linkage of the catalogue");
    Family::single_cell(template, &values, Sampling::Samples(360)).expect("a family")
}

fn plan(text: &str) -> Plan {
    let read = manifest::parse(text);
    read.plan.unwrap_or_else(|| panic!("{:?}", read.problems))
}

/// A page of an atlas, solved, measured, drawn and written, without what an atlas has once.
fn page(text: &str, format: &str) -> Box<dyn FnMut()> {
    let text = text.replace("title = \"A page\"\n", &format!("title = \"A page\"\nformats = [\"{format}\"]\n"));
    let plan = plan(&text);
    let folder = tempfile::tempdir().expect("a folder");
    let draw = move || {
        let source = PageShardSource { plan: &plan, text: &text, folder: folder.path() };
        let whole = Division::Shard { index: 0, of: 1 };
        let options = output::Options { force: true, ..output::Options::default() };
        let drawn = output::write_page_shard(source, folder.path(), &options, whole, &mut |_| ());
        assert_eq!(drawn.expect("pages").drawn, 1);
    };
    // What a process does once, such as reading the widths of characters, is not counted.
    draw();
    Box::new(draw)
}

/// Pages that are composed already, as a book.
fn pdf(scenes: Vec<Scene>) -> Box<dyn FnMut()> {
    let draw = move || {
        let mut book = Book::new("A page", "counts");
        for (number, scene) in (1..).zip(&scenes) {
            book.add_page(scene, PageNumber::Arabic(number)).expect("a page");
        }
        black_box(book.finish(&[]).expect("a book"));
    };
    // What a process does once, such as unpacking the typefaces, is not counted.
    draw();
    Box::new(draw)
}

/// A hundredth of the million four-bars of docs/scale.md, with their six measures.
fn sweep() -> Box<dyn FnMut()> {
    let plan = plan(include_str!("../../../examples/scale/four-bars.toml"));
    let folder = tempfile::tempdir().expect("a folder");
    Box::new(move || {
        let options = shard::Options {
            division: Division::Cells { first: 400_001, last: 410_000 },
            format: shard::TableFormat::Csv,
            has_points: false,
            top: None,
            by: None,
            measures: None,
            only: Vec::new(),
            force: true,
            interrupt: Arc::default(),
        };
        shard::write_shard(&plan, folder.path(), &options, &mut |_| ()).expect("a sweep");
    })
}

/// A hundred points of a coupler curve.
fn target() -> Target {
    let curve = FourBar { frame: 3.1, crank: 1.2, coupler: 2.7, rocker: 3.3 }.coupler_curve(1.9, 1.4);
    let points: Vec<Point> = curve.expect("a curve").points().collect();
    let every = points.len() / 100;
    Target::new(&points.into_iter().step_by(every).take(100).collect::<Vec<_>>(), PathKind::Closed).expect("a path")
}

fn look_up() -> Box<dyn FnMut()> {
    let (index, target) = (Index::with_count(100_000), target());
    Box::new(move || drop(black_box(index.most_alike(&target, true, 200))))
}

fn fit() -> Box<dyn FnMut()> {
    let (index, target) = (Index::with_count(10_000), target());
    let other = FourBar { frame: 3.2, crank: 1.3, coupler: 2.7, rocker: 3.2 }.coupler_curve(1.8, 1.5);
    let curve: Vec<Point> = other.expect("a curve").points().collect();
    Box::new(move || {
        black_box(CurveFitter::new(&target, CurveFitOptions::default()).fit(&curve, true));
        let options = Options { effort: coupler_find::Effort::Quick, ..Options::default() };
        black_box(Search::new(&target, options).run(&index));
    })
}
