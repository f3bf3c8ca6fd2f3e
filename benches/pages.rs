//! Benchmarks composing and rendering pages of ten coupler curves on one core: `cargo bench --bench pages`.
use std::hint::black_box;

#[expect(dead_code, reason = "others need pages of panels")]
#[path = "../crates/counts/src/composed.rs"]
mod composed;

use composed::coupler_grid;
use coupler_atlas::manifest;
use coupler_curves::solve::Solver;
use coupler_drawing::render::{self, TextMode};
use coupler_drawing::scene::Scene;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn pages(criterion: &mut Criterion) {
    let plan = manifest::parse(include_str!("../examples/hrones-nelson.toml")).plan.expect("a valid manifest");
    let family = &plan.families[0].family;
    // A = 2.5, B = 3.5, C = 3: its curves are neither small nor long.
    let solved = Solver::new(family).solve(87).expect("a cell");
    let scenes = coupler_grid(&plan, &solved);
    let mut group = criterion.benchmark_group("pages");
    group.throughput(Throughput::Elements(scenes.len() as u64));
    group.sample_size(20);
    group.bench_function("composed", |bencher| bencher.iter(|| black_box(coupler_grid(&plan, &solved))));
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
