//! Benchmarks the search for linkages on one core: `cargo bench --bench find`.

use std::hint::black_box;
use std::time::{Duration, Instant};

use coupler_curves::FourBar;
use coupler_curves::geometry::Point;
use coupler_find::{
    CurveFitOptions, CurveFitter, CurveIndex, CurveLookup, Effort, Index, Options, PathKind, Search, Target,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// A hundred points of a coupler curve, or the first of them.
fn target(kind: PathKind) -> Target {
    let four_bar = FourBar { frame: 3.1, crank: 1.2, coupler: 2.7, rocker: 3.3 };
    let curve = four_bar.coupler_curve(1.9, 1.4).unwrap();
    let points: Vec<Point> = curve.points().collect();
    let every = points.len() / 100;
    let count = if kind == PathKind::Closed { 100 } else { 40 };
    Target::new(&points.into_iter().step_by(every).take(count).collect::<Vec<_>>(), kind).unwrap()
}

/// The time of the longest step of a search, the shortest of some repetitions: what a page waits for between two frames.
fn longest_step(target: &Target, index: &Index) -> Duration {
    const REPETITIONS: usize = 3;
    let times = |_| {
        let mut search = Search::new(target, Options::default());
        let mut times = Vec::new();
        loop {
            let start = Instant::now();
            let is_left = search.step(index);
            times.push(start.elapsed());
            if !is_left {
                break times;
            }
        }
    };
    let repetitions: Vec<Vec<Duration>> = (0..REPETITIONS).map(times).collect();
    // All repetitions take the same steps.
    let shortest = (0..repetitions[0].len()).filter_map(|k| repetitions.iter().map(|times| times[k]).min());
    shortest.max().unwrap_or_default()
}

fn find(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("find");
    group.sample_size(10);
    group.throughput(Throughput::Elements(10_000));
    group.bench_function("index of 10,000 curves", |bencher| bencher.iter(|| Index::with_count(black_box(10_000))));
    let [target, part] = [PathKind::Closed, PathKind::Part].map(target);
    for (name, count) in [("lookup in 100,000 curves", 100_000), ("lookup in 1,000,000 curves", 1_000_000)] {
        let index = Index::with_count(count);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(name, |bencher| bencher.iter(|| index.most_alike(black_box(&target), true, 200)));
    }
    let index = Index::with_count(Index::DEFAULT_COUNT);
    group.throughput(Throughput::Elements(index.len() as u64));
    group.bench_function("portions of 100,000 curves", |bencher| {
        bencher.iter(|| index.most_alike(black_box(&part), true, 200));
    });
    group.throughput(Throughput::Elements(1));
    group.bench_function("search for a part", |bencher| {
        bencher.iter(|| Search::new(&part, Options::default()).run(&index));
    });
    for (name, kind) in [("closed path", &target), ("part", &part)] {
        println!("find: the longest step of a search for a {name} takes {:.1?}", longest_step(kind, &index));
    }
    for (name, effort) in [("quick search", Effort::Quick), ("search", Effort::Normal)] {
        let options = Options { effort, ..Options::default() };
        group.bench_function(name, |bencher| bencher.iter(|| Search::new(&target, options.clone()).run(&index)));
    }
    let other = FourBar { frame: 3.2, crank: 1.3, coupler: 2.7, rocker: 3.2 };
    let curve: Vec<Point> = other.coupler_curve(1.8, 1.5).unwrap().points().collect();
    for (name, target) in [("fit of a curve", &target), ("fit of a portion of a curve", &part)] {
        let fitter = CurveFitter::new(target, CurveFitOptions::default());
        group.bench_function(name, |bencher| bencher.iter(|| fitter.fit(black_box(&curve), true)));
    }
    group.throughput(Throughput::Elements(1000));
    let mut curves = CurveIndex::new();
    (0..1000).for_each(|_| curves.push(&curve, true));
    group.bench_function("portions of 1000 given curves", |bencher| {
        bencher.iter(|| {
            let mut lookup = CurveLookup::new(black_box(&part), CurveFitOptions::default(), 200);
            lookup.compare(&curves, 0..curves.len());
            lookup.found().count()
        });
    });
    group.finish();
}

criterion_group!(benches, find);
criterion_main!(benches);
