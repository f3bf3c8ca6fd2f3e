//! Benchmarks composing and rendering pages of ten coupler curves on one core: `cargo bench --bench pages`.
use std::hint::black_box;

use coupler_atlas::manifest::{self, Plan};
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_drawing::page::{self, CouplerGridPage, Heading, Layout, Panel, PanelScale, PoseChoice};
use coupler_drawing::render::{self, TextMode};
use coupler_drawing::scene::Scene;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Composes the pages of one cell of the atlas of Hrones and Nelson.
fn compose(plan: &Plan, solved: &SolvedCell) -> Vec<Scene> {
    let family = &plan.families[0].family;
    let pages = solved.curves_by_traces(Layout::POINTS_PER_PAGE);
    let page_count = pages.len();
    let pose = page::clearest_pose(solved).map_or(PoseChoice::Clearest, PoseChoice::Fixed);
    let sheet = |(page, shown)| {
        let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
        let facts = page::cell_facts(family, solved);
        let (title, symbols) = (family.title.as_str(), family.names.as_slice());
        let source = plan.families[0].source.clone();
        let heading = Heading::new(title)
            .with_family_id(&family.id)
            .with_atlas_title(&plan.title)
            .with_source(source)
            .with_symbols(symbols)
            .with_page(page, page_count);
        let panel = Panel::new(solved).with_caption(caption).with_note(note).with_facts(facts).with_pose(pose.clone());
        let straight_criterion = family.straight;
        let (scale, curve_indices) = (PanelScale::Panel, shown);
        let sheet = CouplerGridPage {
            heading,
            panel,
            scale,
            curve_indices,
            coordinates: &[],
            labels: &[],
            key: None,
            straight_criterion,
        };
        page::compose_coupler_grid(&sheet, &plan.page)
    };
    (1..).zip(pages).map(sheet).collect()
}

fn pages(criterion: &mut Criterion) {
    let plan = manifest::parse(include_str!("../examples/hrones-nelson.toml")).plan.expect("a valid manifest");
    let family = &plan.families[0].family;
    // A = 2.5, B = 3.5, C = 3: its curves are neither small nor long.
    let solved = Solver::new(family).solve(87).expect("a cell");
    let scenes = compose(&plan, &solved);
    let mut group = criterion.benchmark_group("pages");
    group.throughput(Throughput::Elements(scenes.len() as u64));
    group.sample_size(20);
    group.bench_function("composed", |bencher| bencher.iter(|| black_box(compose(&plan, &solved))));
    let mut bench = |name: &str, render: &dyn Fn(&Scene) -> Vec<u8>| {
        group.bench_function(name, |bencher| {
            bencher.iter(|| scenes.iter().for_each(|scene| drop(black_box(render(scene)))));
        });
    };
    bench("svg", &|scene| render::svg(scene, TextMode::Text));
    bench("png at 100 dpi", &|scene| render::png(scene, 100.0).expect("an image"));
    bench("png at 300 dpi", &|scene| render::png(scene, 300.0).expect("an image"));
    group.finish();
}

criterion_group!(benches, pages);
criterion_main!(benches);
