//! Benchmarks the positions of a four-bar, its motion and its measures, on one core: `cargo bench --bench kernel`.
//!
//! A position has a crank pin, a rocker pin and a coupler point. The table of sines and cosines is computed beforehand,
//! as it is for all cells of a family.

use std::hint::black_box;

use coupler_curves::catalogue;
use coupler_curves::family::{self, Family};
use coupler_curves::linkage::{AssemblyMode, DyadSet, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::measure::{self, TracedCurve};
use coupler_curves::motion::{
    DyadSigns, InputColumns, InputPosition, InputSlices, JointPositions, Motion, Sampler, Sampling, find_circuits,
    place_leading_joints, poses_in_columns,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SAMPLES: usize = 360;

/// A crank-rocker with `points` coupler points.
fn four_bar(points: usize) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [4.0, 0.0].into());
    let a = builder.crank("A", o, 1.0).expect("a crank");
    let b = builder.dyad("B", [a, c], [3.0, 3.5], Side::Left).expect("a dyad");
    let traced = (0..points).map(|k| builder.point("M", [a, b], 0.4 * k as f64, 1.0).expect("a point")).collect();
    builder.build(traced, None, MotionOptions::default()).expect("a four-bar")
}

fn kernel(criterion: &mut Criterion) {
    let sampler = Sampler::new(Sampling::Samples(SAMPLES));
    let column = |pick: fn(&InputPosition) -> f64| sampler.full_turn().iter().map(pick).collect::<Vec<f64>>();
    let (at, cos, sin) = (column(|stop| stop.value), column(|stop| stop.cos), column(|stop| stop.sin));
    let inputs = InputSlices { values: &at, cos: &cos, sin: &sin };
    let mut group = criterion.benchmark_group("kernel");
    for points in [1, 10] {
        let linkage = four_bar(points);
        let joints = linkage.joints.len();
        let mut out = JointPositions::new(joints, SAMPLES);
        let modes = DyadSigns::new(AssemblyMode::default(), DyadSet::EMPTY);
        group.throughput(Throughput::Elements((SAMPLES * points) as u64));
        group.bench_function(format!("{points} coupler points"), |bencher| {
            bencher.iter(|| {
                place_leading_joints(black_box(&linkage), joints, inputs, &modes, &mut out, 0..SAMPLES);
                black_box(&mut out);
            });
        });
    }
    // A circuit between limits is sampled at its own angles, so sines and cosines are computed for each.
    let linkage = four_bar(1);
    let joints = linkage.joints.len();
    let mut out = JointPositions::new(joints, SAMPLES);
    let modes = DyadSigns::new(AssemblyMode::default(), DyadSet::EMPTY);
    group.throughput(Throughput::Elements(SAMPLES as u64));
    group.bench_function("1 coupler points over a limited range", |bencher| {
        bencher.iter(|| {
            let angle = |k: usize| InputPosition::from_degrees(black_box(40.0) + 200.0 * k as f64 / SAMPLES as f64);
            let stops: Vec<InputPosition> = (0..SAMPLES).map(angle).collect();
            let column = |pick: fn(&InputPosition) -> f64| stops.iter().map(pick).collect::<Vec<f64>>();
            let (at, cos, sin) = (column(|stop| stop.value), column(|stop| stop.cos), column(|stop| stop.sin));
            let inputs = InputSlices { values: &at, cos: &cos, sin: &sin };
            place_leading_joints(black_box(&linkage), joints, inputs, &modes, &mut out, 0..SAMPLES);
            black_box(&mut out);
        });
    });
    // Links that no dyads place: Newton's method from the nodes of their circuits.
    for id in GROUPS {
        let linkage = of_catalogue(id);
        let circuits = find_circuits(&linkage).circuits;
        let pass = &circuits[0].passes[0];
        let angles = (0..SAMPLES).map(|k| pass.from.input.value + 360.0 * k as f64 / SAMPLES as f64);
        let inputs = InputColumns::from_values(linkage.input(), angles);
        group.throughput(Throughput::Elements(SAMPLES as u64));
        group.bench_function(id, |bencher| {
            bencher.iter(|| black_box(poses_in_columns(black_box(&linkage), pass, &inputs)));
        });
    }
    group.finish();
}

