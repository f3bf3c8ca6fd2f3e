//! How many positions of a four-bar one core solves: `cargo bench`.
//!
//! A position is a crank pin, a rocker pin and a coupler point. The table of sines and cosines is made beforehand, as
//! it is for all cells of a family.

use std::hint::black_box;

use coupler_atlas::linkage::{Assembly, Flat, Linkage, Side, Signs, Travel};
use coupler_atlas::motion::{Columns, Inputs, Modes, Motion, Sampler, Sampling, Stop, place};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SAMPLES: usize = 360;

/// A crank-rocker with `points` coupler points.
fn four_bar(points: usize) -> Linkage {
    let mut assembly = Assembly::default();
    let o = assembly.fixed("O", [0.0, 0.0].into());
    let c = assembly.fixed("C", [4.0, 0.0].into());
    let a = assembly.crank("A", o, 1.0).expect("a crank");
    let b = assembly.dyad("B", [a, c], [3.0, 3.5], Side::Left).expect("a dyad");
    let traced = (0..points).map(|k| assembly.point("M", [a, b], 0.4 * k as f64, 1.0).expect("a point")).collect();
    assembly.finish(traced, None, Travel::default()).expect("a four-bar")
}

fn kernel(criterion: &mut Criterion) {
    let sampler = Sampler::new(Sampling::Samples(SAMPLES));
    let column = |pick: fn(&Stop) -> f64| sampler.turn().iter().map(pick).collect::<Vec<f64>>();
    let (at, cos, sin) = (column(|stop| stop.at), column(|stop| stop.cos), column(|stop| stop.sin));
    let inputs = Inputs { at: &at, cos: &cos, sin: &sin };
    let mut group = criterion.benchmark_group("kernel");
    for points in [1, 10] {
        let linkage = four_bar(points);
        let joints = linkage.joints.len();
        let mut out = Columns::new(joints, SAMPLES);
        let modes = Modes::new(Signs::default(), Flat::NONE);
        group.throughput(Throughput::Elements((SAMPLES * points) as u64));
        group.bench_function(format!("{points} coupler points"), |bencher| {
            bencher.iter(|| {
                place(black_box(&linkage), joints, inputs, &modes, &mut out, 0..SAMPLES);
                black_box(&mut out);
            });
        });
    }
    group.finish();
}

fn motion(criterion: &mut Criterion) {
    let sampler = Sampler::new(Sampling::Samples(SAMPLES));
    let linkage = four_bar(1);
    let mut group = criterion.benchmark_group("motion");
    group.throughput(Throughput::Elements(SAMPLES as u64));
    group.bench_function("limits, circuits and samples of a crank-rocker", |bencher| {
        bencher.iter(|| black_box(Motion::of(black_box(&linkage), &sampler)));
    });
    group.finish();
}

criterion_group!(benches, kernel, motion);
criterion_main!(benches);