/// Linkages with groups that no dyads place, whose cranks turn fully.
const GROUPS: [&str; 2] = ["stephenson-ii-six-bar", "eight-bar-class-iii"];

/// A linkage of the catalogue with its defaults.
fn of_catalogue(id: &str) -> Linkage {
    let template = catalogue::find(id).expect("a linkage of the catalogue");
    let family = Family::single_cell(template, &[], family::Sampling::Samples(SAMPLES)).expect("its defaults");
    family.template.linkage(&family.cell(0).values).expect("a linkage")
}

fn motion(criterion: &mut Criterion) {
    let sampler = Sampler::new(Sampling::Samples(SAMPLES));
    let linkage = four_bar(1);
    let mut group = criterion.benchmark_group("motion");
    group.throughput(Throughput::Elements(SAMPLES as u64));
    group.bench_function("limits, circuits and samples of a crank-rocker", |bencher| {
        bencher.iter(|| black_box(Motion::solve(black_box(&linkage), &sampler)));
    });
    for id in GROUPS {
        let linkage = of_catalogue(id);
        group.throughput(Throughput::Elements(1));
        group.bench_function(format!("certified circuit of {id}"), |bencher| {
            bencher.iter(|| black_box(find_circuits(black_box(&linkage))));
        });
    }
    group.finish();
}

/// Solves and measures random four-bars of every class.
fn measures(criterion: &mut Criterion) {
    let sampler = Sampler::new(Sampling::Samples(SAMPLES));
    // A linear congruential generator: the same linkages on every machine.
    let mut state = 1_u64;
    let mut random = |from: f64, to: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
    };
    let linkage = |random: &mut dyn FnMut(f64, f64) -> f64| {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let c = builder.fixed("C", [random(0.5, 4.0), 0.0].into());
        let a = builder.crank("A", o, random(0.5, 3.0)).expect("a crank");
        let lengths = [random(0.5, 4.0), random(0.5, 4.0)];
        let b = builder.dyad("B", [a, c], lengths, Side::Left).expect("a dyad");
        let m = builder.point("M", [a, b], random(-2.0, 2.0), random(-2.0, 2.0)).expect("a point");
        builder.build(vec![m], None, MotionOptions::default()).expect("a four-bar")
    };
    let linkages: Vec<Linkage> = (0..200).map(|_| linkage(&mut random)).collect();
    let mut group = criterion.benchmark_group("measures");
    group.throughput(Throughput::Elements(linkages.len() as u64));
    group.sample_size(20);
    // Whether measures are too close to tell takes all portions.
    let is_portion = |name: &str| ["straight", "dwell", "too_close"].iter().any(|word| name.starts_with(word));
    let mut bench = |title: &str, is_included: &dyn Fn(&str) -> bool| {
        let measures: Vec<_> = measure::ALL.iter().filter(|measure| is_included(measure.name)).collect();
        group.bench_function(title, |bencher| {
            bencher.iter(|| {
                for linkage in &linkages {
                    let motion = Motion::solve(linkage, &sampler);
                    for circuit in &motion.circuits {
                        let curve = TracedCurve::new(linkage, &motion, circuit, linkage.traced[0]);
                        for measure in &measures {
                            black_box((measure.compute)(&curve));
                        }
                    }
                }
            });
        });
    };
    bench("all, of a random four-bar", &|_| true);
    bench("without straightness and dwell", &|name| !is_portion(name));
    bench("without these and symmetry", &|name| !is_portion(name) && !name.starts_with("symmetry"));
    group.finish();
}

criterion_group!(benches, kernel, motion, measures);
criterion_main!(benches);
